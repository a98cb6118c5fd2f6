// SPDX-License-Identifier: Apache-2.0
#include "base/file_output.h"

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>
// libmd's header wants the types above first.
#include <sha256.h>

#include <cerrno>
#include <cstdio>

#include "base/input_file.h"
#include "base/interrupt.h"

namespace floorproof {

bool IsOfTheDisk(const std::error_code& reason) {
  using std::errc;
  return reason == errc::no_space_on_device || reason == errc::file_too_large ||
         reason == errc::io_error || reason == std::error_code(EDQUOT, std::generic_category());
}

void RefuseToWrite(const std::filesystem::path& path, const std::error_code& reason,
                   const std::string& why) {
  const InputError refusal({path.string(), 0}, "", "", why);
  if (IsOfTheDisk(reason)) throw DiskError(refusal.what());
  throw refusal;
}

void MakeFolder(const std::filesystem::path& folder) {
  std::error_code error, ignored;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::is_directory(folder, ignored)) return;
  const bool in_the_way = std::filesystem::exists(folder, ignored);
  RefuseToWrite(
      folder, error,
      "cannot make this folder: " + (in_the_way ? "a file is in the way" : error.message()));
}

namespace {

const std::string kPart = ".part";

std::error_code Errno(int number) { return {number, std::generic_category()}; }

// Returns why it failed; none when it did not.
std::error_code WriteTo(const std::filesystem::path& path, std::string_view text) {
  errno = 0;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return Errno(errno);
  bool ok = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  int why = errno;
  if (std::fclose(file) != 0) {  // what was buffered meets the disk here
    if (ok) why = errno;
    ok = false;
  }
  return ok ? std::error_code() : Errno(why);
}

[[noreturn]] void Refuse(const std::filesystem::path& path, const std::error_code& reason) {
  RefuseToWrite(path, reason, "cannot be written: " + reason.message());
}

}  // namespace

std::filesystem::path MakePartFile(const std::filesystem::path& path) {
  std::filesystem::path part = std::filesystem::absolute(path);
  part.replace_filename("." + path.stem().string() + kPart + path.extension().string());
  // One that a killed process left; a link is removed and not followed.
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) Refuse(path, Errno(errno));
  close(file);
  return part;
}

std::string WholeOfPart(const std::string& part) {
  const std::size_t at = part.rfind(kPart);
  if (!part.starts_with('.') || at == std::string::npos || at <= 1) return "";
  const std::string extension = part.substr(at + kPart.size());
  const bool is_extension = extension.empty() || (extension[0] == '.' && extension.rfind('.') == 0);
  return is_extension ? part.substr(1, at - 1) + extension : "";
}

void WriteFileWhole(const std::filesystem::path& path, std::string_view text) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status))
    RefuseToWrite(path, {}, "cannot be written: it is a folder");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    // A pipe or a device (/dev/stdout) is written to; a file must not take its place.
    if (const std::error_code why = WriteTo(path, text)) Refuse(path, why);
    return;
  }
  const HoldInterrupts until_renamed;
  const std::filesystem::path part = MakePartFile(path);
  if (const std::error_code why = WriteTo(part, text)) {
    std::filesystem::remove(part, error);
    Refuse(path, why);
  }
  std::filesystem::rename(part, path, error);
  if (error) {
    const std::error_code why = error;
    std::filesystem::remove(part, error);
    Refuse(path, why);
  }
}

std::string Sha256(std::string_view text) {
  char hex[SHA256_DIGEST_STRING_LENGTH];
  SHA256Data(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), hex);
  return hex;
}

bool IsSha256(std::string_view text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::string Sha256OfFile(const std::filesystem::path& path) {
  constexpr std::uintmax_t kAny = std::uintmax_t{1} << 50;
  if (const std::string why = WhyUnreadable(path, kAny); !why.empty())
    throw InputError({path.string(), 0}, "", "", why);
  char hex[SHA256_DIGEST_STRING_LENGTH];
  if (SHA256File(path.c_str(), hex) == nullptr)
    throw InputError({path.string(), 0}, "", "", "cannot be read");
  return hex;
}

}  // namespace floorproof

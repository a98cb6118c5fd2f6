// SPDX-License-Identifier: Apache-2.0
#include "env/run/file_output.h"

#include <sys/types.h>
// libmd's header wants the types above first.
#include <sha256.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "env/core/error.h"

namespace floorproof {

void MakeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::is_directory(folder)) return;
  const bool in_the_way = std::filesystem::exists(folder);
  throw InputError(
      {folder.string(), 0}, "", "",
      "cannot make this folder: " + (in_the_way ? "a file is in the way" : error.message()));
}

void WriteFileWhole(const std::filesystem::path& path, std::string_view text) {
  const std::filesystem::path part = path.string() + ".part";
  std::FILE* file = std::fopen(part.c_str(), "wb");
  bool ok = file != nullptr;
  if (ok) ok = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int write_error = errno;
  if (file != nullptr && std::fclose(file) != 0) ok = false;
  if (!ok) {
    std::remove(part.c_str());
    throw InputError({path.string(), 0}, "", "",
                     std::string("cannot be written: ") + std::strerror(write_error));
  }
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (error) {
    std::remove(part.c_str());
    throw InputError({path.string(), 0}, "", "", "cannot be written: " + error.message());
  }
}

std::string Sha256OfFile(const std::filesystem::path& path) {
  char hex[SHA256_DIGEST_STRING_LENGTH];
  if (SHA256File(path.c_str(), hex) == nullptr)
    throw InputError({path.string(), 0}, "", "", "cannot be read");
  return hex;
}

}  // namespace floorproof

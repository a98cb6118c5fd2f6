// SPDX-License-Identifier: Apache-2.0
#include "base/result_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <sstream>

#include "base/error.h"
#include "base/file_output.h"
#include "base/fork.h"
#include "base/input_file.h"
#include "base/interrupt.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kList = "files.sha256";
constexpr std::string_view kHeader = "# written by floorproof; `sha256sum --check` compares";
constexpr std::string_view kUnfinished = "# being written: ";
constexpr std::size_t kHashDigits = 64;
constexpr std::uintmax_t kMaxListBytes = 16u << 20;

[[noreturn]] void Refuse(const fs::path& file, const std::string& why) {
  throw InputError({file.string(), 0}, "", "",
                   why + "; name another folder, or move the file away");
}

}  // namespace

ResultFolder::ResultFolder(fs::path folder, ResultNames results, std::span<const fs::path> inputs)
    : folder_(std::move(folder)), results_(results) {
  RefuseInputs(inputs);
  ReadList();
  was_unfinished_ = unfinished_.contains(std::string(results_.kind));
  RefuseForeign();
}

ResultFolder::~ResultFolder() {
  List();
  if (lock_ >= 0) CloseOwn(lock_);
}

void ResultFolder::List() {
  if (!begun_) return;
  const HoldInterrupts until_listed;
  try {
    std::erase_if(written_, [&](const auto& entry) { return results_.has(entry.first); });
    for (const std::string& name : Results()) written_[name] = Sha256OfFile(folder_ / name);
    if (results_.all_of_kind || !was_unfinished_) unfinished_.erase(std::string(results_.kind));
    WriteList();
  } catch (const std::runtime_error&) {  // InputError, DiskError
    // The list goes on to say that results are being written, which keeps them replaceable.
  }
}

void ResultFolder::Lock() {
  if (lock_ >= 0) return;
  MakeFolder(folder_);
  lock_ = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) Own(lock_);
  // A file system without locks is no reason not to write.
  if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    CloseOwn(lock_);
    lock_ = -1;
    throw InputError({folder_.string(), 0}, "", "", "is in use: another run is writing there");
  }
  RemoveParts();
}

void ResultFolder::RemoveParts() const {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    const std::string whole = WholeOfPart(entry.path().filename().string());
    if (!whole.empty() && (results_.has(whole) || whole == kList) && IsPlainFile(entry.path()))
      fs::remove(entry.path(), ignored);
  }
}

void ResultFolder::Begin() {
  Lock();
  unfinished_.emplace(results_.kind);
  WriteList();
  begun_ = true;
}

void ResultFolder::RequireInPlace(std::initializer_list<std::string_view> written) const {
  const auto gone = [](const fs::path& path) {
    throw InternalError(path.string() + ": was removed or moved while results were being written");
  };
  struct stat locked {};
  struct stat there {};
  const bool same =
      lock_ < 0 || (fstat(lock_, &locked) == 0 && stat(folder_.c_str(), &there) == 0 &&
                    locked.st_dev == there.st_dev && locked.st_ino == there.st_ino);
  if (!same) gone(folder_);
  for (const std::string_view name : written)
    if (!IsPlainFile(folder_ / name)) gone(folder_ / name);
}

std::vector<std::string> ResultFolder::Results() const {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored))
    if (std::string name = entry.path().filename().string(); results_.has(name))
      names.push_back(std::move(name));
  std::ranges::sort(names);
  return names;
}

void ResultFolder::ReadList() {
  const fs::path file = folder_ / kList;
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored))) return;
  if (!IsPlainFile(file)) Refuse(file, "is no plain file");
  std::istringstream in(ReadInputFile(file, kMaxListBytes));
  std::string line;
  if (!std::getline(in, line) || line != kHeader) Refuse(file, "is not a list of results");
  while (std::getline(in, line)) {
    if (line.starts_with(kUnfinished)) unfinished_.insert(line.substr(kUnfinished.size()));
    if (line.size() > kHashDigits + 2 && line.substr(kHashDigits, 2) == "  ")
      written_[line.substr(kHashDigits + 2)] = line.substr(0, kHashDigits);
  }
}

void ResultFolder::RefuseInputs(std::span<const fs::path> inputs) const {
  std::error_code error;
  const fs::path here = fs::weakly_canonical(fs::absolute(folder_), error);
  for (const fs::path& input : inputs) {
    const fs::path file = fs::weakly_canonical(fs::absolute(input), error);
    if (file.parent_path() == here && results_.has(file.filename().string()))
      Refuse(input, "is read, and a result of that name would replace it");
  }
}

void ResultFolder::RefuseForeign() const {
  for (const std::string& name : Results()) {
    const fs::path file = folder_ / name;
    if (!IsPlainFile(file)) Refuse(file, "is no plain file, and a result would replace it");
    if (was_unfinished_) continue;
    const auto listed = written_.find(name);
    if (listed == written_.end())
      Refuse(file,
             "was not written by an earlier run (files.sha256 does not list it), and a result "
             "would replace it");
    if (Sha256OfFile(file) != listed->second)
      Refuse(file,
             "has changed since a run wrote it (files.sha256), and a result would replace it");
  }
}

void ResultFolder::WriteList() const {
  std::string text = std::string(kHeader) + "\n";
  for (const std::string& kind : unfinished_) text += std::string(kUnfinished) + kind + "\n";
  for (const auto& [name, hash] : written_) text += hash + "  " + name + "\n";
  WriteFileWhole(folder_ / kList, text);
}

void RefuseToReplace(std::span<const fs::path> inputs, const fs::path& file) {
  std::error_code error;
  for (const fs::path& input : inputs)
    if (fs::equivalent(input, file, error))
      throw InputError({file.string(), 0}, "", "", "is read: --out names another file");
}

void RequirePlainResults(const fs::path& folder) {
  constexpr std::string_view kFolders[] = {"episodes", "inputs", "likeliest", "plans"};
  constexpr std::string_view kFiles[] = {"scenario.resolved.yaml", "fmea_measured.yaml",
                                         "junit.xml", kList};
  constexpr std::string_view kEndings[] = {".json", ".csv", ".png", ".mp4",
                                           ".html", ".bin", ".pgm", ".sqlite"};
  const auto require = [](const fs::directory_entry& entry) {
    std::error_code ignored;
    const fs::file_type type = entry.symlink_status(ignored).type();
    if (type != fs::file_type::regular && type != fs::file_type::directory)
      throw InputError({entry.path().string(), 0}, "", "",
                       type == fs::file_type::symlink
                           ? "is a link: results are files and folders"
                           : "is a pipe or a device: results are files and folders");
  };
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
    const std::string name = entry.path().filename().string(), ending = entry.path().extension();
    const bool holds_results = std::ranges::find(kFolders, name) != std::end(kFolders);
    const bool is_result = std::ranges::find(kFiles, name) != std::end(kFiles) ||
                           std::ranges::find(kEndings, ending) != std::end(kEndings);
    if (!holds_results && !is_result) continue;
    require(entry);
    if (!holds_results || !entry.is_directory(ignored)) continue;
    for (const auto& below : fs::recursive_directory_iterator(entry.path(), ignored))
      require(below);
  }
}

void RefuseLinks(const fs::path& root, const fs::path& below) {
  fs::path at = root;
  for (const fs::path& part : below.lexically_relative(root)) {
    at /= part;
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(at, ignored)))
      throw InputError({at.string(), 0}, "", "", "is a link: results would be written elsewhere");
  }
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "base/input_files.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>

#include "base/error.h"
#include "base/file_output.h"
#include "base/input_file.h"
#include "base/result_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kAnySize = std::uintmax_t{1} << 40;

}  // namespace

struct InputFiles::Shared {
  struct Input {
    fs::path named;  // as first asked for
    std::optional<std::string> bytes;
    std::string sha256;
    fs::path copy;  // that stands in for it; empty: none
    bool absolute = false;
  };

  std::recursive_mutex mutex;               // of all that follows
  std::map<fs::path, Input> inputs;         // by canonical path
  std::map<std::string, Input*> spellings;  // asking again costs no look at the disk
  std::vector<fs::path> order;
  fs::path confined_to;           // empty: nothing is out of reach
  std::string reader;             // the kind of file whose folder that is
  std::vector<fs::path> allowed;  // beside it

  // Why a file is out of reach, whether it is there or not; empty when it is not.
  std::string WhyOutOfReach(const fs::path& file) const {
    if (confined_to.empty()) return "";
    const fs::path path = ResolvedPath(file);
    const auto allows = [&](const fs::path& place) {
      return LiesBelow(place, path) && !IsHiddenIn(place, path);
    };
    if (std::ranges::any_of(allowed, allows)) return "";
    const std::string trusted = " (--trust reads it all the same)";
    if (!LiesBelow(confined_to, path))
      return "lies outside the " + reader + "'s folder, " + confined_to.string() + trusted;
    if (IsHiddenIn(confined_to, path))
      return "is a hidden file of the " + reader + "'s folder, or in one" + trusted;
    return "";
  }

  Input& At(const fs::path& file) {
    Input*& known = spellings[file.string()];
    if (known == nullptr) {
      known = &inputs[ResolvedPath(file)];
      if (known->named.empty()) known->named = file;
    }
    return *known;
  }

  // Where the bytes of `file` are to be read from. Throws InputError if that is out of reach.
  const fs::path& SourceOf(const Input& input, const fs::path& file) const {
    const fs::path& source = input.copy.empty() ? file : input.copy;
    if (const std::string why = WhyOutOfReach(source); !why.empty())
      throw InputError({source.string(), 0}, "", "", why);
    return source;
  }

  const std::string& Bytes(const fs::path& file, std::uintmax_t most_bytes) {
    Input& input = At(file);
    if (!input.bytes) {
      std::string bytes = ReadInputFile(SourceOf(input, file), most_bytes);
      std::string hash = floorproof::Sha256(bytes);
      if (!input.copy.empty() && hash != input.sha256)
        throw InputError({input.copy.string(), 0}, "", "",
                         "is not what its name says: SHA-256 " + hash);
      input.bytes = std::move(bytes);
      input.sha256 = std::move(hash);
      order.push_back(input.named);
    }
    if (input.bytes->size() > most_bytes)
      throw InputError({file.string(), 0}, "", "",
                       "larger than " + std::to_string(most_bytes >> 20) + " MiB");
    return *input.bytes;
  }
};

InputFiles::InputFiles() : shared_(std::make_shared<Shared>()) {}

const std::string& InputFiles::Read(const fs::path& file, std::uintmax_t most_bytes) const {
  const std::lock_guard alone(shared_->mutex);
  return shared_->Bytes(file, most_bytes);
}

std::string InputFiles::ReadStart(const fs::path& file, std::size_t count,
                                  std::uintmax_t most_bytes) const {
  const std::lock_guard alone(shared_->mutex);
  const Shared::Input& input = shared_->At(file);
  if (input.bytes) return input.bytes->substr(0, count);
  return ReadStartOfFile(shared_->SourceOf(input, file), count, most_bytes);
}

std::string InputFiles::WhyUnreadable(const fs::path& file, std::uintmax_t most_bytes) const {
  const std::lock_guard alone(shared_->mutex);
  const Shared::Input& input = shared_->At(file);
  if (input.bytes && input.bytes->size() <= most_bytes) return "";
  const fs::path& read = input.copy.empty() ? file : input.copy;
  const std::string why = shared_->WhyOutOfReach(read);
  return why.empty() ? floorproof::WhyUnreadable(read, most_bytes) : why;
}

const std::string& InputFiles::Sha256(const fs::path& file) const {
  const std::lock_guard alone(shared_->mutex);
  const Shared::Input& input = shared_->At(file);
  if (input.sha256.empty()) shared_->Bytes(file, kAnySize);
  return input.sha256;
}

std::uintmax_t InputFiles::Size(const fs::path& file) const {
  const std::lock_guard alone(shared_->mutex);
  const Shared::Input& input = shared_->At(file);
  if (input.bytes) return input.bytes->size();
  const fs::path& source = shared_->SourceOf(input, file);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(source, error);
  if (error) throw InputError({source.string(), 0}, "", "", "cannot be read: " + error.message());
  return size;
}

void InputFiles::StandIn(const fs::path& file, const std::string& sha256,
                         const fs::path& copy) const {
  const std::lock_guard alone(shared_->mutex);
  Shared::Input& input = shared_->At(file);
  input.sha256 = sha256;
  input.copy = copy;
}

bool InputFiles::HasStandIn(const fs::path& file) const {
  const std::lock_guard alone(shared_->mutex);
  return !shared_->At(file).copy.empty();
}

std::vector<fs::path> InputFiles::StoodIn() const {
  const std::lock_guard alone(shared_->mutex);
  std::vector<fs::path> files;
  for (const auto& [path, input] : shared_->inputs)
    if (!input.copy.empty()) files.push_back(path);
  return files;
}

void InputFiles::Hold(const fs::path& file, const std::string& bytes) const {
  const std::lock_guard alone(shared_->mutex);
  Shared::Input& input = shared_->At(file);
  if (!input.bytes) shared_->order.push_back(input.named);
  input.bytes = bytes;
  input.sha256 = floorproof::Sha256(bytes);
}

std::vector<std::pair<std::string, std::string>> InputFiles::Named() const {
  const std::lock_guard alone(shared_->mutex);
  std::vector<std::pair<std::string, std::string>> named;
  for (const auto& [name, input] : shared_->spellings)
    if (input->bytes) named.emplace_back(name, *input->bytes);
  return named;
}

void InputFiles::Confine(const fs::path& folder, const std::string& reader) const {
  const std::lock_guard alone(shared_->mutex);
  shared_->confined_to = ResolvedPath(folder);
  shared_->reader = reader;
}

void InputFiles::Allow(const fs::path& place) const {
  const std::lock_guard alone(shared_->mutex);
  if (!shared_->confined_to.empty()) shared_->allowed.push_back(ResolvedPath(place));
}

bool InputFiles::confined() const {
  const std::lock_guard alone(shared_->mutex);
  return !shared_->confined_to.empty();
}

void InputFiles::MarkAbsolute(const fs::path& file) const {
  const std::lock_guard alone(shared_->mutex);
  shared_->At(file).absolute = true;
}

bool InputFiles::IsAbsolute(const fs::path& file) const {
  const std::lock_guard alone(shared_->mutex);
  return shared_->At(file).absolute;
}

std::vector<fs::path> InputFiles::All() const {
  const std::lock_guard alone(shared_->mutex);
  return shared_->order;
}

fs::path KeptCopy(const fs::path& folder, const std::string& sha256) {
  return folder / "inputs" / sha256;
}

namespace {

// Writes what `bytes` gives into the copy of that hash, where it is not there yet.
template <class Bytes>
fs::path Keep(const std::string& hash, const Bytes& bytes, const fs::path& folder) {
  fs::path copy = KeptCopy(folder, hash);
  RefuseLinks(folder, copy.parent_path());
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(copy, ignored);
  if (fs::exists(there)) {
    if (!fs::is_regular_file(there) || Sha256OfFile(copy) != hash)
      throw InputError({copy.string(), 0}, "", "",
                       "is not what its name says; --out names another "
                       "folder");
    return copy;
  }
  MakeFolder(copy.parent_path());
  WriteFileWhole(copy, bytes());
  return copy;
}

}  // namespace

void KeepCopy(const InputFiles& files, const fs::path& file, const fs::path& folder) {
  const std::string hash = files.Sha256(file);
  Keep(
      hash, [&] { return std::string_view(files.Read(file, kAnySize)); }, folder);
}

fs::path KeepText(const std::string& text, const fs::path& folder) {
  return Keep(
      Sha256(text), [&] { return std::string_view(text); }, folder);
}

fs::path FindCopy(const fs::path& folder, const std::string& sha256) {
  if (!IsSha256(sha256)) throw InputError({folder.string(), 0}, "", sha256, "is no SHA-256");
  fs::path copy = KeptCopy(folder, sha256);
  if (Sha256OfFile(copy) != sha256)
    throw InputError({copy.string(), 0}, "", "", "is not what its name says");
  return copy;
}

}  // namespace floorproof

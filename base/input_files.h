// SPDX-License-Identifier: Apache-2.0
// The files that a piece of work reads, each read once: whoever asks again gets the same bytes,
// whatever has become of the file. So the hundredth episode is of the inputs of the first, and what
// was read can be named by its SHA-256 and kept.
//
// Values are handles: copies share what was read, from several threads too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace floorproof {

struct ConfigNode;

class InputFiles {
 public:
  InputFiles();

  // The whole file. Throws InputError naming it, as ReadInputFile does.
  const std::string& Read(const std::filesystem::path& file, std::uintmax_t most_bytes) const;
  // Its first `count` bytes or fewer; the rest is not read.
  std::string ReadStart(const std::filesystem::path& file, std::size_t count,
                        std::uintmax_t most_bytes) const;
  // Why it cannot be read; empty when it can.
  std::string WhyUnreadable(const std::filesystem::path& file, std::uintmax_t most_bytes) const;
  // Of a file that was read, or that a copy stands in for: in hexadecimal.
  const std::string& Sha256(const std::filesystem::path& file) const;
  // Of the whole file, read or not. Throws InputError.
  std::uintmax_t Size(const std::filesystem::path& file) const;

  // From now on `file`, which need not be there, is read from `copy`, whose SHA-256 must be this.
  void StandIn(const std::filesystem::path& file, const std::string& sha256,
               const std::filesystem::path& copy) const;
  bool HasStandIn(const std::filesystem::path& file) const;
  std::vector<std::filesystem::path> StoodIn() const;  // the files that copies stand in for

  // From now on `file`, which need not be there, holds these bytes.
  void Hold(const std::filesystem::path& file, const std::string& bytes) const;
  // What was read or held, under every name by which it was asked for: name and bytes.
  std::vector<std::pair<std::string, std::string>> Named() const;

  // From now on a file that was neither read nor held before is read only if it lies in `folder` or
  // where it was allowed, links followed. Hidden files and folders below `folder` (.git, .ssh) are
  // out of reach too. `reader` says whose folder it is: "scenario", "map". Before Allow.
  void Confine(const std::filesystem::path& folder, const std::string& reader) const;
  // Lets a file be read, or a folder's files but for hidden ones. Does nothing unless confined.
  void Allow(const std::filesystem::path& place) const;
  bool confined() const;

  // Another input names this file by an absolute path: it is looked for there wherever a record of
  // the work is moved to.
  void MarkAbsolute(const std::filesystem::path& file) const;
  bool IsAbsolute(const std::filesystem::path& file) const;

  // What was read, as it was first named, in that order.
  std::vector<std::filesystem::path> All() const;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

// As ReadYamlFile of base/config.h, of a file that is to hold the key `marker`. If the text does
// not hold it, the InputError quotes nothing of the text, which may be a secret.
ConfigNode ReadYamlFile(const std::filesystem::path& path, const InputFiles& files,
                        std::string_view marker);

// The folder of copies, beside the record that lists them: a file each, named by its SHA-256.
std::filesystem::path KeptCopy(const std::filesystem::path& folder, const std::string& sha256);
// Keeps a copy of a file that was read. Throws InputError when it cannot be written, or another
// file has its name.
void KeepCopy(const InputFiles& files, const std::filesystem::path& file,
              const std::filesystem::path& folder);

// Keeps a text as if it were the copy of a file that was read; returns where. Throws as KeepCopy.
std::filesystem::path KeepText(const std::string& text, const std::filesystem::path& folder);
// The copy of this SHA-256. Throws InputError where it is none, not there, or another file.
std::filesystem::path FindCopy(const std::filesystem::path& folder, const std::string& sha256);

}  // namespace floorproof

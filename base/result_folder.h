// SPDX-License-Identifier: Apache-2.0
// A folder that results are written into, beside whatever else lies there.
//
// Its list, files.sha256, names each file that was written with its SHA-256, as `sha256sum --check`
// reads it. What stands under a result's name and is not in the list, or is no longer what the list
// says, is somebody else's: it is neither replaced nor removed. While results are being written the
// list says so, and whatever then stands under their names is taken for theirs: a killed run must
// not shut the next one out.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace floorproof {

// The results of one kind, by the names of their files.
struct ResultNames {
  std::string_view kind;
  bool (*has)(std::string_view file_name);
  bool all_of_kind = true;  // false: the kind has files of other names, too
};

class ResultFolder {
 public:
  // Looks, and touches nothing; the folder need not be there. Throws InputError naming the first
  // file under a result's name that is one of `inputs`, a link or no plain file, or that no earlier
  // run wrote.
  ResultFolder(std::filesystem::path folder, ResultNames results,
               std::span<const std::filesystem::path> inputs);
  // Lists what is there, where it has begun.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  // Makes the folder, keeps others from writing there as long as this lives, and removes what a
  // killed run had begun to write of results of this kind. Throws InputError if it cannot be made,
  // or another process writes there.
  void Lock();
  // Locks, and says in the list that results are being written. Throws InputError.
  void Begin();
  // To call before a verdict is printed: throws InternalError if the folder is no longer the one
  // that was locked (removed, replaced, moved), or one of these files that were written is gone.
  void RequireInPlace(std::initializer_list<std::string_view> written) const;
  // Names of the results that are there, in alphabetical order.
  std::vector<std::string> Results() const;

 private:
  void ReadList();
  void List();
  void RefuseInputs(std::span<const std::filesystem::path> inputs) const;
  void RefuseForeign() const;
  void WriteList() const;
  // Those of results that a killed run had begun to write.
  void RemoveParts() const;

  std::filesystem::path folder_;
  ResultNames results_;
  std::map<std::string, std::string> written_;  // SHA-256 by name
  std::set<std::string> unfinished_;            // kinds
  bool begun_ = false, was_unfinished_ = false;
  int lock_ = -1;  // of the folder itself, by flock
};

// Throws InputError where writing `file` would replace one of `inputs`.
void RefuseToReplace(std::span<const std::filesystem::path> inputs,
                     const std::filesystem::path& file);

// To call before untrusted results are read: throws InputError if a result, or an entry of the
// folders of results (episodes, inputs, likeliest, plans), is a link, a pipe or a device. Other
// files and folders may lie beside them.
void RequirePlainResults(const std::filesystem::path& folder);

// Throws InputError where a folder on the way from `root` to `below` is a link: what is written
// there would land elsewhere.
void RefuseLinks(const std::filesystem::path& root, const std::filesystem::path& below);

}  // namespace floorproof

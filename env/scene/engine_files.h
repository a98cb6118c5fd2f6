// SPDX-License-Identifier: Apache-2.0
// The engine's own reading of files, answered from InputFiles: so that what it resolves (includes,
// meshes, textures, height fields) is what is read once, hashed and kept.
//
// MuJoCo asks a provider for every file below the folder that the provider is mounted at, by its
// absolute path. One is mounted at each folder of the root.
//
// A model has plain files below its own folder that are not hidden, and no others: whatever it
// names, and however it spells that. To the engine the others do not exist.
#pragma once

#include <mujoco/mujoco.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/input_files.h"

namespace floorproof {

class EngineFiles {
 public:
  static constexpr std::uintmax_t kMaxBytes = 64u << 20;  // of a file

  EngineFiles() = default;
  // For the model in `file`, an absolute path. Throws InternalError when MuJoCo mounts nothing.
  EngineFiles(const InputFiles& files, const std::filesystem::path& file);

  // Why a robot whose file lies in `folder`, a path without links, may not read this file, there or
  // not; empty when it may.
  static std::string WhyOutOfReach(const std::filesystem::path& folder,
                                   const std::filesystem::path& file);

  // As long as somebody holds it, what was read stays.
  std::shared_ptr<const mjVFS> shared_vfs() const { return vfs_; }
  const mjVFS* vfs() const { return vfs_.get(); }
  // What the engine has opened so far, each once, in that order.
  std::vector<std::filesystem::path> Opened() const;
  // The first file that the engine asked for and may not have, and why: a pipe or a device, too
  // large. The engine gets an empty file instead.
  std::optional<std::pair<std::string, std::string>> Refused() const;

 private:
  struct Served;
  std::shared_ptr<Served> served_;
  std::shared_ptr<const mjVFS> vfs_;
};

}  // namespace floorproof

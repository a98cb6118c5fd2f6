// SPDX-License-Identifier: Apache-2.0
// Where a URDF's mesh is: below the URDF's own folder, or nowhere.
#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/input_files.h"

namespace floorproof {

struct MeshPlace {
  std::filesystem::path file;  // empty: left out
  std::string extension;       // in small letters, with its dot
  bool is_collada = false;     // MuJoCo gets it as .obj, its `extension`
  std::string why;             // it is left out
};

// `uri` as written in `urdf`: package://PACKAGE/path (PACKAGE's folder may be the URDF's own, or
// lie in it), file:// or a path. Throws InputError at `mark` where it leads out of the URDF's
// folder, or to what is no plain file.
MeshPlace FindMesh(const std::string& uri, const std::filesystem::path& urdf,
                   const SourceMark& mark, const InputFiles& files);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A URDF's text made ready for MuJoCo's importer, which follows no paths, knows no packages, and
// says of some broken trees nothing that a user understands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/input_files.h"

namespace floorproof {

struct UrdfJoint {
  std::string name, type, parent, child;
  double effort = 0, velocity = 0;  // of its <limit>; 0: none stated
  int line = 0;
};

struct UrdfMesh {
  std::string name;  // in the text made ready
  std::filesystem::path file;
  std::string obj;  // of a Collada file: what it was converted to; else empty
};

struct LostMesh {
  std::string link;
  std::string why;  // the mesh as the file names it, and why it cannot be read
};

struct UrdfText {
  std::string robot;  // its name
  std::string xml;    // for the importer; lines stand where they stood
  std::vector<UrdfJoint> joints;
  std::vector<UrdfMesh> meshes;           // that are there
  std::vector<LostMesh> lost_collisions;  // of <collision>s that are therefore left out
  std::vector<std::string> notes;
};

// Whether the root element of the file is a URDF's. False for what cannot be read.
bool IsUrdf(const std::filesystem::path& file, const InputFiles& files);

// Throws InputError naming the line where the links are no tree with one root, are more than can
// be held, or a mesh's file lies outside the URDF's folder. A mesh that is not there, or that
// MuJoCo cannot read, is left out with a note.
UrdfText PrepareUrdf(const std::filesystem::path& file, const InputFiles& files);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Collada meshes (.dae), which MuJoCo does not read.
#pragma once

#include <string>

namespace floorproof {

// The triangles of all its meshes, m, as the text of a Wavefront OBJ. Axes are those of the file,
// whichever it calls up: as RViz and Gazebo take them. Nothing else is read, whatever the text
// names. Throws InputError, without a place, for what is no Collada mesh.
std::string ObjOfCollada(const std::string& text);

}  // namespace floorproof

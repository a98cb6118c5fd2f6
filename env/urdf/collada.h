// SPDX-License-Identifier: Apache-2.0
// Collada meshes (.dae), which MuJoCo does not read.
#pragma once

#include <string>

namespace floorproof {

// Converts all meshes to the text of a Wavefront OBJ, in m. The file's axes are used without
// conversion (up_axis is ignored), as in RViz and Gazebo. Files that the text refers to are not
// read. Throws InputError, without file and line, if the text is not a valid Collada mesh.
std::string ObjOfCollada(const std::string& text);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A link's mass and inertia as its URDF states them, and as a body can have them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "env/urdf/urdf_model.h"

namespace floorproof {

struct StatedMass {
  double mass_kg = 0;
  Vec3 com = Vec3::Zero();  // in the link's frame
  // About the centre, along the axes of the <inertial>'s own frame; NaN: none, or all zeros.
  Mat3 inertia = Mat3::Zero();
  Mat3 axes = Mat3::Identity();  // of that frame in the link's
};

// The link's `mass`; its shapes and place are known. An inertia that no body can have is replaced
// by that of a box around the link's shapes, and a note says so. Throws InputError for a mass
// below 0.
void ReadMass(const StatedMass& stated, const Mat3& R_ML, const std::filesystem::path& file,
              UrdfLink& link, std::vector<std::string>& notes);

// Of the box around the shape along its own axes, m3.
double BoxVolume(const UrdfShape& shape);

// Of a solid box around the shapes, with this mass.
MassOf BoxMass(const std::vector<UrdfShape>& shapes, double mass_kg);

}  // namespace floorproof

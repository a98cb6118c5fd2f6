// SPDX-License-Identifier: Apache-2.0
// A URDF as MuJoCo's importer and compiler understand it: links, joints, shapes and masses, with
// joints at 0 (or at what of their range is nearest). All stand in one frame M: the root link's, or
// another one that the model has been moved into.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/input_files.h"
#include "env/geometry/geometry.h"

namespace floorproof {

using Mat3 = Eigen::Matrix3d;

struct UrdfShape {
  enum class Kind { kBox, kCylinder, kSphere, kCapsule, kHull };
  Kind kind = Kind::kBox;
  Vec3 size = Vec3::Zero();  // half sizes; radius and half length along z; radius
  std::vector<Vec3> hull;    // kHull: corners, in the shape's frame
  Vec3 p_M = Vec3::Zero();
  Mat3 R_M = Mat3::Identity();
  std::array<float, 4> rgba = {};
  bool collides = false;  // else it is only seen

  // Points whose hull is the shape, or nearly.
  std::vector<Vec3> Points() const;
};

// Of any number of links: their mass, its centre, and the inertia about that, along M's axes.
struct MassOf {
  double mass_kg = 0;
  Vec3 com_M = Vec3::Zero();
  Mat3 inertia_M = Mat3::Zero();
  // As one rigid body.
  MassOf& operator+=(const MassOf& other);
};

struct UrdfLink {
  enum class Joint { kFixed, kHinge, kSlide, kBall };
  std::string name;
  int parent = -1;  // index, before this one
  Joint joint = Joint::kFixed;
  std::string joint_name;
  Vec3 p_M = Vec3::Zero();                   // of its frame
  Vec3 axis_M = Vec3::Zero();                // unit
  bool turns_freely = false;                 // a hinge that is continuous, or whose limits are none
  double effort_nm = 0, velocity_radps = 0;  // as its <limit> says; 0: none
  MassOf mass;
  std::vector<UrdfShape> shapes;
  std::string lost_mesh;  // why the mesh of a <collision> cannot be read; empty: all meshes can
};

struct UrdfModel {
  std::string name;
  std::vector<UrdfLink> links;  // the root first; a link stands behind its parent
  std::vector<std::string> notes;

  // Into the frame N with this pose in M.
  void MoveInto(const Mat3& R_MN, const Vec3& p_MN);
};

// Throws InputError naming what MuJoCo does not take, or what no robot has.
UrdfModel ReadUrdfModel(const std::filesystem::path& file, const InputFiles& files);

}  // namespace floorproof

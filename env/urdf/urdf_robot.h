// SPDX-License-Identifier: Apache-2.0
// What of a URDF is which part of a floor robot.
//
// Links that no joint lets turn for ever are one rigid body: arms, doors and suspensions are held
// where they stand. What turns for ever about a horizontal axle, and reaches the floor, is a
// wheel; below a vertical axle it is a swivel caster. What of the body itself reaches the floor,
// and is no wider than a wheel, is a ball caster. The floor lies below the lowest wheel.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "env/core/robot_spec.h"
#include "env/urdf/urdf_answers.h"
#include "env/urdf/urdf_model.h"

namespace floorproof {

// In the robot's frame B: on the floor, below the middle of the driven wheels.
struct UrdfWheel {
  std::string name;  // of its joint
  Vec3 p_B = Vec3::Zero();
  Vec3 axle_B = Vec3::UnitY();
  double radius_m = 0, half_width_m = 0;             // the latter of what touches the floor
  double roller_radius_m = 0, roller_angle_rad = 0;  // Mecanum wheels', as in WheelSpec
  double effort_nm = 0, velocity_radps = 0;
  MassOf mass;
  std::vector<UrdfShape> looks;
};

struct UrdfCaster {
  std::string name;
  // Ball: a foot of this radius. Swivel: the fork turns about the pivot's vertical, the wheel in
  // it. Wheel: it rolls, and its axle stands still.
  enum class Kind { kBall, kSwivel, kWheel };
  Kind kind = Kind::kBall;
  Vec3 pivot_B = Vec3::Zero();
  UrdfWheel wheel;  // of a ball: its place and radius alone
  MassOf fork;
  std::vector<UrdfShape> fork_looks;
};

struct UrdfRobot {
  std::string name;
  std::string drive;
  bool holonomic = false;
  std::vector<UrdfWheel> wheels;
  std::vector<UrdfCaster> casters;
  MassOf base;
  std::vector<UrdfShape> shapes;  // of the base
  std::optional<Vec3> lidar_B, imu_B;
  std::vector<std::string> notes;
  std::vector<std::string> wrong;  // parts of the robot that are missing in this model

  double mass_kg() const;
};

struct DriveChoice {
  std::string name;
  bool holonomic = false;
};
// The drive that takes these wheels (their places, radii and names are filled in); none: `why`.
using ChooseDrive =
    std::function<std::optional<DriveChoice>(const RobotSpec& robot, std::string& why)>;

// Throws InputError where it finds no driven wheels, no mass, or no drive that takes them.
UrdfRobot FindRobotParts(const std::filesystem::path& file, UrdfModel model,
                         const UrdfAnswers& answers, const ChooseDrive& choose);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a robot stands on, and what it is seen as: read from its compiled model.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "env/scene/robot_model.h"

namespace floorproof {

// A wheel or caster, as the model stands. B is the body frame; its floor is z = 0.
struct Carrier {
  std::string name;               // of its body; of an unnamed one, "body N"
  Vec3 p_B = Vec3::Zero();        // the middle of its lowest points; z is its gap to the floor, m
  bool driven = false;            // by a wheel's motor
  std::vector<Vec2> footprint_B;  // its lowest points, from above
};

// An edge of the support, counter-clockwise.
struct SupportEdge {
  Vec2 a_B = Vec2::Zero(), b_B = Vec2::Zero();
  double tip_rad = 0;      // standing, the robot goes over it at this tilt: atan(d / h)
  double bearing_rad = 0;  // of its outward normal in B
};

struct RobotStance {
  std::vector<Carrier> carriers;
  std::vector<SupportEdge> edges;   // of the hull of the carriers' lowest points; shortest left out
  std::optional<double> lidar_z_m;  // of the site `lidar`, over the floor
};

RobotStance StanceOf(const RobotModel& robot);

// One geom, as its picture needs it.
struct RobotPart {
  enum class Kind { kBody, kWheel, kCaster, kLook };
  Kind kind = Kind::kBody;
  std::vector<Vec3> points_B;  // their convex hull is the geom, or nearly
  std::array<float, 4> rgba = {};
};

// Every geom that is not transparent, as the model stands.
std::vector<RobotPart> PartsOf(const RobotModel& robot);

}  // namespace floorproof

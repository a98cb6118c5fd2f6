// SPDX-License-Identifier: Apache-2.0
// Cameras that film a robot: auto, chase, top, side. They know nothing of GL.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "base/error.h"
#include "base/registry.h"
#include "env/geometry/geometry.h"

namespace floorproof {

struct CameraView {
  Vec3 eye_W = Vec3::Zero();      // m
  Vec3 target_W = Vec3::UnitX();  // a point in the middle of the picture, not the eye
  Vec3 up_W = Vec3::UnitZ();      // not along the line of sight
  double fovy_rad = 0.7;          // full vertical angle; ignored when orthographic
  bool orthographic = false;
  double height_m = 1;  // what the picture is high, when orthographic
};

// What a camera films: the site's floor, as an upright box in the world frame, and the robot.
struct FilmSet {
  Vec2 low_W = Vec2::Zero(), high_W = Vec2::Ones();  // m
  double robot_radius_m = 0.25;
  double aspect = 16.0 / 9.0;  // width / height of the picture
};

// How a picture follows the one before.
struct CameraCue {
  double dt_s = 0;      // of film
  double speed_up = 1;  // the robot moved for speed_up * dt_s
  // Where something holds, tips or meets the robot, so that wheels and floor are to be seen: the
  // direction in which it came there (world frame, rad).
  std::optional<double> contact_rad = {};
};

// Follows the robot smoothly. Time is the film's, not the robot's: what must not jerk is the
// picture.
class Camera {
 public:
  virtual ~Camera() = default;
  virtual void Reset(const FilmSet& set, const Pose2& X_WB) = 0;
  virtual CameraView Next(const Pose2& X_WB, const CameraCue& cue) = 0;
};

std::span<const PluginEntry<Camera>> Cameras();

}  // namespace floorproof

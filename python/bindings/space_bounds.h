// SPDX-License-Identifier: Apache-2.0
// The spaces that a policy's actions and observations lie in. Those of an environment are those of
// its first episode, and hold for all that follow.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "env/core/observation.h"

namespace floorproof {

struct Scenario;
struct ScenarioSpec;

struct SpaceBounds {
  std::string robot;
  bool holonomic = false;
  float max_speed_mps = 0, max_yaw_rate_radps = 0;

  std::size_t beams = 0;
  float lidar_m = 0;                   // ranges: from 0
  std::array<float, 2> low{}, high{};  // x, y of the pose, m
  std::array<float, 3> fastest{};      // vx, vy (m/s), wz (rad/s), either way
  float plan_m = 0;                    // the plan ahead, either way

  // What of an episode's `own` these do not hold, in words: "lidar, pose"; empty: all is held.
  std::string Lacks(const SpaceBounds& own) const;
};

// Of one episode. Throws InputError where there is no lidar.
SpaceBounds SpaceBoundsOf(const Scenario& scenario, const LidarScan& scan);

// Throws InputError where an episode cannot be told, or driven, in these spaces: another number of
// beams, or of the action's numbers.
void RequireSameShape(const ScenarioSpec& spec, const SpaceBounds& own, const SpaceBounds& spaces);

}  // namespace floorproof

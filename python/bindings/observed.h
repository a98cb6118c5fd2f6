// SPDX-License-Identifier: Apache-2.0
// What a policy is told of an episode, in arrays that stay where they are.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "python/bindings/local_map.h"
#include "python/bindings/space_bounds.h"
#include "run/episode/episode.h"

namespace floorproof {

struct Scenario;

// How finely, and how far ahead.
struct Outlook {
  int local_cells = 0;
  double local_cell_m = 0;
  int plan_points = 0;  // after the target so many points of the plan ahead, plan_step_m apart
  double plan_step_m = 0;
};

class Observed {
 public:
  // Throws InputError.
  Observed(const Scenario& scenario, const Outlook& outlook);

  // Before the drive; `follows`: the plan ahead is told, too. `spaces`: that all is told in, cut to
  // their ends; nullptr: the episode's own. Throws InputError.
  void Begin(const Scenario& scenario, SteppedEpisode& episode, bool follows,
             const SpaceBounds* spaces);
  // Once a control period.
  void Note(const Estimate& estimate) { local.Sweep(estimate.X_WB); }
  // Fills the arrays. `target_W`: where a tracker would head for; none before the first period.
  // Allocates nothing.
  void Look(SteppedEpisode& episode, const std::optional<Vec2>& target_W);

  LocalMap local;
  std::vector<float> lidar;      // ranges, m
  std::vector<float> ahead;      // x, y, x, y, ... in the robot's own frame, m
  std::array<float, 4> pose{};   // x, y, cos and sin of the yaw, as the robot thinks
  std::array<float, 3> twist{};  // vx, vy, wz, as the robot thinks
  float coverage = 0;
  std::array<double, 5> state{};  // time, coverage, and the true pose

  SpaceBounds bounds;  // between which all numbers lie
  std::string lacks;   // what of this episode is cut to them, in words

 private:
  void LookAhead(const RobotSide& robot, const Pose2& X_WB, const std::optional<Vec2>& target_W);

  Outlook outlook_;
  float scan_most_m_ = 0;  // what does not come back is told as this
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Help after a failure, as a person gives it (the key `on_failure: assist`).
//
// A failure calls the person, who takes kComes_s to come; the robot's motors stand still till then.
// It is set down at the first waypoint ahead, past the segment that it tracks, where its footprint
// touches no hazard of any class, known or not, and no wall; heading as the plan does there. It
// goes on from that waypoint, thinking that it is where it thought it was: only `truth` knows
// better. Each time it is at least one waypoint further, but for a stop whose dwell was not over,
// which it is given once more: so that an episode ends.
// Not modelled: what gyro, accelerometer or lidar would tell while it is carried.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "env/core/path.h"
#include "env/sim/plant.h"
#include "run/episode/episode.h"
#include "run/episode/robot_side.h"
#include "run/scenario/scenario_params.h"

namespace floorproof {

struct World;

// The first waypoint from `first` on at which the robot can be set down, and how it then stands;
// none: no such waypoint. Only on the floor that hangs together with the start: elsewhere the scene
// has no walls.
struct SetDownPlace {
  std::size_t waypoint = 0;
  Pose2 X_WB;
};
std::optional<SetDownPlace> PlaceAhead(const World& world, const Path& path, std::size_t first);

class Interventions {
 public:
  static constexpr double kComes_s = 30;

  // Both outlive it.
  Interventions(const EpisodeParams& params, const World& world) : params_(params), world_(world) {}

  // The robot failed on this path, just now. False: nobody comes, and why_not() says why where it
  // is not the scenario's choice.
  bool Call(const Path& path, const Sample& failed);
  const std::string& why_not() const { return why_not_; }

  bool awaited() const { return place_.has_value(); }
  bool HasCome(double t_s) const { return awaited() && t_s >= comes_s_ - 1e-9; }
  // Carries the robot and sends it on its way; from here on nobody is awaited.
  Intervention SetDown(Plant& plant, RobotSide& side);
  // What waiting adds to a time limit that the scenario does not write.
  double extra_s() const { return params_.time_limit_s ? 0 : calls_ * kComes_s; }

 private:
  const EpisodeParams& params_;
  const World& world_;
  std::optional<SetDownPlace> place_;  // to which it will be carried
  double comes_s_ = 0;
  int calls_ = 0;
  std::string why_not_;
};

}  // namespace floorproof

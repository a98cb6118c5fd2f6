// SPDX-License-Identifier: Apache-2.0
// Drives where a planner of unknown floors says. The planner is asked at the start, after a look
// around; shortly before each target is reached, so that the robot need not stop there; after the
// robot has gone back from what it met; where something comes into sight across its way; and where
// it has come off its way, towards something. Beside what it knows of, the robot stops where its
// way bends, so that it does not cut the corner.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "controllers/navigator.h"
#include "planners/online/online_planner.h"

namespace floorproof {

class OnlineNavigator final : public Navigator {
 public:
  // What stays the same all the time. The known map's frame is the task's ground, the robot's first
  // estimate its start.
  struct Robot {
    Extent body, clear, tool;  // `clear`: the body, and the margin to be kept around it
    double tool_width_m = 0;
    double brakes_mps2 = 0;         // that it plans with
    std::optional<double> yaw_rad;  // that it holds; none: it faces where it goes
  };
  // `planner` outlives it.
  OnlineNavigator(OnlinePlanner& planner, const Robot& robot, const Vec2& start_W,
                  std::uint64_t seed);

  const Path& path() const override { return path_; }
  PathChange Update(const NavigatorInput& input) override;
  Leads leads() const override { return leads_; }
  std::string_view why() const override { return why_; }
  const Path& plan() const override { return driven_; }
  void GoOnFrom(std::size_t waypoint) override;

 private:
  bool HasLooked(const NavigatorInput& input);
  PathChange FromHere(const NavigatorInput& input, bool stopped);
  PathChange GoOn(const NavigatorInput& input);
  PathChange StopAhead(const NavigatorInput& input);
  void LeaveOut(std::size_t targets);
  bool Ask(const NavigatorInput& input, std::size_t reached, bool stopped);
  bool StopAtNarrowBends(const KnownMap& known, std::size_t segment);
  bool IsNarrow(const KnownMap& known, const Vec2& p_W) const;
  double BrakingDistance(const Estimate& estimate) const;
  void LayOnGrid(const NavigatorInput& input, const Vec2& from_W);
  bool PassesOver(Cell c, const Extent& body, double slack) const;
  bool IsBlocked(const NavigatorInput& input);
  bool IsAstray(const NavigatorInput& input);
  Waypoint At(const Vec2& p_W) const;

  OnlinePlanner& planner_;
  Robot robot_;
  std::uint64_t seed_;
  Path path_, driven_;
  std::vector<Vec2> on_grid_;  // what is left of the path, in cells of the known map
  Leads leads_ = Leads::kOn;
  std::string_view why_;
  std::vector<Cell> changed_;  // of the known map, since the planner was asked last
  std::optional<double> since_s_;
  bool started_ = false, any_target_ = false;
  int vain_ = 0;
  // The waypoint of path_ with which the planner was asked last as the robot's place.
  std::size_t asked_from_ = 0;
};

}  // namespace floorproof

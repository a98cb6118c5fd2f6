// SPDX-License-Identifier: Apache-2.0
// How high the floor lies that a plan may drive over.
#pragma once

#include <algorithm>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/motion.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// The floor on which the robot was set down, and each level beside it that the plan may drive over:
// known, and low enough or high enough beside that floor for the robot, or at an end of a known
// ramp, which it may drive over too. The base floor is a level as others are.
class PlanFloor {
 public:
  PlanFloor() = default;
  // Both outlive this.
  PlanFloor(const HazardMap& map, const RobotSpec& robot);

  // The robot is set down where `sample` says: whoever sets it down on a level means it to drive
  // there. Before what follows. Allocates nothing.
  void SetDown(const Sample& sample);
  bool IsSetDown() const { return set_down_; }

  double start_m() const { return start_m_; }      // of the floor on which it was set down
  double highest_m() const { return highest_m_; }  // that the plan can have
  // The lowest under the robot's centre or one of its wheels. Allocates nothing.
  double Under(const Sample& sample) const;
  // Whether this place is base floor.
  bool IsBase(const Vec2& p_W) const;

 private:
  struct Level {
    const Hazard* hazard = nullptr;  // none: the base floor
    double height_m = 0;             // of a ramp, its end's
    bool driven = false;
    bool IsRamp() const;
    bool Holds(const Vec2& p_W) const;
    double HeightAt(const Vec2& p_W) const;
  };
  bool IsDriven(const Level& level) const;
  double At(const Vec2& p_W) const;
  template <class Look>
  void ForEachFoot(const Sample& sample, const Look& look) const;

  const HazardMap* map_ = nullptr;
  const RobotSpec* robot_ = nullptr;
  std::vector<Level> levels_;  // in the map's order
  bool set_down_ = false;
  double start_m_ = 0, highest_m_ = 0;
};

}  // namespace floorproof

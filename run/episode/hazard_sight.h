// SPDX-License-Identifier: Apache-2.0
// Which hazards a robot's own sensors tell of, and whether in time to stop.
//
// It looks on: what a sensor says is laid onto the true floor at the true pose, so that only the
// sensors are judged, and no estimate. A hazard is sensed by the first beam that ends at a solid of
// its own that reaches up to the scan plane, or by the first sensor that sees a drop over it. A
// bump comes too late for all. In time: what was left of the way, when it was sensed, was as long
// as it takes to stop from the speed of then, one control period and braking at max_accel.
//
// What it cannot tell: an end of a beam within some centimetres of two things is the nearer's. Nor
// does it know of casters: one that hangs over a drop is not upon it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/motion.h"
#include "env/core/observation.h"
#include "env/core/robot_spec.h"
#include "env/geometry/box.h"

namespace floorproof {

class HazardSight {
 public:
  // All outlive it. `map`: the true one.
  HazardSight(const HazardMap& map, const RobotSpec& robot, double control_s);
  // Whether any of these tells of hazards.
  static bool Sees(std::span<const Reading> readings);

  // Once a control period: what was sensed now, here. Takes time as beams and hazards near their
  // ends.
  void OnControl(const Observation& sensed, const Sample& sample);

  // Of that id; -1: none.
  int IndexOf(const std::string& hazard) const;
  // Whether the robot is upon it now: it touches it, or a driven wheel stands over it.
  bool IsUpon(int hazard, const Sample& sample) const;
  // The robot meets this hazard here and now: whether it was sensed in time.
  bool InTime(int hazard) const;

 private:
  struct Seen {
    double way_m = 0, stop_m = 0;  // gone then; that it took to stop
  };
  struct Part {
    int hazard = 0;
    Polygon base_W;
    Box2 box;
    double low_m = 0, high_m = 0;
  };

  void SeeScan(const LidarScan& scan, const Sample& sample);
  void SeeDrops(const CliffRing& cliffs, const Pose2& X_WB);
  void See(int hazard);
  bool IsAtWall(const Vec2& p_W, double reach_m) const;

  const HazardMap& map_;
  const RobotSpec& robot_;
  double control_s_;
  std::vector<Part> parts_;            // solids that a beam can meet
  std::vector<const Part*> in_plane_;  // those that this scan's beams can
  std::vector<std::optional<Seen>> seen_;
  double way_m_ = 0, speed_mps_ = 0;
  std::optional<Vec2> last_W_;  // where the way was last added up
};

}  // namespace floorproof

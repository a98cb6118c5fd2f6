// SPDX-License-Identifier: Apache-2.0
// Draws the map that a robot sees: scans, bumps and drops, placed at the pose that it believes.
//
// An occupancy grid of log odds (Moravec & Elfes, "High resolution maps from wide angle sonar",
// 1985; in this form Thrun, Burgard & Fox, "Probabilistic Robotics", 2005, table 9.1). A beam makes
// the cells that it passes more likely free, and the cell in which it ends more likely occupied. A
// beam that does not come back says nothing: it may have met black cloth or gone through glass.
// With `glass` it takes heed of where things were seen from, after Foster, Sun, Park & Kuipers,
// "VisAGGE: Visible angle grid for glass environments", 2013: glass is seen head-on, from near by,
// and beams that pass it askew afterwards do not free it.
// Where the robot stands, the floor is free. What was touched, or has no floor, is marked for good,
// because scans pass over it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/params.h"
#include "env/core/motion.h"
#include "env/core/observation.h"
#include "env/core/robot_spec.h"
#include "env/known/known_map.h"

namespace floorproof {

class Mapper final : public Configurable {
 public:
  void Visit(ParamVisitor& v) override;
  // What it draws by; without it keeps what was met.
  static std::vector<Reading> Needs() { return {Reading::kScan}; }

  // How many cells its map of this ground has.
  double CellsOn(const GridFrame& site) const;
  // An empty map on this ground; `site` says where it ends, no more. `tells`: its map tells what
  // has changed (KnownMap::changed), until ForgetChanges().
  void Start(const GridFrame& site, const RobotSpec& robot, bool tells = false);
  void ForgetChanges() {
    if (map_.changed) map_.changed->clear();
  }
  // One control period. Takes time as the beams' length; allocates only for marks.
  void Update(const Observation& sensed, const Estimate& estimate);

  const KnownMap& map() const { return map_; }

 private:
  void AddScan(const LidarScan& scan, const Pose2& X_WB);
  void AddBeam(const Vec2& from_G, const Vec2& to_G, double yaw_rad);
  void See(Cell c, double yaw_rad);
  bool SaysNothing(Cell c, double yaw_rad) const;
  void Mark(FloorMark::Kind kind, const Vec2& p_W) { map_.Mark(kind, p_W, mark_m_ / 2); }
  void Add(int ix, int iy, double log_odds) { map_.Add(ix, iy, log_odds, most_); }

  double cell_m_ = 0.05, hit_ = 0.85, miss_ = 0.4, most_ = 4, mark_m_ = 0.1, range_m_ = 12;
  bool glass_ = false;
  const RobotSpec* robot_ = nullptr;
  KnownMap map_;
  // With glass: the line along which a cell was seen, on the mean of the short beams that ended
  // there since it was last free.
  struct Seen {
    float yaw_rad = 0;
    std::uint16_t beams = 0;
  };
  Grid<Seen> seen_;
  Grid<std::uint32_t> last_end_;  // the number of the scan of which a beam last ended in a cell
  std::uint32_t scans_ = 0;
  std::vector<Cell> ends_;  // of this scan
  Pose2 X_GW_;
  Vec2 stood_W_ = Vec2::Constant(1e9);  // where the robot last freed the floor
  bool pressed_ = false;                // in the last period
  std::array<bool, CliffRing::kMax> dropped_{};
};

}  // namespace floorproof

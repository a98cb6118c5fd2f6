// SPDX-License-Identifier: Apache-2.0
// What a path costs in risk: which cells the robot's centre visits, how often, and the sum of RF.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "env/core/path.h"
#include "planners/risk/risk_map.h"

namespace floorproof {

// The centre counts as in a cell until it is a tenth of a cell's width beyond it. So a robot that
// drives along a border, or wavers on it, visits the cells of one side, each once. Add() allocates
// nothing.
class RiskMeter {
 public:
  explicit RiskMeter(const RiskMap& risk);
  // The centre moved in a straight line from the last place to this one (the first only stands).
  void Add(const Vec2& p_W);
  // The robot was carried to another place: the next Add() starts afresh.
  void Lift();

  double cumulative_risk() const { return sum_; }  // RF of each visit
  int visits() const { return visits_; }
  int terrain_crossings() const { return crossings_; }  // runs of visits to terrain (C4)
  const Grid<std::int32_t>& visits_of() const { return visits_of_; }  // on the risk's frame
  const RiskMap& risk() const { return *risk_; }

 private:
  void Visit(Cell cell);

  const RiskMap* risk_;
  Grid<std::int32_t> visits_of_;
  std::optional<Cell> in_;
  std::optional<Vec2> last_G_;  // in cells
  double sum_ = 0;
  int visits_ = 0, crossings_ = 0;
};

// The paper's measures of a path (its Figures 3, 5 and 6).
struct RiskOfPath {
  double cumulative_risk = 0;  // CRF
  // RF of the cells that it visits, each once: no path over them has less.
  double each_cell_once = 0;
  int visits = 0, cells = 0;  // cells: visited at least once
  double coverage = 0;        // of the hazard-free cells that can be reached over floor and terrain
  int terrain_crossings = 0;
  struct Range {
    double low = 0, high = 0;  // RF; the last one's upper end belongs to it
    int cells = 0;             // that are no solid
    int visits = 0;
  };
  std::vector<Range> ranges;  // ten equal ones over the RF of the cells that are no solid
  Grid<std::int32_t> visits_of;
};
RiskOfPath MeasureRisk(const RiskMap& risk, const Path& path);

}  // namespace floorproof

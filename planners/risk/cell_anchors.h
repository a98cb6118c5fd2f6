// SPDX-License-Identifier: Apache-2.0
// Anchors: the cells of the risk's grid at which a plan begins and ends, given the robot's place.
#pragma once

#include <optional>
#include <string>

#include "env/core/coverage.h"
#include "planners/planner.h"
#include "planners/risk/risk_map.h"

namespace floorproof {

class CellAnchors {
 public:
  explicit CellAnchors(const PlanRequest& request);  // has a risk; outlives it

  // The free cell that holds p_W, if the robot at p_W lies within it. Else, beside a wall or a
  // solid cell, the nearest free cell to which the robot can drive straight. None: `why` says why
  // not.
  std::optional<Cell> At(const Vec2& p_W, std::string& why);

 private:
  std::string Width() const;
  bool LiesWithin(Cell cell, const Vec2& p_W) const;
  const SweepArea& area();
  bool Reaches(Cell fine);
  bool Fits(const Vec2& p_W);
  bool Sees(const Vec2& a_W, const Vec2& b_W);
  bool IsClear(const Vec2& p_W);

  const PlanRequest& request_;
  const RiskGrid& grid_;
  std::optional<SweepArea> area_;
};

// "(1.25, 0.75) m, cell (2, 1) of 0.5 m", to the millimetre.
std::string DescribePlace(const GridFrame& cells, const Vec2& p_W);

}  // namespace floorproof

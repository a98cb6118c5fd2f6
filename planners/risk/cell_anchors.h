// SPDX-License-Identifier: Apache-2.0
// Which cell of the risk's grid a place of the robot belongs to: where a plan begins and ends.
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

  // The free cell that holds p_W and the robot there; where it stands beside a wall or solid, the
  // nearest free one that it can drive straight to. None: `why` says why not.
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

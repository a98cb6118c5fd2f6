// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/high_risk.h"

#include <algorithm>
#include <functional>

#include "planners/risk/terrain_wave.h"

namespace floorproof {
namespace {

constexpr double kWithLevelChanges = 0.15, kWithout = 0.03;  // section 2.3

// 1 for the cells of high risk: that share of the cells within the outer walls which has the
// highest RF. Of cells with equal RF all are taken or none.
Grid<std::uint8_t> HighRisk(const RiskMap& risk, const std::optional<double>& given) {
  std::vector<double> rf;
  bool level_changes = false;
  const auto& cells = risk.grid.contents.cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].outer_wall()) continue;
    rf.push_back(risk.rf.cells[i]);
    level_changes |= cells[i].hazard == HazardClass::kLevelChange;
  }
  Grid<std::uint8_t> high(risk.rf.width, risk.rf.height);
  const double share = given.value_or(level_changes ? kWithLevelChanges : kWithout);
  const auto most = static_cast<std::size_t>(share * static_cast<double>(rf.size()));
  if (most >= rf.size()) {
    std::ranges::fill(high.cells, 1);
    return high;
  }
  std::ranges::nth_element(rf, rf.begin() + static_cast<std::ptrdiff_t>(most), std::greater<>());
  for (std::size_t i = 0; i < cells.size(); ++i) high.cells[i] = risk.rf.cells[i] > rf[most];
  return high;
}

}  // namespace

void HighRiskParams::Visit(ParamVisitor& visit) {
  visit("high_risk_share", share, Between(0, 1),
        "of the cells within the outer walls that count as obstacles, those of the highest RF; "
        "none: the paper's 0.15 with level changes, 0.03 without");
}

LowRisk LowRiskFloor(const CellTask& task, const HighRiskParams& params) {
  LowRisk out;
  Grid<std::uint8_t> high = HighRisk(task.risk, params.share);
  // These are no cells of high risk after all, if there is no way from start to end without them.
  for (const Cell cell : LeastCostPath(
           task.drivable, {task.start},
           [&](Cell c) { return high(c) && task.free(c) ? task.risk.rf(c) : 0; },
           [&](Cell c) { return c == task.end; }))
    high(cell) = 0;

  // What can be reached without cells of high risk, over any terrain.
  Grid<std::uint8_t> passable = task.drivable;
  for (std::size_t i = 0; i < passable.cells.size(); ++i)
    if (task.free.cells[i] && high.cells[i]) passable.cells[i] = 0;
  const Grid<std::int32_t> steps = StepsFrom(passable, task.end);
  out.open = task.free;
  for (std::size_t i = 0; i < out.open.cells.size(); ++i) {
    if (!out.open.cells[i]) continue;
    out.high_risk_cells += high.cells[i];
    out.cut_off_cells += !high.cells[i] && steps.cells[i] < 0;
    out.open.cells[i] = steps.cells[i] >= 0;
  }
  const auto before = std::ranges::count(out.open.cells, 1);
  out.wave = WaveOverTerrain(task.risk, task.end, out.open);
  out.opened_cells = static_cast<int>(std::ranges::count(out.open.cells, 1) - before);
  return out;
}

}  // namespace floorproof

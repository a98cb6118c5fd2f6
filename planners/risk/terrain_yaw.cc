// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/terrain_yaw.h"

#include <algorithm>

#include "planners/search/grid_paths.h"

namespace floorproof {

bool HoldsYaw(const RobotSpec& robot) {
  return robot.clear.kind == Shape2::Kind::kFootprint &&
         std::ranges::any_of(robot.wheels,
                             [](const WheelSpec& wheel) { return wheel.roller_angle_rad != 0; });
}

std::vector<int> QuartersOverTerrain(const RiskGrid& grid, const std::vector<Cell>& tour, int first,
                                     TerrainLead lead) {
  if (lead == TerrainLead::kAny) return std::vector<int>(tour.size(), first);
  const bool sideways = lead == TerrainLead::kSideways;
  std::vector<int> turns(tour.size(), 0);  // quarters turned on the way to each cell
  const auto along_y = [&](std::size_t i) { return tour[i].ix == tour[i - 1].ix; };
  const auto roomy = [&](std::size_t i) {
    return grid.contents(tour[i]).free() && std::ranges::all_of(kSideSteps, [&](Cell step) {
             const Cell beside = tour[i] + step;
             return grid.contents.Inside(beside) && !grid.contents(beside).solid;
           });
  };
  std::size_t behind = 0;  // where the terrain before has been left
  int quarter = first;
  for (std::size_t i = 1; i < tour.size(); ++i) {
    const bool on = grid.contents(tour[i]).terrain(), from = grid.contents(tour[i - 1]).terrain();
    if (from && !on) behind = i;
    if (!on || from || along_y(i) == ((quarter % 2 == 1) != sideways)) continue;
    // The turn is made in a cell, so on the way to the next one.
    std::size_t turn = 0;
    bool bends = false;
    for (std::size_t k = i - 1; k > behind && !bends; --k) {
      if (!roomy(k)) continue;
      const bool bend = along_y(k) != along_y(k + 1);
      if (turn == 0 || bend) turn = k;
      bends = bend;
    }
    if (turn == 0 && roomy(behind)) turn = behind;
    if (turn == 0 && !(behind == 0 && roomy(0))) continue;
    quarter = (quarter + 1) % 4;
    ++turns[turn + 1];
  }
  std::vector<int> quarters(tour.size());
  quarter = first;
  for (std::size_t i = 0; i < tour.size(); ++i) quarters[i] = quarter = (quarter + turns[i]) % 4;
  return quarters;
}

}  // namespace floorproof

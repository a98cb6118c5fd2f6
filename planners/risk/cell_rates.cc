// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/cell_rates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "env/core/hazard_parts.h"
#include "env/geometry/convex.h"
#include "planners/risk/risk_map.h"
#include "planners/risk/terrain_yaw.h"
#include "planners/search/index.h"

namespace floorproof {
namespace {

constexpr double kUnmeasured = 1;

// The hazard's extent in the direction in which it is thinnest, m.
double Thickness(const Hazard& hazard) {
  constexpr int kDirections = 36;
  double least = std::numeric_limits<double>::infinity();
  for (int d = 0; d < kDirections; ++d) {
    const Vec2 along(std::cos(d * kPi / kDirections), std::sin(d * kPi / kDirections));
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Polygon& polygon : hazard.footprint)
      for (const Vec2& p : polygon)
        low = std::min(low, along.dot(p)), high = std::max(high, along.dot(p));
    least = std::min(least, high - low);
  }
  return std::max(0.0, least);
}

// Directions that a slope may be met in; all else is the same for all.
std::vector<Vec2> Travels(const Hazard& hazard) {
  if (std::ranges::none_of(hazard.solids, IsSlope)) return {Vec2(1, 0)};
  std::vector<Vec2> travels;
  constexpr int kDirections = 8;
  for (int d = 0; d < kDirections; ++d) {
    const double yaw_rad = 2 * kPi * d / kDirections;
    travels.emplace_back(std::cos(yaw_rad), std::sin(yaw_rad));
  }
  return travels;
}

// Rates of a hazard, whatever place of it is met.
struct HazardRates {
  double over = 0, beside = 0;  // a cell of the way
};

HazardRates RatesOf(const Hazard& hazard, const PlanRequest& request, const PathRates& rates) {
  if (!IsOfTheSite(hazard)) return {};
  const RobotSpec& robot = request.robot;
  const double cell_m = request.risk->grid.frame.cell_m, thick_m = Thickness(hazard);
  const std::vector<Vec2> travels = Travels(hazard);
  std::vector<double> leads = {0};
  if (HoldsYaw(robot)) leads = {0, kPi / 2, kPi, -kPi / 2};
  const auto least = [&](Passage passage, Approach at) {
    double best = std::numeric_limits<double>::infinity();
    std::vector<double> speeds = rates.Speeds(hazard, passage);
    speeds.push_back(robot.cruise_mps);
    for (at.speed_mps = 0; const double speed_mps : speeds)
      for (const double lead_rad : leads) {
        at.speed_mps = speed_mps;
        at.lead_rad = lead_rad;
        for (const Vec2& travel_W : travels)
          if (const auto rate = rates.Expected(hazard, passage, at, travel_W))
            best = std::min(best, *rate);
      }
    return best;
  };
  HazardRates out;
  Approach across;
  across.width_share = 1;
  across.over_m = thick_m + 2 * robot.inscribed_radius_m;
  across.wall_m = kFarWall_m;
  const double over = least(Passage::kOver, across);
  out.over =
      (std::isfinite(over) ? over : kUnmeasured) / std::max(1.0, std::round(thick_m / cell_m));
  Approach along;
  along.heading_rad = kPi / 2;
  along.gap_m = kReach_m / 2;
  along.over_m = cell_m;
  along.wall_m = kFarWall_m;
  const double beside = least(Passage::kBeside, along);
  out.beside = std::isfinite(beside) ? beside : 0;
  return out;
}

}  // namespace

Grid<double> CellRates(const PlanRequest& request, const PathRates& rates) {
  const RiskGrid& grid = request.risk->grid;
  const GridFrame& frame = grid.frame;
  Grid<double> out(grid.contents.width, grid.contents.height);
  HazardParts parts(request.map);
  if (parts.empty()) return out;
  std::vector<HazardRates> known;
  for (const Hazard& hazard : request.map.hazards) known.push_back(RatesOf(hazard, request, rates));
  for (std::size_t i = 0; i < out.cells.size(); ++i) {
    const RiskCell& content = grid.contents.cells[i];
    if (content.solid) continue;
    const Vec2 centre = frame.Center(CellAt(out, i));
    Polygon square;
    for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
      square.push_back(frame.X_WG * (frame.ToGrid(centre) + frame.cell_m / 2 * corner));
    const Box2 box = BoxAround(square);
    const Vec2 reach(kReach_m, kReach_m);
    int last = -1;  // parts come by hazard
    parts.Near(box.low - reach, box.high + reach, [&](const HazardParts::Part& part) {
      if (part.hazard == last) return;
      const double gap_m = Separate(square, part.polygon_W).distance_m;
      const HazardRates& rate = known[static_cast<std::size_t>(part.hazard)];
      const bool over = content.terrain() && gap_m < 0;
      if (!over && (content.terrain() || gap_m > kReach_m)) return;
      last = part.hazard;
      out.cells[i] += over ? rate.over : rate.beside;
    });
  }
  return out;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/core/drawn_map.h"

#include <algorithm>

#include "env/core/coverage.h"
#include "env/geometry/distance.h"

namespace floorproof {
namespace {

constexpr int kCorners = 8;  // of the polygon around a mark

}  // namespace

HazardMap WithSeen(const HazardMap& map, const KnownMap& known, double step_m, double slack_m) {
  HazardMap with = map;
  const GridFrame& frame = known.frame;
  const Grid<float> away = DistanceToCentres(ObstacleMask(map, step_m, frame));
  const auto slack = static_cast<float>(slack_m / frame.cell_m + 1e-6);
  Hazard seen;
  seen.id = seen.type = "seen";
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix) {
      if (known.log_odds(ix, iy) < KnownMap::kSure || away(ix, iy) <= slack) continue;
      const Vec2 low = frame.cell_m * Vec2(ix, iy), high = frame.cell_m * Vec2(ix + 1, iy + 1);
      Polygon& cell = seen.footprint.emplace_back();
      for (const Vec2& p : Rectangle(low, high)) cell.push_back(frame.X_WG * p);
    }
  if (!seen.footprint.empty()) with.hazards.push_back(std::move(seen));
  return with;
}

HazardMap WithMarks(const HazardMap& map, const std::vector<FloorMark>& marks) {
  HazardMap marked = map;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const FloorMark& mark = marks[i];
    Hazard hazard;
    hazard.id = "mark-" + std::to_string(i);
    hazard.type = "mark";
    const double corner_m = mark.radius_m / std::cos(kPi / kCorners);
    hazard.footprint = {RegularPolygon(mark.p_W, corner_m, kCorners)};
    marked.hazards.push_back(std::move(hazard));
  }
  return marked;
}

KnownAgainstTruth Compare(const KnownMap& known, const HazardMap& truth, double step_m,
                          double slack_m) {
  using State = KnownAgainstTruth::State;
  const Grid<std::uint8_t> blocked = ObstacleMask(truth, step_m, known.frame);
  Grid<std::uint8_t> drawn(blocked.width, blocked.height);
  for (int iy = 0; iy < drawn.height; ++iy)
    for (int ix = 0; ix < drawn.width; ++ix)
      drawn(ix, iy) = known.At(ix, iy) == CellState::kOccupied;
  const Grid<float> to_blocked = DistanceToCentres(blocked), to_drawn = DistanceToCentres(drawn);
  const auto slack = static_cast<float>(slack_m / known.frame.cell_m + 1e-6);
  KnownAgainstTruth result;
  result.cells = Grid<std::uint8_t>(blocked.width, blocked.height, State::kUnknown);
  double floor = 0, floor_known = 0, all_known = 0, wrong = 0;
  for (int iy = 0; iy < blocked.height; ++iy)
    for (int ix = 0; ix < blocked.width; ++ix) {
      const CellState state = known.At(ix, iy);
      const bool open = !blocked(ix, iy);
      floor += open;
      if (state == CellState::kUnknown) continue;
      floor_known += open;
      ++all_known;
      const bool occupied = state == CellState::kOccupied;
      const int to_border = std::min({ix, iy, blocked.width - 1 - ix, blocked.height - 1 - iy});
      const bool is_wrong =
          occupied ? std::min(to_blocked(ix, iy), static_cast<float>(to_border + 1)) > slack
                   : !open && to_drawn(ix, iy) > slack;
      wrong += is_wrong;
      result.cells(ix, iy) = occupied ? (is_wrong ? State::kWronglyOccupied : State::kOccupied)
                                      : (is_wrong ? State::kWronglyFree : State::kFree);
    }
  result.known = floor > 0 ? floor_known / floor : 0;
  result.wrong = all_known > 0 ? wrong / all_known : 0;
  return result;
}

}  // namespace floorproof

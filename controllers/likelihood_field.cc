// SPDX-License-Identifier: Apache-2.0
#include "controllers/likelihood_field.h"

#include <algorithm>
#include <cmath>

#include "env/core/coverage.h"
#include "env/core/slopes.h"
#include "env/geometry/distance.h"
#include "env/geometry/rasterise.h"

namespace floorproof {
namespace {

// Whether a level scan at that height can meet it. Glass counts too: some beams end on it, and
// those that pass end on what stands behind, which is as near to a wall as any.
bool IsMet(const Hazard& hazard, double height_m) {
  return std::ranges::any_of(hazard.solids, [&](const Solid& solid) {
    return solid.kind == Solid::Kind::kPrism && solid.z_low_m < height_m &&
           solid.z_high_m > height_m;
  });
}

}  // namespace

LikelihoodField::LikelihoodField(const HazardMap& known, double height_m) {
  const GridFrame fine_frame = FineFrame(known.frame);
  const int fine = fine_frame.width / known.frame.width;
  cell_m_ = fine_frame.cell_m;
  // With a ring of cells beyond the map, which is wall: beams end there where the map ends free.
  const int width = (known.frame.width + 2) * fine, height = (known.frame.height + 2) * fine;
  X_GW_ = Pose2{known.frame.cell_m, known.frame.cell_m, 0} * known.frame.X_WG.Inverse();
  const Pose2 X_WG = X_GW_.Inverse();
  Grid<std::uint8_t> met(width, height);
  for (int iy = 0; iy < height; ++iy)
    for (int ix = 0; ix < width; ++ix) met(ix, iy) = known.IsWall(ix / fine - 1, iy / fine - 1);
  for (const Hazard& hazard : known.hazards) {
    if (!IsMet(hazard, height_m)) continue;
    const auto add = [&](Polygon polygon, const auto& is_met_at) {
      for (Vec2& p : polygon) p = (X_GW_ * p) / cell_m_;
      Rasterise(polygon, width, height, [&](int ix, int iy) {
        if (is_met_at(X_WG * Vec2(cell_m_ * Vec2(ix + 0.5, iy + 0.5)))) met(ix, iy) = 1;
      });
    };
    if (!IsRamp(hazard))
      for (const Polygon& polygon : hazard.footprint)
        add(polygon, [](const Vec2&) { return true; });
    for (const Solid& slope : hazard.solids)  // from where it is that high
      if (IsSlope(slope))
        add(slope.base, [&](const Vec2& p_W) { return TopAt(slope, p_W) > height_m; });
  }
  const Grid<float> cells_away = DistanceToCentres(met);
  // Walls that are built drawn back are met within their cells, that deep.
  Grid<float> cells_deep;
  if (known.inset_m > 0) {
    for (std::uint8_t& cell : met.cells) cell = !cell;
    cells_deep = DistanceToCentres(met);
  }
  away_ = Grid<std::uint8_t>(width, height);
  for (std::size_t i = 0; i < away_.cells.size(); ++i) {
    // Beams end at faces, half a cell before the centres.
    double away_m = std::max(0.0, static_cast<double>(cells_away.cells[i]) - 0.5) * cell_m_;
    if (known.inset_m > 0) {
      const double deep_m = std::max(0.0, static_cast<double>(cells_deep.cells[i]) - 0.5) * cell_m_;
      away_m = away_m > 0 ? away_m + known.inset_m : std::abs(deep_m - known.inset_m);
    }
    away_.cells[i] = static_cast<std::uint8_t>(std::min(255.0, std::round(away_m / kStep_m)));
  }
}

LikelihoodField::Table LogLikelihoods(const BeamModel& model) {
  LikelihoodField::Table table;
  const double random = model.random_share;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double z = static_cast<double>(i) * LikelihoodField::kStep_m / model.hit_sd_m;
    table[i] = static_cast<float>(std::log((1 - random) * std::exp(-z * z / 2) + random));
  }
  table.back() = static_cast<float>(std::log(random));  // so far, or further
  return table;
}

}  // namespace floorproof

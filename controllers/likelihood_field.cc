// SPDX-License-Identifier: Apache-2.0
#include "controllers/likelihood_field.h"

#include <algorithm>
#include <cmath>

#include "env/core/distance.h"
#include "env/core/rasterise.h"

namespace floorproof {
namespace {

constexpr double kFinest_m = 0.05;

// Whether a level scan at that height can meet it.
bool IsMet(const Hazard& hazard, double height_m) {
  return hazard.hazard_class != HazardClass::kGlass &&
         std::ranges::any_of(hazard.solids, [&](const Solid& solid) {
           return solid.kind == Solid::Kind::kPrism && solid.z_low_m < height_m &&
                  solid.z_high_m > height_m;
         });
}

}  // namespace

LikelihoodField::LikelihoodField(const HazardMap& known, double height_m, const BeamModel& model)
    : X_GW_(known.frame.X_WG.Inverse()), log_random_(std::log(model.random_share)) {
  const int fine = std::max(1, static_cast<int>(std::ceil(known.frame.cell_m / kFinest_m - 1e-9)));
  const GridFrame frame = known.frame.Subdivided(fine);
  cell_m_ = frame.cell_m;
  Grid<std::uint8_t> met(frame.width, frame.height);
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix) met(ix, iy) = known.IsWall(ix / fine, iy / fine);
  for (const Hazard& hazard : known.hazards) {
    if (!IsMet(hazard, height_m)) continue;
    for (Polygon polygon : hazard.footprint) {
      for (Vec2& p : polygon) p = (X_GW_ * p) / cell_m_;
      Rasterise(polygon, frame.width, frame.height, [&](int ix, int iy) { met(ix, iy) = 1; });
    }
  }
  log_likelihood_ = DistanceToCentres(met);
  for (float& cell : log_likelihood_.cells) {
    // Beams end at faces, half a cell before the centres.
    const double away_m = std::max(0.0, static_cast<double>(cell) - 0.5) * cell_m_;
    const double z = away_m / model.hit_sd_m;
    const double random = model.random_share;
    cell = static_cast<float>(std::log((1 - random) * std::exp(-z * z / 2) + random));
  }
}

}  // namespace floorproof

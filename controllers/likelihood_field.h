// SPDX-License-Identifier: Apache-2.0
// How likely a lidar's beam ends at a place, given the map: the likelihood field of Thrun, Burgard
// & Fox, "Probabilistic Robotics", 2005, section 6.4.
#pragma once

#include <array>
#include <cstdint>

#include "env/core/hazard_map.h"
#include "env/geometry/grid.h"

namespace floorproof {

struct BeamModel {
  double hit_sd_m = 0.1;      // of an end's distance from what it met
  double random_share = 0.1;  // of beams that end anywhere: on what the map does not know
};

// How far a place is from where beams end, in steps of kStep_m: what a likelihood needs of the map.
class LikelihoodField {
 public:
  static constexpr double kStep_m = 0.005;
  using Table = std::array<float, 256>;  // of log likelihoods, by the steps away

  LikelihoodField() = default;
  // Walls, and known hazards that reach the scan plane at height_m. Takes
  // time and memory as the map's area in cells of at most 5 cm, a byte each.
  LikelihoodField(const HazardMap& known, double height_m);

  // Index into a table for a beam that ends there; off the map: the last.
  std::uint8_t StepsAway(const Vec2& p_W) const {
    const Vec2 p_G = (X_GW_ * p_W) / cell_m_;
    if (!(p_G.x() >= 0 && p_G.y() >= 0 && p_G.x() < away_.width && p_G.y() < away_.height))
      return 255;
    return away_(static_cast<int>(p_G.x()), static_cast<int>(p_G.y()));
  }

 private:
  Grid<std::uint8_t> away_;
  Pose2 X_GW_;
  double cell_m_ = 0.05;
};

// Logarithm of the likelihood of a beam that ends so many steps away: of a random one to 0.
LikelihoodField::Table LogLikelihoods(const BeamModel& model);

}  // namespace floorproof

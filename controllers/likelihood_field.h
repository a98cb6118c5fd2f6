// SPDX-License-Identifier: Apache-2.0
// How likely a lidar's beam ends at a place, given the map: the likelihood field of Thrun, Burgard
// & Fox, "Probabilistic Robotics", 2005, section 6.4.
#pragma once

#include "env/core/grid.h"
#include "env/core/hazard_map.h"

namespace floorproof {

struct BeamModel {
  double hit_sd_m = 0.2;      // of an end's distance from what it met
  double random_share = 0.1;  // of beams that end anywhere: on what the map does not know
};

class LikelihoodField {
 public:
  LikelihoodField() = default;
  // Walls, and known hazards that reach the scan plane at height_m; glass is not among them. Takes
  // time and memory as the map's area in cells of at most 5 cm.
  LikelihoodField(const HazardMap& known, double height_m, const BeamModel& model);

  // Logarithm of the likelihood of a beam that ends there, from that of a random one to 0.
  double LogAt(const Vec2& p_W) const {
    const Vec2 p_G = (X_GW_ * p_W) / cell_m_;
    const int ix = static_cast<int>(p_G.x()), iy = static_cast<int>(p_G.y());
    if (!(p_G.x() >= 0 && p_G.y() >= 0) || ix >= log_likelihood_.width ||
        iy >= log_likelihood_.height)
      return log_random_;
    return static_cast<double>(log_likelihood_(ix, iy));
  }
  double log_random() const { return log_random_; }

 private:
  Grid<float> log_likelihood_;
  Pose2 X_GW_;
  double cell_m_ = 0.05, log_random_ = -2.3;
};

}  // namespace floorproof

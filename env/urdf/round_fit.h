// SPDX-License-Identifier: Apache-2.0
// The round thing that shapes on an axle are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "env/urdf/urdf_model.h"

namespace floorproof {

struct RoundFit {
  Vec3 centre = Vec3::Zero();  // on the axle
  double radius_m = 0, half_width_m = 0;
  std::string guess;  // what of it is one
};

// About the axle through `p` along the unit vector `axis`: by what collides, else by what is seen;
// of several shapes, by the largest. None where there is no shape.
std::optional<RoundFit> FitRound(const std::vector<UrdfShape>& shapes, const Vec3& p,
                                 const Vec3& axis);

// The box around a shape, along M's axes.
Eigen::AlignedBox3d BoundsOf(const UrdfShape& shape);

// The ball that touches the floor where this shape does.
struct BallFit {
  Vec3 centre = Vec3::Zero();
  double radius_m = 0;
  std::string guess;
};
BallFit FitBall(const UrdfShape& shape);

}  // namespace floorproof

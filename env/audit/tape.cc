// SPDX-License-Identifier: Apache-2.0
#include "env/audit/tape.h"

#include <algorithm>
#include <cmath>

#include "env/geometry/box.h"

namespace floorproof {

void TapeParams::Visit(ParamVisitor& v) {
  v("side_m", side_m, {0.001, 0.1}, "side of the tape's square");
  v("lift", lift, Between(0, 1), "share of the particles below it that it lifts");
}

std::vector<LiftedParticle> LiftTape(DirtField& field, const Pose2& X_WT, const TapeParams& params,
                                     Stream& random) {
  const GridFrame& frame = field.frame();
  const Pose2 X_GT = frame.X_WG.Inverse() * X_WT;
  const Vec2 x_G = X_GT.Rotate({1, 0}), y_G = X_GT.Rotate({0, 1});
  const double half_m = params.side_m / 2;
  const Box2 around = BoxAround({X_GT * Vec2(-half_m, -half_m), X_GT * Vec2(half_m, -half_m),
                                 X_GT * Vec2(half_m, half_m), X_GT * Vec2(-half_m, half_m)});
  const auto bin = [&frame](double along_m, int bins) {
    const double i = std::floor(along_m / frame.cell_m);
    return static_cast<int>(i > -1 ? (i < bins ? i : bins) : -1);  // NaN: -1
  };
  const int x1 = std::min(bin(around.high.x(), frame.width), frame.width - 1);
  const int y1 = std::min(bin(around.high.y(), frame.height), frame.height - 1);
  std::vector<LiftedParticle> lifted;
  for (int iy = std::max(0, bin(around.low.y(), frame.height)); iy <= y1; ++iy)
    for (int ix = std::max(0, bin(around.low.x(), frame.width)); ix <= x1; ++ix)
      field.TakeIf(ix, iy, [&](const Vec2& p_G, double diameter_m) {
        const Vec2 d = p_G - X_GT.p(), p_T(x_G.dot(d), y_G.dot(d));
        if (p_T.cwiseAbs().maxCoeff() > half_m || random.Uniform() >= params.lift) return false;
        lifted.push_back({p_T, diameter_m});
        return true;
      });
  return lifted;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Where a GoTo skill leads: its final position and tolerable error ("safety-monitoring", section 4:
// (x, y, theta), (e, epsilon)), which its primitives share.
#pragma once

#include <optional>

#include "base/params.h"
#include "env/geometry/geometry.h"

namespace floorproof {

struct Target {
  std::optional<double> x_m, y_m;  // none: nowhere
  double tolerance_m = 0.03;
  void Visit(ParamVisitor& v) {
    v("x_m", x_m, Between(-1e6, 1e6), "the place to go to, world (m)");
    v("y_m", y_m, Between(-1e6, 1e6), "the same (m)");
    v("tolerance_m", tolerance_m, Between(0.001, 10), "e: how near is there (m)");
  }
  std::optional<Vec2> p_W() const {
    return x_m && y_m ? std::optional(Vec2(*x_m, *y_m)) : std::nullopt;
  }
};

}  // namespace floorproof

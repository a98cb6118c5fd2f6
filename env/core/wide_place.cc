// SPDX-License-Identifier: Apache-2.0
// The way out of a place that is too narrow for a clear circle. The outline is moved straight
// ahead, half a cell at a time, until the circle fits. Not done: turns, and driving backwards.
#include <cmath>

#include "env/core/coverage.h"
#include "env/core/standing.h"
#include "env/geometry/rasterise.h"

namespace floorproof {

std::optional<Vec2> FloorRoom::WidePlaceAhead(const RobotSpec& robot, const Shape2& clear,
                                              const Pose2& start) const {
  if (clear.kind != Shape2::Kind::kCircle) return {};
  const auto meets = [&](const Polygon& part_W, const Grid<std::uint8_t>& mask) {
    Polygon part_G;
    for (const Vec2& p_W : part_W) part_G.push_back(frame_.ToGrid(p_W) / frame_.cell_m);
    bool any = false;
    Rasterise(part_G, mask.width, mask.height, [&](int ix, int iy) { any = any || mask(ix, iy); });
    return any;
  };
  const Vec2 step_W = frame_.cell_m / 2 * Vec2(std::cos(start.yaw_rad), std::sin(start.yaw_rad));
  for (Pose2 X_WB = start;; X_WB.x_m += step_W.x(), X_WB.y_m += step_W.y()) {
    const Cell cell = frame_.ToCell(X_WB.p());
    if (!frame_.Inside(cell)) return {};
    if (static_cast<double>(clearance_m_(cell)) >= clear.radius_m) return X_WB.p();
    for (const Polygon& part_W : OutlineAt(robot, X_WB, inset_m_ + kTouch_m))
      if (meets(part_W, walls_)) return {};
    for (const Polygon& part_W : OutlineAt(robot, X_WB, kTouch_m))
      if (meets(part_W, hazards_)) return {};
  }
}

}  // namespace floorproof

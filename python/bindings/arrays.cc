// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/arrays.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "run/scenario/plan_file.h"

namespace floorproof {

nb::ndarray<nb::numpy, double> PathArray(const Path& path) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values;
  values.reserve(5 * path.size());
  for (const Waypoint& w : path)
    values.insert(values.end(),
                  {w.p_W.x(), w.p_W.y(), w.yaw_rad.value_or(kNone), w.speed_mps, w.dwell_s});
  return ArrayOf(std::move(values), {path.size(), 5});
}

nb::ndarray<nb::numpy, std::uint8_t> KnownArray(const KnownMap& known) {
  Grid<std::uint8_t> states(known.frame.width, known.frame.height);
  for (int iy = 0; iy < states.height; ++iy)
    for (int ix = 0; ix < states.width; ++ix)
      states(ix, iy) = static_cast<std::uint8_t>(known.At(ix, iy));
  return GridArray<std::uint8_t>(states);
}

Path PathFrom(const Rows& rows, const GridFrame& map, const std::string& who) {
  const std::size_t n = rows.shape(0), columns = rows.shape(1);
  if (n == 0 || columns < 2 || columns > 5)
    throw InputError({who, 0}, "path", std::to_string(n) + " x " + std::to_string(columns),
                     "must be n x 2 to n x 5, n at least 1: x_m, y_m, yaw_rad, speed_mps, dwell_s");
  Path path(n);
  double dwell_s = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Waypoint& w = path[i];
    w.p_W = {rows(i, 0), rows(i, 1)};
    if (columns > 2 && !std::isnan(rows(i, 2))) w.yaw_rad = rows(i, 2);
    if (columns > 3) w.speed_mps = rows(i, 3);
    if (columns > 4) w.dwell_s = rows(i, 4);
    CheckWaypoint(w, map, {who + ", path[" + std::to_string(i) + "]", 0}, dwell_s);
  }
  return path;
}

}  // namespace floorproof

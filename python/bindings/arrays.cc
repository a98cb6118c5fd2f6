// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/arrays.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/params.h"

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

Path PathFrom(const Rows& rows, const GridFrame& map, const std::string& who) {
  constexpr const char* kColumns[] = {"x_m", "y_m", "yaw_rad", "speed_mps", "dwell_s"};
  const std::size_t n = rows.shape(0), columns = rows.shape(1);
  if (n == 0 || columns < 2 || columns > 5)
    throw InputError({who, 0}, "path", std::to_string(n) + " x " + std::to_string(columns),
                     "must be n x 2 to n x 5, n at least 1: x_m, y_m, yaw_rad, speed_mps, dwell_s");
  Path path(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto refuse = [&](std::size_t column, const char* rule) {
      throw InputError({who, 0}, "path[" + std::to_string(i) + "]." + kColumns[column],
                       FormatDouble(rows(i, column)), rule);
    };
    Waypoint& w = path[i];
    for (std::size_t c = 0; c < columns; ++c)
      if (!std::isfinite(rows(i, c)) && !(c == 2 && std::isnan(rows(i, c))))
        refuse(c, "must be finite");
    w.p_W = {rows(i, 0), rows(i, 1)};
    if (!map.Inside(map.ToCell(w.p_W))) refuse(0, "lies off the map");
    if (columns > 2 && !std::isnan(rows(i, 2))) w.yaw_rad = rows(i, 2);
    if (columns > 3) w.speed_mps = rows(i, 3);
    if (columns > 4) w.dwell_s = rows(i, 4);
    if (w.speed_mps < 0) refuse(3, "must be >= 0");
    if (w.dwell_s < 0) refuse(4, "must be >= 0");
  }
  return path;
}

}  // namespace floorproof

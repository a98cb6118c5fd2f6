// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/why_nothing.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace floorproof {

bool StartFits(const SweepArea& area) {
  return std::ranges::find(area.reachable.cells, 1) != area.reachable.cells.end();
}

std::string WhyNothing(const PlanRequest& request, const SweepArea& area, const Shape2& clear) {
  const Vec2 p = request.start.p();
  const Cell cell = request.map.frame.ToCell(p), fine = area.frame.ToCell(p);
  std::ostringstream out;
  const auto millimetres = [](double m) { return FormatDouble(std::round(1000 * m) / 1000 + 0.0); };
  out << "start (" << millimetres(p.x()) << ", " << millimetres(p.y()) << ") m, cell (" << cell.ix
      << ", " << cell.iy << "): ";
  if (StartFits(area)) {
    out << "the tool sweeps no floor from there";
  } else if (!request.map.frame.Inside(cell)) {
    out << "lies off the map";
  } else {
    out << "the robot does not fit: an obstacle is "
        << std::lround(1000 * static_cast<double>(area.clearance_m(fine))) << " mm away";
    if (clear.kind == Shape2::Kind::kCircle)
      out << " and " << std::lround(1000 * clear.radius_m) << " mm are kept clear";
  }
  return out.str();
}

}  // namespace floorproof

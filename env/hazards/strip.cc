// SPDX-License-Identifier: Apache-2.0
#include "env/hazards/strip.h"

#include <cmath>
#include <string>

#include "base/error.h"

namespace floorproof {
namespace {

Vec2 LeftNormal(const Vec2& a, const Vec2& b) {
  const Vec2 d = (b - a).normalized();
  return {-d.y(), d.x()};
}

// From a corner of the line to the strip's left border there, for a half width of 1.
Vec2 Mitre(const std::vector<Vec2>& line, std::size_t i) {
  const bool first = i == 0, last = i + 1 == line.size();
  const Vec2 before = first ? LeftNormal(line[0], line[1]) : LeftNormal(line[i - 1], line[i]);
  const Vec2 after = last ? before : LeftNormal(line[i], line[i + 1]);
  const double cos_bend = before.dot(after);
  if (cos_bend < std::cos(150 * kPi / 180))
    throw InputError({}, "line_m", "",
                     "bends by more than 150 degrees at its point " + std::to_string(i + 1));
  return (before + after) / (1 + cos_bend);
}

}  // namespace

std::vector<Polygon> StripAlong(const std::vector<Vec2>& line, double width_m,
                                std::string_view width_key) {
  std::vector<Vec2> left, right;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 to_left = Mitre(line, i) * (width_m / 2);
    left.push_back(line[i] + to_left);
    right.push_back(line[i] - to_left);
  }
  std::vector<Polygon> quads;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 along = line[i + 1] - line[i];
    if ((left[i + 1] - left[i]).dot(along) <= 0 || (right[i + 1] - right[i]).dot(along) <= 0)
      throw InputError({}, "line_m", "",
                       "its points " + std::to_string(i + 1) + " and " + std::to_string(i + 2) +
                           " lie too close for a bend of this " + std::string(width_key));
    quads.push_back({right[i], right[i + 1], left[i + 1], left[i]});
  }
  return quads;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A hazard of a type by name, with keys as YAML.
#pragma once

#include <string>
#include <vector>

#include "env/hazards/hazard_type.h"

namespace floorproof {

inline Hazard MakeOf(const std::string& type, const std::string& keys,
                     const std::vector<Vec2>& place) {
  auto dut = MakePlugin(HazardTypes(), type, "type");
  ReadParams(ParseYaml(keys, "test"), "", *dut);
  Hazard hazard = dut->Make(place);
  hazard.type = type;
  return hazard;
}

// Volume above the base floor, m^3 (cuts count negative), by the prismoidal formula.
inline double Volume(const Hazard& hazard) {
  double volume = 0;
  for (const Solid& s : hazard.solids) {
    double area = SignedArea(s.base);
    if (s.kind == Solid::Kind::kSurface) continue;
    if (IsSlope(s)) {  // fans of triangles, each as high as its middle
      for (std::size_t i = 1; i + 1 < s.base.size(); ++i) {
        const Polygon part = {s.base[0], s.base[i], s.base[i + 1]};
        volume += SignedArea(part) * (TopAt(s, (part[0] + part[1] + part[2]) / 3) - s.z_low_m);
      }
      continue;
    }
    if (!s.top.empty()) {
      Polygon middle;  // halfway up, of the convex hull of both
      for (const Vec2& a : s.base)
        for (const Vec2& b : s.top) middle.push_back((a + b) / 2);
      area = (area + 4 * SignedArea(ConvexHull(middle)) + SignedArea(s.top)) / 6;
    }
    volume += area * (s.z_high_m - s.z_low_m) * (s.kind == Solid::Kind::kCut ? -1 : 1);
  }
  return volume;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A sloping floor (C4 of the hTetro FMEA paper, Table 1): from the base floor it rises towards one
// direction, or falls towards it. It begins at height 0 at the polygon's corners that lie first
// along that direction. Its sides stand upright. ADA 405.2 allows a rise of 1:12, 405.2's table for
// existing buildings 1:10 up to 150 mm and 1:8 up to 75 mm.
#include <algorithm>
#include <cmath>
#include <limits>

#include "env/hazards/hazard_type.h"

namespace floorproof {
namespace {

class Ramp final : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("slope_deg", slope_deg_, Between(-60, 60), "angle of the slope; minus: it falls; not 0");
    v("toward_deg", toward_deg_, Between(-360, 360),
      "direction in which it rises or falls, from the map's x towards y");
  }
  Placement placement() const override { return Placement::kPolygon; }
  bool Turn(double by_rad) override {
    toward_deg_ = CanonicalDegrees(toward_deg_ + by_rad * 180 / kPi);
    return true;
  }

  std::vector<KeyRange> Ranges(const RobotSpec&) const override {
    return {{"slope_deg", {{-30, -1}, {1, 30}}, true}};  // wheels slip before that, on most floors
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    const double toward_rad = toward_deg_ * kPi / 180;
    const Vec2 along(std::cos(toward_rad), std::sin(toward_rad));
    const double rise = std::tan(slope_deg_ * kPi / 180);
    double first_m = std::numeric_limits<double>::infinity(), last_m = -first_m;
    for (const Vec2& corner : place) {
      first_m = std::min(first_m, along.dot(corner));
      last_m = std::max(last_m, along.dot(corner));
    }
    const double height_m = rise * (last_m - first_m);
    constexpr double kHighest_m = 10;
    if (std::abs(height_m) < kLeastSize_m || std::abs(height_m) > kHighest_m)
      throw InputError({}, "slope_deg", FormatDouble(slope_deg_),
                       "makes a height of " + FormatDouble(height_m) +
                           " m at the far end; must be 0.0001 to 10 m up or down");
    Hazard hazard;
    hazard.hazard_class = HazardClass::kTerrain;
    hazard.height_m = height_m;
    const double slope_rad = std::abs(slope_deg_) * kPi / 180;
    hazard.sizes = {{{"ramp", slope_rad}, {"ramp_down", slope_rad}}};
    hazard.footprint = {place};
    hazard.material.rgba = {0.66f, 0.64f, 0.58f, 1.0f};
    const double lowest_m = std::min(height_m, 0.0);
    if (height_m < 0) hazard.solids.push_back({Solid::Kind::kCut, place, {}, height_m, 0});
    for (const Polygon& part : ConvexParts({{place, {}}})) {
      double highest_m = lowest_m;
      for (const Vec2& corner : part)
        highest_m = std::max(highest_m, rise * (along.dot(corner) - first_m));
      if (highest_m - lowest_m < kLeastSize_m) continue;
      hazard.solids.push_back(
          {Solid::Kind::kPrism, part, {}, lowest_m, highest_m, Vec2(rise * along)});
    }
    return hazard;
  }

 private:
  double slope_deg_ = 4.76;  // 1:12
  double toward_deg_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, Ramp)

}  // namespace floorproof

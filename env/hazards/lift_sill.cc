// SPDX-License-Identifier: Apache-2.0
// A lift whose car stands at the landing (C3 of the hTetro FMEA paper, Table 1): the polygon is the
// car's floor, its first edge the door. Along that edge lies the gap, and beyond it the floor lies
// level_m higher or lower, since cars do not stop exactly: ADA 407.4 allows 13 mm, and a gap of
// 32 mm.
#include <algorithm>
#include <cmath>

#include "env/hazards/hazard_type.h"
#include "env/hazards/robot_scale.h"

namespace floorproof {
namespace {

class LiftSill final : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("gap_m", gap_m_, Between(kLeastSize_m, 0.5), "width of the gap, inwards from the first edge");
    v("depth_m", depth_m_, Between(0.01, 2), "depth of the gap below the floor around it");
    v("level_m", level_m_, Between(-0.5, 0.5),
      "the car's floor over the floor around it; minus: below; 0: level");
  }
  Placement placement() const override { return Placement::kPolygon; }

  std::vector<KeyRange> Ranges(const RobotSpec& robot) const override {
    const double wheel_m = WheelScale(robot), most_m = EdgeScale(robot, "lift_sill");
    return {{"gap_m", {{0.1 * wheel_m, 2 * wheel_m}}, true},
            {"depth_m", {{1.1 * most_m, 1.1 * most_m + wheel_m}}},
            {"level_m", {{-most_m, -most_m / 20}, {most_m / 20, most_m}}, true}};
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    if (level_m_ != 0 && std::abs(level_m_) < kLeastSize_m)
      throw InputError({}, "level_m", FormatDouble(level_m_),
                       "must be 0, or at least 0.0001 up or down");
    if (depth_m_ <= -level_m_)
      throw InputError({}, "depth_m", FormatDouble(depth_m_),
                       "must be more than the car's floor lies low");
    const Polygon gap = Gap(place);
    Hazard hazard;
    hazard.footprint = {place};
    hazard.sizes = Sizes();
    hazard.material.rgba = {0.62f, 0.64f, 0.67f, 1.0f};
    hazard.solids = {{Solid::Kind::kCut, gap, {}, -depth_m_, 0}};
    if (level_m_ == 0) {
      hazard.hazard_class = HazardClass::kTerrain;
      hazard.height_m = -depth_m_;
      hazard.footprint = {gap};
      return hazard;
    }
    hazard.hazard_class = HazardClass::kLevelChange;
    hazard.lies_on_floor = true;
    hazard.height_m = level_m_;
    for (const Region& car : Difference({{place, {}}}, {gap})) {
      if (level_m_ < 0) hazard.solids.push_back({Solid::Kind::kCut, car.outer, {}, level_m_, 0});
      if (level_m_ > 0)
        for (const Polygon& part : ConvexParts({car}))
          hazard.solids.push_back({Solid::Kind::kPrism, part, {}, 0, level_m_});
    }
    return hazard;
  }

 private:
  // The ladder's gap is the widest that a lift may have. Out of a car that stands high the robot
  // comes down.
  std::vector<std::vector<HazardSize>> Sizes() const {
    constexpr double kGap_m = 0.032;
    const double level_m = std::max(std::abs(level_m_), kLeastSize_m);
    if (level_m_ == 0 && gap_m_ > kGap_m * kSame) return {{{"groove", gap_m_}}};
    std::vector<HazardSize> sizes = {{"lift_sill", level_m}};
    if (level_m_ != 0) sizes.push_back({"drop", level_m});
    if (gap_m_ > kGap_m * kSame) sizes.push_back({"groove", gap_m_});
    return {sizes};
  }

  // Within the polygon, as wide all along its first edge.
  Polygon Gap(const std::vector<Vec2>& place) const {
    const Vec2 along = place[1] - place[0];
    const Vec2 in = gap_m_ * Vec2(-along.y(), along.x()) / along.norm();
    const Polygon gap = {place[0], place[1], place[1] + in, place[0] + in};
    if (Area(Intersection({{place, {}}}, {gap})) < (1 - 1e-6) * SignedArea(gap))
      throw InputError({}, "polygon_m", "",
                       "must hold the whole gap along its first edge, the door: gap_m " +
                           FormatDouble(gap_m_) + " deep, square to it at both ends");
    return gap;
  }

  double gap_m_ = 0.032;   // ADA 407.4.3: the widest
  double depth_m_ = 0.05;  // deep enough that no small wheel reaches the bottom
  double level_m_ = 0.0;
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, LiftSill)

}  // namespace floorproof

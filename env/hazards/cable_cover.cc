// SPDX-License-Identifier: Apache-2.0
// A cable cover along a line (C4 of the hTetro FMEA paper, Table 1): a trapezoid in section, low
// and wide, mitred at bends, cut square at its ends.
#include <cmath>

#include "env/geometry/geometry.h"
#include "env/hazards/hazard_type.h"
#include "env/hazards/robot_scale.h"
#include "env/hazards/strip.h"

namespace floorproof {
namespace {

class CableCover : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("width_m", width_m_, Between(kLeastSize_m, 2), "width at the floor, across the line");
    v("top_width_m", top_width_m_, Between(kLeastSize_m, 2),
      "width of its flat top; at most width_m");
    v("height_m", height_m_, Between(kLeastSize_m, 0.5), "height over the base floor");
  }
  Placement placement() const override { return Placement::kLine; }

  std::vector<KeyRange> Ranges(const RobotSpec& robot) const override {
    const double most_m = 1.5 * EdgeScale(robot, "step");  // its flanks slope
    return {{"height_m", {{most_m / 20, most_m}}, true},
            {"width_m", {{0.08, 0.24}}},
            {"top_width_m", {{0.02, 0.06}}}};
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    if (top_width_m_ > width_m_)
      throw InputError({}, "top_width_m", FormatDouble(top_width_m_),
                       "must be at most width_m, " + FormatDouble(width_m_));
    Hazard hazard;
    hazard.hazard_class = HazardClass::kTerrain;
    hazard.height_m = height_m_;
    hazard.sizes = Sizes();
    hazard.footprint = StripAlong(place, width_m_, "width_m");
    const std::vector<Polygon> tops = StripAlong(place, top_width_m_, "top_width_m");
    for (std::size_t i = 0; i < tops.size(); ++i)
      hazard.solids.push_back({Solid::Kind::kPrism, hazard.footprint[i], tops[i], 0, height_m_});
    hazard.material.rgba = {0.85f, 0.70f, 0.15f, 1.0f};
    return hazard;
  }

 private:
  // By the ladder's cover of the same height or flanks; a low one is no more than an upright
  // threshold.
  std::vector<std::vector<HazardSize>> Sizes() const {
    constexpr double kHeight_m = 0.020, kFlank_rad = kPi / 6, kThreshold_m = 0.0064;
    const double flank_rad = std::atan2(2 * height_m_, width_m_ - top_width_m_);
    std::vector<std::vector<HazardSize>> sizes;
    if (height_m_ <= kHeight_m * kSame) sizes.push_back({{"cable_cover", flank_rad}});
    if (flank_rad <= kFlank_rad * kSame) sizes.push_back({{"cable_cover_height", height_m_}});
    if (height_m_ <= kThreshold_m * kSame) sizes.push_back({{"threshold", height_m_}});
    if (sizes.empty())  // higher and steeper than either: all that is like it must be crossed
      sizes.push_back({{"cable_cover", flank_rad},
                       {"cable_cover_height", height_m_},
                       {"step", height_m_},
                       {"drop", height_m_}});
    return sizes;
  }

  // No published sizes were found: the middle of 15-30 mm high with flanks of 15-40 degrees.
  double width_m_ = 0.13;
  double top_width_m_ = 0.05;
  double height_m_ = 0.02;
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, CableCover)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A door's threshold along a line (C3 of the hTetro FMEA paper, Table 1): on both sides vertical up
// to vertical_m, from there bevelled. ADA 303 allows 6.4 mm upright and 13 mm in all, bevelled 1:2;
// an existing one may be 19 mm high.
#include <algorithm>

#include "env/hazards/hazard_type.h"
#include "env/hazards/robot_scale.h"
#include "env/hazards/strip.h"

namespace floorproof {
namespace {

class Threshold final : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("width_m", width_m_, Between(kLeastSize_m, 2), "width at the floor, across the line");
    v("height_m", height_m_, Between(kLeastSize_m, 0.1), "height over the floor that it lies on");
    v("vertical_m", vertical_m_, Between(0, 0.1), "so much of the height is upright");
    v("bevel", bevel_, Between(0, 20), "run of the slope above that, per rise; 0: all is upright");
  }
  Placement placement() const override { return Placement::kLine; }

  std::vector<KeyRange> Ranges(const RobotSpec& robot) const override {
    constexpr double kMostBevel = 2;
    const double most_m = EdgeScale(robot, "threshold"), slopes_m = 2 * kMostBevel * most_m;
    return {{"height_m", {{most_m / 20, most_m}}, true},
            {"vertical_m", {{0, most_m}}},
            {"bevel", {{0, kMostBevel}}},
            {"width_m", {{slopes_m + 0.01, slopes_m + 0.15}}}};
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    const double upright_m = bevel_ > 0 ? std::min(height_m_, vertical_m_) : height_m_;
    const double bevelled_m = height_m_ - upright_m;
    const double top_m = width_m_ - 2 * bevel_ * bevelled_m;
    if (top_m < kLeastSize_m)
      throw InputError({}, "width_m", FormatDouble(width_m_),
                       "leaves no top: two slopes of " + FormatDouble(bevel_ * bevelled_m) +
                           " m rise from its edges");
    Hazard hazard;
    hazard.hazard_class = HazardClass::kLevelChange;
    hazard.lies_on_floor = true;
    hazard.height_m = height_m_;
    // The ladder's is a new door's; what is steeper is a step.
    constexpr double kNewUpright_m = 0.0064, kNewBevel = 2;
    const bool as_new =
        upright_m <= kNewUpright_m * kSame && (bevel_ >= kNewBevel || bevelled_m <= 0);
    hazard.sizes = LevelSizes(height_m_);
    if (as_new) hazard.sizes = {{{"threshold", height_m_}}};
    hazard.footprint = StripAlong(place, width_m_, "width_m");
    hazard.material.rgba = {0.45f, 0.33f, 0.22f, 1.0f};
    const std::vector<Polygon> tops = StripAlong(place, top_m, "width_m");
    for (std::size_t i = 0; i < tops.size(); ++i) {
      const Polygon& base = hazard.footprint[i];
      if (upright_m > 0) hazard.solids.push_back({Solid::Kind::kPrism, base, {}, 0, upright_m});
      if (bevelled_m > 0)
        hazard.solids.push_back({Solid::Kind::kPrism, base, tops[i], upright_m, height_m_});
    }
    return hazard;
  }

 private:
  double width_m_ = 0.1;        // a door leaf's thickness and its frame
  double height_m_ = 0.013;     // the highest at a new door (ADA 404.2.5)
  double vertical_m_ = 0.0064;  // the highest upright edge (ADA 303.2)
  double bevel_ = 2;            // ADA 303.3
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, Threshold)

}  // namespace floorproof

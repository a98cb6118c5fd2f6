// SPDX-License-Identifier: Apache-2.0
// A level change with a vertical edge (C3 of the hTetro FMEA paper, Table 1): the floor within the
// polygon lies higher, as a platform, or lower, as a pit.
#include <cmath>

#include "env/hazards/hazard_type.h"
#include "env/hazards/robot_scale.h"

namespace floorproof {
namespace {

class Step : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("height_m", height_m_, Between(-2, 2),
      "floor's height within the polygon over the base floor; minus: a drop; not 0");
  }
  Placement placement() const override { return Placement::kPolygon; }

  std::vector<KeyRange> Ranges(const RobotSpec& robot) const override {
    const double most_m = EdgeScale(robot, "step"), least_m = most_m / 20;
    return {{"height_m", {{-most_m, -least_m}, {least_m, most_m}}, true}};
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    if (std::abs(height_m_) < 1e-4)
      throw InputError({}, "height_m", FormatDouble(height_m_),
                       "must be at least 0.0001 up or down");
    Hazard hazard;
    hazard.hazard_class = HazardClass::kLevelChange;
    hazard.footprint = {place};
    hazard.height_m = height_m_;
    hazard.sizes = LevelSizes(height_m_);
    hazard.material.rgba = {0.72f, 0.66f, 0.50f, 1.0f};
    if (height_m_ < 0) {
      hazard.solids = {{Solid::Kind::kCut, place, {}, height_m_, 0}};
    } else {
      for (const Polygon& part : ConvexParts({{place, {}}}))
        hazard.solids.push_back({Solid::Kind::kPrism, part, {}, 0, height_m_});
    }
    return hazard;
  }

 private:
  double height_m_ = 0.013;  // the highest threshold at a new door (ADA 404.2.5)
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, Step)

}  // namespace floorproof

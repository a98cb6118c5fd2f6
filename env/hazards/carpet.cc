// SPDX-License-Identifier: Apache-2.0
// A carpet or rug (C3 of the hTetro FMEA paper, Table 1: its edge is a level change): wheels stand
// height_m over the floor, meet an edge that slopes, and are held back as they roll.
//
// height_m is that of what carries the wheels, less than the pile's: how far a pile gives is not
// modelled, nor that it gives more under a narrow wheel.
#include "env/hazards/hazard_type.h"
#include "env/hazards/rim.h"
#include "env/hazards/robot_scale.h"

namespace floorproof {
namespace {

class Carpet final : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("height_m", height_m_, Between(kLeastSize_m, 0.1),
      "height of what carries wheels, over the floor that it lies on");
    v("bevel", bevel_, Between(0, 20), "run of the edge's slope, per rise; 0: upright");
    v("rolling_drag", rolling_drag_, Between(0, 0.5),
      "what holds a rolling wheel back, as a share of its load, beside its own bearings");
  }
  Placement placement() const override { return Placement::kPolygon; }

  std::vector<KeyRange> Ranges(const RobotSpec& robot) const override {
    const double most_m = EdgeScale(robot, "carpet");
    return {{"height_m", {{most_m / 20, most_m}}, true},
            {"bevel", {{0, 1.5}}},
            {"rolling_drag", {{0, 0.15}}}};
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    Hazard hazard;
    hazard.hazard_class = HazardClass::kLevelChange;
    hazard.lies_on_floor = true;
    hazard.bend_m = kBend_m;
    hazard.height_m = height_m_;
    // The ladder's edge is 1:1; what is steeper is a step.
    hazard.sizes = LevelSizes(height_m_);
    if (bevel_ >= 1) hazard.sizes = {{{"carpet", height_m_}}};
    hazard.footprint = {place};
    hazard.solids = SlabWithRim(place, height_m_, bevel_ * height_m_, "bevel", bevel_);
    hazard.material.rolling_drag = rolling_drag_;
    hazard.material.rgba = {0.53f, 0.35f, 0.38f, 1.0f};
    return hazard;
  }

 private:
  // An assumption: over an existing door's threshold (19 mm) or a cable cover it still lies on the
  // floor close beside; over a higher edge it spans a gap that is not modelled.
  static constexpr double kBend_m = 0.02;

  double height_m_ = 0.006;  // an assumption: half of the highest pile of ADA 302.2, 12.7 mm
  double bevel_ = 1;         // an assumption: a bound edge gives
  // Carpet's over linoleum's, mean of wheelchairs (Hoffman et al. 2003).
  double rolling_drag_ = 0.0118;
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, Carpet)

}  // namespace floorproof

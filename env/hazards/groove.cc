// SPDX-License-Identifier: Apache-2.0
// A slot in the floor along a line (C4 of the hTetro FMEA paper, Table 1), with vertical sides and
// a flat bottom.
#include "env/hazards/hazard_type.h"
#include "env/hazards/robot_scale.h"
#include "env/hazards/strip.h"

namespace floorproof {
namespace {

class Groove : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("width_m", width_m_, Between(kLeastSize_m, 2), "width across the line");
    v("depth_m", depth_m_, Between(kLeastSize_m, 2), "depth below the floor that it is in");
  }
  Placement placement() const override { return Placement::kLine; }

  std::vector<KeyRange> Ranges(const RobotSpec& robot) const override {
    const double wheel_m = WheelScale(robot);
    return {{"width_m", {{0.1 * wheel_m, 3 * wheel_m}}, true},
            {"depth_m", {{0.1 * wheel_m, wheel_m}}, true}};
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    Hazard hazard;
    hazard.hazard_class = HazardClass::kTerrain;
    hazard.height_m = -depth_m_;
    hazard.sizes = {{{"groove", width_m_}}, {{"step", depth_m_}, {"drop", depth_m_}}};
    hazard.footprint = StripAlong(place, width_m_, "width_m");
    for (const Polygon& slot : hazard.footprint)
      hazard.solids.push_back({Solid::Kind::kCut, slot, {}, -depth_m_, 0});
    hazard.material.rgba = {0.30f, 0.30f, 0.32f, 1.0f};
    return hazard;
  }

 private:
  double width_m_ = 0.032;  // the widest gap at a lift's sill
  double depth_m_ = 0.03;   // deep enough that no small wheel reaches the bottom
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, Groove)

}  // namespace floorproof

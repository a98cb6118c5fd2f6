// SPDX-License-Identifier: Apache-2.0
// A glass pane along a line (C2 of the hTetro FMEA paper, Table 1): an obstacle that lidars do not
// see and that throws a robot back.
#include "env/hazards/hazard_type.h"
#include "env/hazards/strip.h"

namespace floorproof {
namespace {

class Glass : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("height_m", height_m_, Between(kLeastSize_m, 10), "height over the base floor");
    v("thickness_m", thickness_m_, Between(kLeastSize_m, 100),
      "thickness, half to each side of the line");
  }
  Placement placement() const override { return Placement::kLine; }

  std::vector<KeyRange> Ranges(const RobotSpec&) const override {
    return {{"restitution", {{0, 0.4}}}};  // from a dead blow to more than a shell gives back
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    Hazard hazard;
    hazard.hazard_class = HazardClass::kGlass;
    hazard.height_m = height_m_;
    hazard.footprint = StripAlong(place, thickness_m_, "thickness_m");
    for (const Polygon& pane : hazard.footprint)
      hazard.solids.push_back({Solid::Kind::kPrism, pane, {}, 0, height_m_});
    // Between a dead blow and the 0.9 of a hard ball on glass, because a robot's shell gives. An
    // assumption.
    hazard.material.restitution = 0.3;
    hazard.material.rgba = {0.55f, 0.80f, 0.88f, 0.35f};
    return hazard;
  }

 private:
  double height_m_ = 2.0;      // a door's leaf
  double thickness_m_ = 0.01;  // toughened door and partition panes measure 8 to 12 mm
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, Glass)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// An opaque obstacle (C1 of the hTetro FMEA paper, Table 1) that stands on the floor.
#include "env/hazards/hazard_type.h"

namespace floorproof {
namespace {

class BlindObject : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("height_m", height_m_, Between(kLeastSize_m, 10), "height over the base floor");
  }
  Placement placement() const override { return Placement::kPolygon; }

  std::vector<KeyRange> Ranges(const RobotSpec&) const override {
    return {{"restitution", {{0, 0.4}}}};  // from a dead blow to more than a shell gives back
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    Hazard hazard;
    hazard.hazard_class = HazardClass::kBlindObject;
    hazard.footprint = {place};
    hazard.height_m = height_m_;
    hazard.material.rgba = {0.55f, 0.42f, 0.32f, 1.0f};
    for (const Polygon& part : ConvexParts({{place, {}}}))
      hazard.solids.push_back({Solid::Kind::kPrism, part, {}, 0, height_m_});
    return hazard;
  }

 private:
  double height_m_ = 0.5;  // a chair's seat or a low shelf; higher than the robots here
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, BlindObject)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A patch of other friction without a height: a wet, oily or dusty floor (C4 of the hTetro FMEA
// paper, Table 1). It gives its friction to what is floor there, level or slanted, and lies on what
// stands before it in the site file. Cables' covers, thresholds' slopes and bumps stay dry.
#include "env/hazards/hazard_type.h"

namespace floorproof {
namespace {

class Wet final : public HazardType {
 public:
  void Visit(ParamVisitor&) override {}  // its friction is a key of all hazards
  Placement placement() const override { return Placement::kPolygon; }

  std::vector<KeyRange> Ranges(const RobotSpec&) const override {
    return {{"friction", {{0.02, 0.6}}}};
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    Hazard hazard;
    hazard.hazard_class = HazardClass::kTerrain;
    hazard.footprint = {place};
    hazard.solids = {{Solid::Kind::kSurface, place, {}, 0, 0}};
    // What rubber finds on a wet floor was not found in print: the least that a wet floor may give
    // a shoe (DCOF, ANSI A326.3, is 0.42) is taken. Robots' floors span 0.2 to 0.6.
    hazard.material.friction = 0.4;
    hazard.material.rgba = {0.45f, 0.62f, 0.78f, 1.0f};
    return hazard;
  }
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, Wet)

}  // namespace floorproof

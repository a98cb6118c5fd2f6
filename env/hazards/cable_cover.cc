// SPDX-License-Identifier: Apache-2.0
// A cable cover along a line (C4 of the hTetro FMEA paper, Table 1): a trapezoid in section, low
// and wide, mitred at bends, cut square at its ends.
#include "env/hazards/hazard_type.h"
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

  Hazard Make(const std::vector<Vec2>& place) const override {
    if (top_width_m_ > width_m_)
      throw InputError({}, "top_width_m", FormatDouble(top_width_m_),
                       "must be at most width_m, " + FormatDouble(width_m_));
    Hazard hazard;
    hazard.hazard_class = HazardClass::kTerrain;
    hazard.height_m = height_m_;
    hazard.footprint = StripAlong(place, width_m_, "width_m");
    const std::vector<Polygon> tops = StripAlong(place, top_width_m_, "top_width_m");
    for (std::size_t i = 0; i < tops.size(); ++i)
      hazard.solids.push_back({Solid::Kind::kPrism, hazard.footprint[i], tops[i], 0, height_m_});
    hazard.material.rgba = {0.85f, 0.70f, 0.15f, 1.0f};
    return hazard;
  }

 private:
  // No published sizes were found: the middle of 15-30 mm high with flanks of 15-40 degrees.
  double width_m_ = 0.13;
  double top_width_m_ = 0.05;
  double height_m_ = 0.02;
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, CableCover)

}  // namespace floorproof

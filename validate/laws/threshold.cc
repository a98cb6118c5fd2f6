// SPDX-License-Identifier: Apache-2.0
// The steepest bevel of a threshold that BELUGA climbs slowly, by statics. As long as its wheel
// lies on the bevel's face, at the angle b, all of its weight on the driven wheels' one axle:
// N sin b = mu N cos b, tan b = mu, whatever the threshold's height. It lies on the face where the
// threshold is higher than R (1 - cos b); a lower one is a step (the law `step`). The casters
// hardly rub.
//
// Tolerance 3 % of the tangent: casters rub a little, and the wheels hop as they spin.
#include <fmt/format.h>

#include "validate/bisect.h"
#include "validate/climb.h"
#include "validate/law.h"
#include "validate/made_hazard.h"

namespace floorproof {
namespace {

constexpr double kSlow_mps = 0.02, kShare = 0.03;
constexpr double kHeight_m = 0.008, kTop_m = 0.04;

class ThresholdLimit final : public Law {
 public:
  std::string_view statement() const override {
    return "the steepest bevel of a threshold climbed slowly: tan b = mu";
  }
  std::vector<WrongModel> notices() const override { return {kMoreFriction}; }
  bool slow() const override { return true; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    Rig truth("beluga");
    const ClimbPlace place = PlaceEdge(truth, false);
    for (const double mu : {0.3, 0.4, 0.5}) {
      const double steepest = Bisect(0.7 * mu, 1.5 * mu, 0.005 * mu, [&](double tangent) {
        return Climbs(tangent, mu, place, wrong);
      });
      rows.push_back({fmt::format("threshold/beluga/mu{}", mu), mu, steepest, kShare * mu, "tan"});
    }
  }

 private:
  static bool Climbs(double tangent, double mu, const ClimbPlace& place, const WrongModel& wrong) {
    const double width_m = kTop_m + 2 * kHeight_m / tangent;
    RigOptions options{.friction = mu, .wrong = wrong};
    options.hazards = {
        MakeHazard("threshold",
                   fmt::format("width_m: {}, height_m: {}, vertical_m: 0, bevel: {}", width_m,
                               kHeight_m, 1 / tangent),
                   {{place.edge_m + width_m / 2, -2}, {place.edge_m + width_m / 2, 2}})};
    Rig rig("beluga", std::move(options));
    rig.Command({kSlow_mps, 0, 0});
    return floorproof::Climbs(rig, place.edge_m + width_m / 2, false, kSlow_mps);
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, ThresholdLimit)

}  // namespace floorproof

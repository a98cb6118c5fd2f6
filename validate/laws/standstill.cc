// SPDX-License-Identifier: Apache-2.0
// A robot that is told to stand on a ramp below its grip stands there, held as its model says: by
// brakes, or by its motors.
//
// Tolerance: 1 mm a minute. In theory it is 0; the engine's dry friction, in bearings and at the
// floor, creeps under a steady load (env/sim/standstill.h).
#include <fmt/format.h>

#include "validate/law.h"
#include "validate/made_hazard.h"

namespace floorproof {
namespace {

constexpr double kSlope = 1.0 / 12;
constexpr double kTolerance_mm = 1;

class StandstillLaw final : public Law {
 public:
  std::string_view statement() const override {
    return "a robot that is stopped on a 1:12 ramp does not move";
  }
  // On friction 0.04 no wheel holds it, locked or not.
  std::vector<WrongModel> notices() const override { return {{.friction_factor = 0.05}}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const char* robot : {"beluga", "htetro", "rover", "scrubber"})
      rows.push_back({fmt::format("standstill/{}/creep", robot), 0, MmPerMinute(robot, wrong),
                      kTolerance_mm, "mm/min"});
  }

 private:
  static double MmPerMinute(const char* robot, const WrongModel& wrong) {
    constexpr double kHalf_m = 2, kSettle_s = 3, kWatch_s = 15;
    const double slope_rad = std::atan(kSlope);
    RigOptions options{.holds_still = true, .wrong = wrong};
    options.hazards = {MakeHazard("ramp", fmt::format("slope_deg: {}", slope_rad * 180 / kPi),
                                  Rectangle({-kHalf_m, -2}, {kHalf_m, 2}))};
    Rig rig(robot, std::move(options));
    rig.SetBase({0, 0, kHalf_m * kSlope},
                Eigen::Quaterniond(Eigen::AngleAxisd(-slope_rad, Vec3::UnitY())), Vec3::Zero());
    rig.Command({});
    const double start_s = rig.truth().t_s;
    while (rig.truth().t_s < start_s + kSettle_s) rig.Step();
    const Vec3 from_W = rig.truth().p_WB;
    while (rig.truth().t_s < start_s + kSettle_s + kWatch_s) rig.Step();
    return 1000 * (rig.truth().p_WB - from_W).norm() * 60 / kWatch_s;
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, StandstillLaw)

}  // namespace floorproof

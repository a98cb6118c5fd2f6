// SPDX-License-Identifier: Apache-2.0
// A wheel that drives and steers, at (L, 0) before an axle that only rolls, its heading d held: it
// rolls along its heading, the axle along the body, so the robot turns about the point where both
// axes meet,
//
//   R = L / tan(d),   vx = omega r cos(d),   w = omega r sin(d) / L,   vy = 0 at the axle,
//
// with the speed omega that the wheel truly has. The second half of the time counts.
//
// Tolerances: 0.5 %, and half a tread over R: a wheel touches along a line, and rolls true on any
// point of it. Friction across holds the centripetal force by creeping, which is in vy: at 0.2 m/s
// and R 0.2 m by 0.9 % of the speed.
#include <fmt/format.h>

#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kShare = 0.005;

class Tricycle final : public Law {
 public:
  std::string_view statement() const override {
    return "one wheel at (L, 0) that drives and steers by d: R = L / tan(d), vx = omega r cos(d), "
           "w = omega r sin(d) / L";
  }
  std::vector<WrongModel> notices() const override {
    return {kLargerWheels, {.steering_add_rad = 0.02}};
  }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double heading_deg : {15.0, 30.0, -45.0, 60.0})
      for (const double speed_mps : {0.2, -0.1}) Turn(heading_deg, speed_mps, wrong, rows);
  }

 private:
  static void Turn(double heading_deg, double speed_mps, const WrongModel& wrong,
                   std::vector<LawRow>& rows) {
    constexpr double kTime_s = 5;
    Rig rig("scrubber", {.wrong = wrong});
    const WheelSpec& wheel = rig.robot().wheels.front();
    const double heading_rad = heading_deg * kPi / 180, base_m = wheel.p_BW.x();
    const double curvature = std::tan(heading_rad) / base_m;
    const mjModel* m = rig.sim().model();
    const auto steps = static_cast<int>(kTime_s / m->opt.timestep);
    const int dof = m->jnt_dofadr[m->actuator_trnid[0]];
    rig.Command({speed_mps, 0, speed_mps * curvature});
    BodyTwist mean;
    double omega_radps = 0;
    for (int k = 0; k < steps; ++k) {
      rig.Step();
      if (k < steps / 2) continue;
      const double share = 2.0 / steps;
      mean.vx_mps += share * rig.truth().V_WB_B.vx_mps;
      mean.vy_mps += share * rig.truth().V_WB_B.vy_mps;
      mean.wz_radps += share * rig.truth().V_WB_B.wz_radps;
      omega_radps += share * rig.data()->qvel[dof];
    }
    const std::string law =
        fmt::format("tricycle/scrubber/{:g}deg/{:g}mps", heading_deg, speed_mps);
    const double share = kShare + wheel.half_width_m * std::abs(curvature);
    const auto row = [&](const char* what, double expected, double measured, double of,
                         const char* unit) {
      rows.push_back({law + "/" + what, expected, measured, share * std::abs(of), unit});
    };
    const double rim_mps = omega_radps * wheel.radius_m;
    const double ahead_mps = rim_mps * std::cos(heading_rad);
    const double rate_radps = rim_mps * std::sin(heading_rad) / base_m;
    row("radius", 1 / curvature, mean.vx_mps / mean.wz_radps, 1 / curvature, "m");
    row("speed", ahead_mps, mean.vx_mps, ahead_mps, "m/s");
    row("rate", rate_radps, mean.wz_radps, rate_radps, "rad/s");
    row("aside", 0, mean.vy_mps, ahead_mps, "m/s");
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Tricycle)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A ramp of the floor, as a site file states it, in two ways.
//
// `power`: up a ramp the motors draw what the weight's part along it asks for beside what level
// floor does: the force m g sin(theta) in steady_drive.h. The law of `energy` says the same of a
// gravity that is turned; here the floor is.
// `slip`: the steepest ramp on which a robot with locked wheels stays. A cart whose wheels carry
// all of it: tan(theta) = mu. Where springs press casters to the floor with the force F, which rub
// with mu_c (BELUGA): m g sin(theta) = mu (m g cos(theta) - F) + mu_c F. On Mecanum wheels, facing
// up the ramp, friction acts along rollers at 45 deg: tan(theta) = mu cos 45 deg.
//
// Tolerances: 1 % of the power, as `energy`; 2 % of the tangent, for soft friction creeps, and what
// slides by 3 mm in a second counts as sliding; BELUGA 3 %, as in the law `stopping`: it nods on
// its casters as it is put down.
#include <fmt/format.h>

#include "env/scene/driving_power.h"
#include "validate/bisect.h"
#include "validate/cart.h"
#include "validate/law.h"
#include "validate/made_hazard.h"
#include "validate/steady_drive.h"

namespace floorproof {
namespace {

constexpr double kSpeed_mps = 0.2, kPowerShare = 0.01, kSlipShare = 0.02, kNodding = 0.03;

class Slope final : public Law {
 public:
  std::string_view statement() const override {
    return "up a ramp: power of F = m g sin(theta) at a held speed; locked wheels hold up to "
           "tan(theta) = mu, on Mecanum wheels mu cos 45 deg";
  }
  std::vector<WrongModel> notices() const override { return {kMoreResistance, kMoreFriction}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double slope_deg : {3.0, 8.0})
      for (const char* robot : {"beluga", "htetro"}) Power(robot, slope_deg, wrong, rows);
    for (const double mu : {0.2, 0.3}) {
      const RigOptions options{.friction = mu, .wrong = wrong};
      const auto slip = [&](const char* name, double expected, double share, const auto& make) {
        const std::string law = fmt::format("slope/{}/mu{}/slip", name, mu);
        rows.push_back({law, expected, Holds(expected, make, options), share * expected, "tan"});
      };
      const auto bundled = [](const char* name) {
        return [name](RigOptions o) { return Rig(name, std::move(o)); };
      };
      slip("cart", mu, kSlipShare, [](RigOptions o) { return Rig(MakeCart({}), std::move(o)); });
      slip("beluga", BelugaHolds(mu), kNodding, bundled("beluga"));
      slip("htetro", mu * std::cos(kPi / 4), kSlipShare, bundled("htetro"));
    }
  }

 private:
  static void Power(const char* name, double slope_deg, const WrongModel& wrong,
                    std::vector<LawRow>& rows) {
    constexpr double kFoot_m = 0.6, kLength_m = 3, kFrom_m = 1.4, kTo_m = 2.2;
    const Rig truth(name);
    RigOptions options{.wrong = wrong};
    options.hazards = {RampAlongX(slope_deg, kFoot_m, kLength_m)};
    Rig rig(name, std::move(options));
    rig.Command({kSpeed_mps, 0, 0});
    double energy_j = 0, time_s = 0;
    while (rig.truth().p_WB.x() < kTo_m && rig.truth().t_s < 30) {
      rig.Step();
      if (rig.truth().p_WB.x() < kFrom_m) continue;
      energy_j += MotorsPower(rig) * rig.sim().model()->opt.timestep;
      time_s += rig.sim().model()->opt.timestep;
    }
    const double force_n = Weight(truth.robot()) * std::sin(slope_deg * kPi / 180);
    const double expected_w = DriveSteadily(truth, kSpeed_mps, force_n).power_w;
    rows.push_back({fmt::format("slope/{}/{}deg/power", name, slope_deg), expected_w,
                    energy_j / time_s, kPowerShare * expected_w, "W"});
  }

  // The tangent at which casters and wheels just hold it: bisection.
  static double BelugaHolds(double mu) {
    const Rig truth("beluga");
    const mjModel* m = truth.scene().model.get();
    const double rubs =
        CasterDrag(m, truth.robot(), 0) / Weight(truth.robot());  // shares of the weight
    const double light = rubs / m->geom_friction[3 * mj_name2id(m, mjOBJ_GEOM, "caster_front")];
    double low = 0, high = 1;
    for (int i = 0; i < 50; ++i) {
      const double angle = std::atan((low + high) / 2);
      const double holds = mu * (std::cos(angle) - light) + rubs;
      (std::sin(angle) < holds ? low : high) = (low + high) / 2;
    }
    return (low + high) / 2;
  }

  // The steepest ramp that holds it, as a tangent, near the one expected.
  template <class MakeRig>
  static double Holds(double expected, const MakeRig& make_rig, const RigOptions& options) {
    return Bisect(0.85 * expected, 1.15 * expected, 0.004 * expected, [&](double tangent) {
      RigOptions on_ramp = options;
      const double slope_deg = std::atan(tangent) * 180 / kPi;
      on_ramp.hazards = {RampAlongX(slope_deg, -kHalf_m, 2 * kHalf_m)};
      Rig rig = make_rig(std::move(on_ramp));
      return !Slides(rig, std::atan(tangent));
    });
  }

  // Put on the ramp with its nose uphill, wheels locked.
  static bool Slides(Rig& rig, double slope_rad) {
    constexpr double kSettle_s = 2, kWatch_s = 1, kSlides_m = 0.003;
    const Eigen::Quaterniond nose_up(Eigen::AngleAxisd(-slope_rad, Vec3::UnitY()));
    rig.Brake();
    rig.SetBase({0, 0, kHalf_m * std::tan(slope_rad)}, nose_up, Vec3::Zero());
    const double start_s = rig.truth().t_s;
    while (rig.truth().t_s < start_s + kSettle_s) rig.Step();
    const Vec3 from_W = rig.truth().p_WB;
    while (rig.truth().t_s < start_s + kSettle_s + kWatch_s) rig.Step();
    return (rig.truth().p_WB - from_W).norm() > kSlides_m;
  }

  static Hazard RampAlongX(double slope_deg, double foot_m, double length_m) {
    return MakeHazard("ramp", fmt::format("slope_deg: {}", slope_deg),
                      Rectangle({foot_m, -2}, {foot_m + length_m, 2}));
  }
  static constexpr double kHalf_m = 2;
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Slope)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The highest step that wheels climb slowly, by statics. A wheel at the edge carries N along the
// line from the edge to its axle, at an angle p from upright, and rubs with mu N along the tangent.
// Its tyre, K, stands sunk by F / K under its load and is sunk by N / K at the edge, so that
//   h = (R + F / K) (1 - cos p) + N / K cos p.
// All wheels are driven and slip, so all friction is used. With the load Nr on
// the other wheels, their places and the centre of mass:
//   along   N (sin p - mu cos p) = mu_r Nr
//   up      N (cos p + mu sin p) + Nr = W
//   tilt    N (cos p + mu sin p) (x1 + R sin p) + N (sin p - mu cos p) h = x_r Nr
// with x1 from the centre of mass to the first axle and x_r back to where Nr acts.
//
// BELUGA: casters hardly rub, Nr counts for nothing: tan p = mu.
// A cart of two driven axles, its weight forward so that the front one decides: exact. It is driven
// at 1 cm/s: spinning at 2 cm/s against the edge, its wheels hop, which is worth 0.7 mm.
// hTetro, four rows of Mecanum wheels: friction acts along rollers at 45 deg, mu / sqrt 2 forward.
// Sideways it meets the edge with its rollers' radius, and the rollers' axis, projected on the
// tangent plane there, leaves mu cos p / sqrt(1 + cos^2 p) upward. Three rows share Nr, which
// statics does not determine: least helpful is all of it on the last row, and so it is once the
// first row has risen by what the contacts give, 0.2 mm under a quarter of the weight. Until then
// the rows between help, which is worth up to 0.35 mm of height: the interval is [h, h + 0.35 mm].
//
// Tolerances: 0.35 mm for plain wheels (casters rub, the wheels hop a little); hTetro's interval
// with 0.2 mm on either side. How fast they are driven matters: slower, the motors' drivers, which
// droop, do not give all that the wheels could use, and faster the spinning wheels hop (hTetro at 2
// cm/s climbs 0.4 mm more).
#include <fmt/format.h>

#include <algorithm>

#include "validate/bisect.h"
#include "validate/cart.h"
#include "validate/climb.h"
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kBeluga_mps = 0.02, kHtetro_mps = 0.015, kCart_mps = 0.01;
constexpr double kPlain_m = 0.00035, kShared_m = 0.00035, kMecanum_m = 0.0002;

// Where things are along the way driven, from the centre of mass.
struct Rows {
  double radius_m;       // that meets the edge
  double first_m;        // to the middle of that radius, in the first row
  double last_m;         // back to the last row
  double mu_rest;        // along the way, of wheels on the floor
  bool rollers = false;  // met sideways: the friction upward is the rollers'
  double mu;
  double weight_n, wheels;  // carried in all; in the first row
  const Foot* foot;         // of these
};

// The height of an edge that such a wheel meets at p and presses on with this.
double HeightAt(double p, double radius_m, double load_n, const Foot& foot) {
  return (radius_m + foot.sink_m()) * (1 - std::cos(p)) +
         load_n / foot.tyre.stiffness_npm * std::cos(p);
}

// The friction coefficient along the way, of a wheel that presses on the edge at p.
double FrictionAt(const Rows& rows, double p) {
  if (!rows.rollers) return rows.mu_rest;
  const double c = std::cos(p);
  return rows.mu * c / std::sqrt(1 + c * c);
}

// The step's height at which the three equations hold, p from 0 to 90 deg.
double StaticLimit(const Rows& rows) {
  const double p = Bisect(0.0, kPi / 2, 1e-12, [&](double angle) {
    const double s = std::sin(angle), c = std::cos(angle), h_m = rows.radius_m * (1 - c);
    const double mu = FrictionAt(rows, angle), along = s - mu * c, up = c + mu * s;
    return (rows.first_m + rows.radius_m * s) * up + h_m * along >
           rows.last_m * along / rows.mu_rest;
  });
  const double s = std::sin(p), c = std::cos(p), mu = FrictionAt(rows, p);
  const double load_n = rows.weight_n / (c + mu * s + (s - mu * c) / rows.mu_rest);
  return HeightAt(p, rows.radius_m, load_n / rows.wheels, *rows.foot);
}

// The highest step climbed, to 1 %.
template <class MakeRig>
double Climbed(const MakeRig& make_rig, const ClimbPlace& place, bool sideways, double speed_mps,
               double about_m) {
  return HighestClimbed(0.7 * about_m, 1.35 * about_m, 0.01 * about_m, place, sideways, speed_mps,
                        make_rig);
}

class StepLimit final : public Law {
 public:
  std::string_view statement() const override {
    return "the highest step climbed slowly: R (1 - cos p) with sin p - mu cos p = mu Nr / N";
  }
  std::vector<WrongModel> notices() const override { return {kMoreFriction, kLargerWheels}; }
  bool slow() const override { return true; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double mu : {0.6, 0.8}) {
      CartRow(mu, wrong, rows);
      Rig beluga("beluga"), htetro("htetro");
      const Foot& wheel = DrivenFoot(beluga);
      const double p = std::atan(mu), edge_n = wheel.load_n / (std::cos(p) + mu * std::sin(p));
      const double radius_m = beluga.robot().wheels.front().radius_m;
      RobotRow(beluga, false, mu, HeightAt(p, radius_m, edge_n, wheel), 0, kPlain_m, kBeluga_mps,
               wrong, rows);
      for (const bool sideways : {false, true})
        RobotRow(htetro, sideways, mu, StaticLimit(HtetroRows(htetro, sideways, mu)), kShared_m,
                 kMecanum_m, kHtetro_mps, wrong, rows);
    }
  }

 private:
  static const Foot& DrivenFoot(const Rig& rig) {
    return *std::ranges::find_if(rig.feet(), &Foot::driven);
  }

  static Rows HtetroRows(const Rig& truth, bool sideways, double mu) {
    const RobotSpec& robot = truth.robot();
    double wheel_m = 0;
    for (const WheelSpec& wheel : robot.wheels)
      wheel_m = std::max(wheel_m, sideways ? wheel.p_BW.y() : wheel.p_BW.x());
    const WheelSpec& wheel = robot.wheels.front();
    const mjModel* m = truth.scene().model.get();
    const double core_m = m->geom_size[3 * mj_name2id(m, mjOBJ_GEOM, wheel.name.c_str()) + 1];
    return {sideways ? wheel.roller_radius_m : wheel.radius_m,
            sideways ? wheel_m + core_m : wheel_m,
            wheel_m,
            mu / std::sqrt(2.0),
            sideways,
            mu,
            robot.mass_kg * kGravity_mps2,
            4,
            &DrivenFoot(truth)};
  }

  // `shared_m`: how far above the static limit the interval reaches.
  static void RobotRow(Rig& truth, bool sideways, double mu, double limit_m, double shared_m,
                       double tolerance_m, double speed_mps, const WrongModel& wrong,
                       std::vector<LawRow>& rows) {
    const std::string& robot = truth.robot().name;
    const auto make_rig = [&](RigOptions options) {
      options.friction = mu;
      options.wrong = wrong;
      Rig rig(robot, std::move(options));
      rig.Command(sideways ? BodyTwist{0, speed_mps, 0} : BodyTwist{speed_mps, 0, 0});
      return rig;
    };
    const ClimbPlace place = PlaceEdge(truth, sideways);
    rows.push_back({fmt::format("step/{}/{}/mu{}", robot, sideways ? "sideways" : "forward", mu),
                    1000 * (limit_m + shared_m / 2),
                    1000 * Climbed(make_rig, place, sideways, speed_mps, limit_m),
                    1000 * (shared_m / 2 + tolerance_m), "mm"});
  }

  static void CartRow(double mu, const WrongModel& wrong, std::vector<LawRow>& rows) {
    const Cart cart{.com_x_m = 0.1};
    Rig truth(MakeCart(cart));
    const Foot& front = *std::ranges::max_element(truth.feet(), {}, &Foot::load_n);
    const double limit_m = StaticLimit({cart.wheel_radius_m, cart.axle_x_m - cart.com_x_m,
                                        cart.axle_x_m + cart.com_x_m, mu, false, mu,
                                        truth.robot().mass_kg * kGravity_mps2, 2, &front});
    const auto make_rig = [&](RigOptions options) {
      options.friction = mu;
      options.wrong = wrong;
      Cart simulated = cart;
      simulated.wheel_radius_m += wrong.wheel_radius_add_m;
      Rig rig(MakeCart(simulated), std::move(options));
      rig.CommandWheels(kCart_mps / cart.wheel_radius_m);
      return rig;
    };
    const ClimbPlace place = PlaceEdge(truth, false);
    rows.push_back({fmt::format("step/cart/forward/mu{}", mu), 1000 * limit_m,
                    1000 * Climbed(make_rig, place, false, kCart_mps, limit_m), 1000 * kPlain_m,
                    "mm"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, StepLimit)

}  // namespace floorproof

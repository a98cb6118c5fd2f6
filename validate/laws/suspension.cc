// SPDX-License-Identifier: Apache-2.0
// A body of mass m on four suspended wheels, springs of stiffness k and damping c each, let go with
// its springs slack, swings about its sag and comes to rest there:
//
//   sag = m g / (4 k),  w = sqrt(4 k / m),  z = c / (2 sqrt(k m / 4)),
//   first lowest after pi / (w sqrt(1 - z^2)), at sag (1 + exp(-pi z / sqrt(1 - z^2))).
//
// m is what the springs carry: the wheels stand on the floor. The rover, as bundled, is to stand as
// its model does: its springs are set so that its sag is none.
//
// Tolerances: 1 % of the sag and of the lowest, for the floor's softness under the wheels and the
// implicit integrator, which takes energy out of a swing (5 % of the lowest at 4 ms: the step is
// 0.5 ms here); 1 % of the time. The rover 0.1 mm and its tyres, which give by 0.8 mm at most
// (env/scene/tyre.h). Springs feel neither friction nor larger wheels; the wrong model is gravity
// x 1.3, under which the rover sinks by 3 mm.
#include <fmt/format.h>

#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kShare = 0.01, kTimeShare = 0.01, kTyres_m = 0.0009;
constexpr double kFine_s = 0.0005;
constexpr double kBody_kg = 20, kStiffness_npm = 4000, kDamping_nspm = 40;

RobotModel OnFourSprings() {
  std::string wheels;
  for (const double x : {0.2, -0.2})
    for (const double y : {0.15, -0.15})
      wheels += fmt::format(
          R"(<body pos="{} {} 0.05"><joint type="slide" axis="0 0 1" stiffness="{}" damping="{}"/>
          <joint axis="0 1 0"/><geom type="cylinder" size="0.05 0.01" zaxis="0 1 0" mass="1"
          contype="0"/></body>)",
          x, y, kStiffness_npm, kDamping_nspm);
  return BodyFromMjcf(fmt::format(
      R"(<mujoco><worldbody><body name="base"><freejoint/>
      <geom type="box" size="0.25 0.2 0.05" pos="0 0 0.15" mass="{}" contype="0" conaffinity="3"/>
      {}</body></worldbody></mujoco>)",
      kBody_kg, wheels));
}

class Suspension final : public Law {
 public:
  std::string_view statement() const override {
    return "on suspended wheels: sag m g / (4 k), reached past a first lowest after "
           "pi / (w sqrt(1 - z^2)), w = sqrt(4 k / m)";
  }
  std::vector<WrongModel> notices() const override { return {{.gravity_factor = 1.3}}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    constexpr double kRest_s = 2;
    RigOptions options{.wrong = wrong};
    options.physics.timestep_s = kFine_s;
    Rig rig(OnFourSprings(), std::move(options));
    std::fill_n(rig.data()->qpos, rig.sim().model()->nq, 0.0);
    rig.SetBase(Vec3::Zero(), Eigen::Quaterniond::Identity(), Vec3::Zero());
    double lowest_m = 0, lowest_s = 0;
    while (rig.truth().t_s < kRest_s) {
      rig.Step();
      if (rig.truth().p_WB.z() >= lowest_m) continue;
      lowest_m = rig.truth().p_WB.z();
      lowest_s = rig.truth().t_s;
    }
    const double sag_m = kBody_kg * kGravity_mps2 / (4 * kStiffness_npm);
    const double w = std::sqrt(4 * kStiffness_npm / kBody_kg);
    const double z = kDamping_nspm / (2 * std::sqrt(kStiffness_npm * kBody_kg / 4));
    const double swing_s = kPi / (w * std::sqrt(1 - z * z));
    const double deepest_m = sag_m * (1 + std::exp(-z * w * swing_s));
    rows.push_back({"suspension/cart/sag", sag_m, -rig.truth().p_WB.z(), kShare * sag_m, "m"});
    rows.push_back({"suspension/cart/lowest", deepest_m, -lowest_m, kShare * deepest_m, "m"});
    rows.push_back({"suspension/cart/time", swing_s, lowest_s, kTimeShare * swing_s, "s"});

    Rig rover("rover", {.wrong = wrong});
    while (rover.truth().t_s < kRest_s) rover.Step();
    rows.push_back({"suspension/rover/sag", 0, -rover.truth().p_WB.z(), kTyres_m, "m"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Suspension)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A swivel caster trails behind. Its pivot is driven straight on; its wheel, a trail t behind the
// pivot and an angle d off where it will end, rolls along itself and does not slide across, so
//
//   t d' = -v sin d:   tan(d / 2) = tan(d_0 / 2) exp(-s / t)
//
// after the way s, whatever the speed, the load and the friction are. The wheel is a ball on an
// axle, which touches at a point: what a tyre's width adds is not in this. The caster slides on a
// spring, as suspended ones do, under a sledge that glides and is too heavy to be turned by it.
//
// Tolerance: 1.2 deg. The wheel stands when the sledge lets it go, and takes the 10 ms in which
// friction stops a slip, twice over, to get going: a millimetre of a trail of 40 mm. Neither
// friction nor gravity is in the law; its wrong model has a caster that is larger all over, in
// trail and radius.
#include <fmt/format.h>

#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kDegree = kPi / 180, kOff_deg = 1.2;
constexpr double kFine_s = 0.001;
constexpr double kTrail_m = 0.04, kRadius_m = 0.03;
constexpr double kSpring_npm = 2000, kLoad_n = 30;

// A sledge on four skids without friction, its caster's pivot in its middle.
RobotModel Sledge(double larger_m) {
  std::string skids;
  for (const double x : {0.2, -0.2})
    for (const double y : {0.15, -0.15})
      skids += fmt::format(
          R"(<body pos="{} {} 0.02"><geom type="sphere" size="0.02" mass="1" contype="0"
          priority="2" friction="0 0 0"/></body>)",
          x, y);
  const double radius_m = kRadius_m + larger_m;
  return BodyFromMjcf(fmt::format(
      R"(<mujoco><compiler angle="radian"/><worldbody><body name="base"><freejoint/>
      <geom type="box" size="0.25 0.2 0.02" pos="0 0 0.12" mass="2000" contype="0" conaffinity="3"/>
      {}<body name="fork" pos="0 0 {}">
      <joint name="spring" type="slide" axis="0 0 1" stiffness="{}" springref="{}" damping="20"/>
      <joint name="swivel" axis="0 0 1"/>
      <geom type="box" size="0.01 0.01 0.01" mass="0.1" contype="0" conaffinity="0"/>
      <body pos="{} 0 0"><joint axis="0 1 0"/>
      <geom type="sphere" size="{}" mass="0.5" contype="0"/></body></body>
      </body></worldbody></mujoco>)",
      skids, radius_m, kSpring_npm, -kLoad_n / kSpring_npm, -(kTrail_m + larger_m), radius_m));
}

class SwivelCaster final : public Law {
 public:
  std::string_view statement() const override {
    return "a swivel caster's pivot moves straight on: tan(d / 2) = tan(d_0 / 2) exp(-s / trail)";
  }
  std::vector<WrongModel> notices() const override { return {kLargerWheels}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double start_deg : {60.0, 150.0})
      for (const double speed_mps : {0.02, 0.05}) Trail(start_deg, speed_mps, wrong, rows);
  }

 private:
  static void Trail(double start_deg, double speed_mps, const WrongModel& wrong,
                    std::vector<LawRow>& rows) {
    RigOptions options;
    options.physics.timestep_s = kFine_s;
    Rig rig(Sledge(wrong.wheel_radius_add_m), std::move(options));
    const mjModel* m = rig.sim().model();
    const int swivel = mj_name2id(m, mjOBJ_JOINT, "swivel"), q = m->jnt_qposadr[swivel];
    rig.data()->qpos[q] = start_deg * kDegree;
    rig.SetBase({0, 0, rig.truth().p_WB.z()}, Eigen::Quaterniond::Identity(), {speed_mps, 0, 0});
    for (const int trails : {1, 2, 4}) {
      while (rig.truth().p_WB.x() < trails * kTrail_m) rig.Step();
      const double way_m = rig.truth().p_WB.x();
      const double expected =
          2 * std::atan(std::tan(start_deg * kDegree / 2) * std::exp(-way_m / kTrail_m));
      rows.push_back({fmt::format("caster/from{}/v{}/after{}", start_deg, speed_mps, trails),
                      expected / kDegree, rig.data()->qpos[q] / kDegree, kOff_deg, "deg"});
    }
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, SwivelCaster)

}  // namespace floorproof

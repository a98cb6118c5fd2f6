// SPDX-License-Identifier: Apache-2.0
// A wheel that rolls moves its axle by omega R, with omega the speed that its hub measures:
// odometry relies on this. A Mecanum wheel at 45 deg does so forward and, with its rollers turning,
// sideways (Muir & Neuman 1987). The motors' droop, which is part of the law of kinematics, is not
// part of this one.
//
// Tolerance 0.1 %: what is left is the creep of soft contacts under the force of rolling friction;
// a plain wheel also shows the sink of some micrometres into the floor.
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kCreep = 0.001;

class Rolling final : public Law {
 public:
  std::string_view statement() const override {
    return "v = omega R with the wheels' measured speed, driven steadily on a flat floor";
  }
  std::vector<WrongModel> notices() const override { return {kLargerWheels}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double v_mps : {0.1, 0.25, -0.2}) {
      const std::string speed = v_mps > 0 ? "/forward" : "/backward";
      Row("beluga", speed, {v_mps, 0, 0}, wrong, rows);
      Row("htetro", speed, {v_mps, 0, 0}, wrong, rows);
      Row("htetro", v_mps > 0 ? "/left" : "/right", {0, v_mps, 0}, wrong, rows);
    }
  }

 private:
  static void Row(const std::string& robot, const std::string& way, const BodyTwist& twist,
                  const WrongModel& wrong, std::vector<LawRow>& rows) {
    constexpr double kSteady_s = 1, kEnd_s = 2;
    Rig rig(robot, {.wrong = wrong});
    rig.Run(twist, kSteady_s);
    const mjModel* m = rig.sim().model();
    const int num_wheels = static_cast<int>(rig.robot().wheels.size());
    double omega_radps = 0, v_mps = 0;
    int n = 0;
    while (rig.truth().t_s < kEnd_s) {
      rig.Step();
      for (int a = 0; a < num_wheels; ++a)
        omega_radps +=
            std::abs(rig.data()->qvel[m->jnt_dofadr[m->actuator_trnid[2 * a]]]) / num_wheels;
      v_mps += rig.truth().v_WB_W.head<2>().norm();
      ++n;
    }
    const double expected_mps = omega_radps / n * rig.robot().wheels.front().radius_m;
    const double commanded_mps = std::hypot(twist.vx_mps, twist.vy_mps);
    rows.push_back({"rolling/" + robot + way + std::to_string(std::lround(commanded_mps * 100)),
                    expected_mps, v_mps / n, kCreep * commanded_mps, "m/s"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Rolling)

}  // namespace floorproof

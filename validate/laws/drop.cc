// SPDX-License-Identifier: Apache-2.0
// Free fall: a robot let go at a height h meets the floor after sqrt(2 h / g) with sqrt(2 g h).
// BELUGA's casters and the rover's wheels hang out of it, from the start, by their springs' travel,
// and meet the floor earlier by that much.
//
// Tolerances: the integrator moves by the new velocity, so a fall ends half a step early; finding
// the floor may take one more step. Neither friction nor wheels can be felt in a fall (larger
// wheels only start it with the body higher), so the wrong model is gravity x 1.3.
#include <fmt/format.h>

#include "validate/law.h"

namespace floorproof {
namespace {

// Lets what slides on springs hang as far as it does when nothing carries it; returns how far that
// is below where it stands.
double HangOut(Rig& rig) {
  const mjModel* m = rig.sim().model();
  double travel_m = 0;
  for (int j = 0; j < m->njnt; ++j) {
    if (m->jnt_type[j] != mjJNT_SLIDE || !m->jnt_limited[j]) continue;
    rig.data()->qpos[m->jnt_qposadr[j]] = m->jnt_range[2 * j];
    travel_m = std::max(travel_m, -m->jnt_range[2 * j]);
  }
  return travel_m;
}

class Drop final : public Law {
 public:
  std::string_view statement() const override {
    return "let fall from h: t = sqrt(2 h / g), v = sqrt(2 g h) at the floor";
  }
  std::vector<WrongModel> notices() const override { return {{.gravity_factor = 1.3}}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const RobotEntry& robot : Robots())
      for (const double height_m : {0.05, 0.10, 0.20}) {
        Rig rig(std::string(robot.name), {.wrong = wrong});
        const double step_s = rig.sim().model()->opt.timestep;
        const double way_m = height_m - HangOut(rig);
        rig.SetBase({0, 0, height_m}, Eigen::Quaterniond::Identity(), Vec3::Zero());
        double v_mps = 0;
        rig.Step();
        while (rig.truth().wheel_contacts == 0) {
          v_mps = -rig.truth().v_WB_W.z();
          rig.Step();
        }
        const std::string law =
            fmt::format("drop/{}/{}mm", robot.name, std::lround(height_m * 1000));
        rows.push_back({law + "/time", std::sqrt(2 * way_m / kGravity_mps2), rig.truth().t_s,
                        1.5 * step_s, "s"});
        rows.push_back({law + "/speed", std::sqrt(2 * kGravity_mps2 * way_m), v_mps,
                        1.5 * step_s * kGravity_mps2, "m/s"});
      }
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Drop)

}  // namespace floorproof

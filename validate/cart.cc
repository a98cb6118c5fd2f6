// SPDX-License-Identifier: Apache-2.0
#include "validate/cart.h"

#include <fmt/format.h>

#include <algorithm>

namespace floorproof {

RobotModel MakeCart(const Cart& cart) {
  constexpr double kBox_kg = 9, kWheel_kg = 0.3;
  std::string wheels, motors;
  for (int i = 0; i < 4; ++i) {
    const double x = i < 2 ? cart.axle_x_m : -cart.axle_x_m, y = i % 2 ? 0.15 : -0.15;
    wheels += fmt::format(
        R"(<body pos="{} {} {}"><joint name="w{}" axis="0 1 0" armature="0.002" frictionloss="0.02"/>
        <geom type="cylinder" size="{} 0.008" zaxis="0 1 0" mass="{}" contype="0"/></body>)",
        x, y, cart.wheel_radius_m, i, cart.wheel_radius_m, kWheel_kg);
    motors += fmt::format(R"(<velocity joint="w{}" kv="5" forcerange="{} {}"/>)", i, -cart.motor_nm,
                          cart.motor_nm);
  }
  std::string nose;
  if (cart.nose_m > 0)
    nose = fmt::format(
        R"(<geom type="box" size="{} {} 0.03" pos="{} 0 {}" mass="0" contype="0" conaffinity="3"/>)",
        cart.nose_m / 2, kNoseHalfWidth_m, cart.nose_m / 2, cart.clearance_m + 0.03);
  std::string custom;
  const auto state = [&](const char* key, const std::optional<double>& value) {
    if (value) custom += fmt::format(R"(<numeric name="{}" data="{}"/>)", key, *value);
  };
  state("tyre_stiffness_npmm", cart.tyre_npmm);
  state("tyre_damping_ratio", cart.tyre_damping_ratio);
  const double box_x = cart.com_x_m * (kBox_kg + 4 * kWheel_kg) / kBox_kg;
  RobotModel out = BodyFromMjcf(fmt::format(
      R"(<mujoco><custom>{}</custom><worldbody><body name="base"><freejoint/>
      <geom type="box" size="0.1 0.12 0.02" pos="{} 0 {}" mass="{}" contype="0" conaffinity="3"/>
      {}{}</body></worldbody><actuator>{}</actuator></mujoco>)",
      custom, box_x, cart.wheel_radius_m + 0.02, kBox_kg, nose, wheels, motors));
  out.spec.name = "cart";
  return out;
}

void Coast(Rig& rig, const Cart& cart, double speed_mps, double floor_m) {
  mjModel* m = rig.sim().model();
  m->opt.disableflags |= mjDSBL_ACTUATION;
  std::fill_n(m->dof_frictionloss, m->nv, 0.0);
  for (int a = 0; a < m->nu; ++a)
    rig.data()->qvel[m->jnt_dofadr[m->actuator_trnid[2 * a]]] = speed_mps / cart.wheel_radius_m;
  rig.SetBase({0, 0, floor_m}, Eigen::Quaterniond::Identity(), {speed_mps, 0, 0});
}

}  // namespace floorproof

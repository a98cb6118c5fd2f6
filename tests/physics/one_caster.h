// SPDX-License-Identifier: Apache-2.0
// A robot as users build it: two driven wheels, one caster at the front, and a round body whose
// rear edge comes down on the floor when it leans back by 5 degrees.
#pragma once

namespace floorproof {

inline constexpr char kOneCaster[] = R"(
<mujoco model="one_caster">
  <custom>
    <text name="drive" data="differential"/>
    <text name="clear_shape" data="circle"/>
    <text name="tool_shape" data="circle"/>
    <numeric name="tool_width_m" data="0.30"/>
    <numeric name="step_m" data="0.005"/>
    <numeric name="cruise_mps" data="0.2"/>
    <numeric name="max_speed_mps" data="0.35"/>
    <numeric name="max_accel_mps2" data="0.5"/>
    <numeric name="max_yaw_rate_radps" data="1.5"/>
    <numeric name="max_yaw_accel_radps2" data="4.0"/>
    <numeric name="hotel_load_w" data="5"/>
  </custom>
  <compiler angle="radian" autolimits="true"/>
  <default>
    <default class="body"><geom contype="0" conaffinity="3" friction="0.3 0.005 0.0001"/></default>
    <default class="wheel">
      <geom type="cylinder" size="0.04 0.01" zaxis="0 1 0" contype="0" conaffinity="1" condim="3" mass="0.2"/>
      <joint type="hinge" axis="0 1 0" armature="0.002" damping="0.001" frictionloss="0.01"/>
      <dcmotor nominal="12 2 12" input="vel" controller="0 0 2 0 0 12"/>
    </default>
  </default>
  <worldbody>
    <body name="base">
      <freejoint name="root"/>
      <geom class="body" type="cylinder" size="0.17 0.05" pos="0 0 0.065" mass="4.5"/>
      <geom class="body" type="box" size="0.05 0.06 0.03" pos="0.05 0 0.07" mass="2"/>
      <body name="wheel_left" pos="0 0.13 0.04">
        <joint name="wheel_left" class="wheel"/>
        <geom class="wheel"/>
      </body>
      <body name="wheel_right" pos="0 -0.13 0.04">
        <joint name="wheel_right" class="wheel"/>
        <geom class="wheel"/>
      </body>
      <body name="caster" pos="0.14 0 0.015">
        <geom type="sphere" size="0.015" contype="0" conaffinity="1" condim="3" priority="2" friction="0.02 0 0" mass="0.05"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <dcmotor name="wheel_left" joint="wheel_left" class="wheel"/>
    <dcmotor name="wheel_right" joint="wheel_right" class="wheel"/>
  </actuator>
</mujoco>
)";

}  // namespace floorproof

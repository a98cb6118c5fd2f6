// SPDX-License-Identifier: Apache-2.0
// A room to film: 6 x 4 m, walls, a table, a glass pane, optionally a step, and a box robot with
// two wheels that stands on a free joint at the origin, looking along x.
#pragma once

#include <string>

namespace floorproof {

struct RoomOptions {
  bool step = true;   // 40 mm high, at x = 1 m, y = -1.5 .. 0.5 m
  bool glass = true;  // at x = 1.9 m, y = -0.4 .. 0.4 m
  bool walls = true;
};

inline std::string RoomMjcf(const RoomOptions& options = {}) {
  std::string xml = R"(
<mujoco model="room">
  <statistic center="0 0 0.3" extent="4"/>
  <visual>
    <headlight ambient="0.40 0.40 0.42" diffuse="0.15 0.15 0.15" specular="0 0 0"/>
    <quality shadowsize="1024" offsamples="4" numquads="1"/>
  </visual>
  <asset>
    <texture name="sky" type="skybox" builtin="gradient" rgb1="0.93 0.95 0.97"
             rgb2="0.66 0.73 0.80" width="64" height="384"/>
    <texture name="tiles" type="2d" builtin="flat" mark="edge" rgb1="0.90 0.88 0.84"
             markrgb="0.74 0.72 0.68" width="256" height="256"/>
    <material name="floor" texture="tiles" texrepeat="4 4" texuniform="true" specular="0"/>
    <material name="wall" rgba="0.52 0.58 0.66 1" specular="0"/>
    <material name="step" rgba="0.90 0.55 0.20 1" specular="0"/>
    <material name="glass" rgba="0.55 0.80 0.88 0.25" specular="0.4"/>
    <material name="shell" rgba="0.95 0.96 0.97 1" specular="0.3" shininess="0.6"/>
    <material name="trim" rgba="0.09 0.42 0.62 1" specular="0.3" shininess="0.6"/>
    <material name="rubber" rgba="0.10 0.10 0.11 1" specular="0.1"/>
  </asset>
  <worldbody>
    <light directional="true" pos="0 0 6" dir="0.30 0.40 -1" diffuse="0.52 0.51 0.48"
           specular="0.15 0.15 0.15" ambient="0 0 0" castshadow="true"/>
    <geom name="floor" type="plane" size="6 4 0.1" material="floor"/>)";
  if (options.walls) {
    xml += R"(
    <geom name="west" type="box" pos="-3.05 0 0.3" size="0.05 2.1 0.3" material="wall"/>
    <geom name="east" type="box" pos="3.05 0 0.3" size="0.05 2.1 0.3" material="wall"/>
    <geom name="south" type="box" pos="0 -2.05 0.3" size="3 0.05 0.3" material="wall"/>
    <geom name="north" type="box" pos="0 2.05 0.3" size="3 0.05 0.3" material="wall"/>
    <geom name="table" type="box" pos="-1.5 1.2 0.2" size="0.5 0.3 0.2" material="wall"/>)";
  }
  if (options.step) {
    xml += R"(
    <geom name="step" type="box" pos="1.25 -0.5 0.02" size="0.25 1 0.02" material="step"/>)";
  }
  if (options.glass) {
    xml += R"(
    <geom name="glass" type="box" pos="1.9 0 0.3" size="0.01 0.4 0.3" material="glass"/>)";
  }
  return xml + R"(
    <body name="base" pos="0 0 0">
      <freejoint/>
      <geom type="cylinder" size="0.17 0.04" pos="0 0 0.07" material="shell" mass="4"/>
      <geom type="cylinder" size="0.172 0.008" pos="0 0 0.075" material="trim" mass="0.1"/>
      <geom type="box" size="0.03 0.05 0.012" pos="0.08 0 0.118" material="trim" mass="0.1"/>
      <geom type="cylinder" size="0.035 0.012" pos="0 0.155 0.035" euler="90 0 0"
            material="rubber" mass="0.2"/>
      <geom type="cylinder" size="0.035 0.012" pos="0 -0.155 0.035" euler="90 0 0"
            material="rubber" mass="0.2"/>
    </body>
  </worldbody>
</mujoco>)";
}

}  // namespace floorproof

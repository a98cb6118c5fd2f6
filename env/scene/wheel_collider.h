// SPDX-License-Identifier: Apache-2.0
// The collider of wheels. A wheel touches each plane once, below its middle where it stands
// upright, so that its tyre's stiffness counts once. It also makes a core that MuJoCo sees a
// Mecanum wheel, whose rollers have no mass.
//
// A wheel of radius R with rollers of radius r is a core cylinder of radius R - r, whose geom
// carries `user="r angle"` (WheelSpec says which angle). The collider does two more things. (1)
// It inflates the core by r, which rounds it as the rollers do: R forward, r sideways. (2) It turns
// each contact's first tangent along the axis of the roller that touches there. With pairs that
// have friction along the first tangent only, the rollers spin freely about their axes. The
// rounding decides what the wheel climbs sideways; docs/physics.md has the figures. Assumes
// infinitely many, massless, frictionless rollers; a roller never meets two obstacles.
#pragma once

#include <mujoco/mujoco.h>

namespace floorproof {

struct Rollers {
  double radius_m = 0;   // 0: a plain wheel
  double angle_rad = 0;  // as in WheelSpec::roller_angle_rad
};

// What the geom's user data say; a plain wheel where they say nothing.
Rollers RollersOf(const mjModel* model, int geom);
Rollers RollersOf(const mjsGeom* geom);

// Installs the collider for all models of the process. MuJoCo's table of colliders is global: call
// it before other threads start. Calls after the first do nothing. Geoms that are not marked, other
// programs' models among them, pass through to MuJoCo's own colliders, bit for bit.
void InstallWheelCollider();

// Lets the bounds of the cores, by which MuJoCo finds who may touch, hold the rollers too. Once,
// after compiling.
void InflateWheelBounds(mjModel* model);

// Makes the geom, if it is a cylinder, a wheel to the collider.
void MarkPaired(mjSpec* spec, mjsGeom* geom);

}  // namespace floorproof

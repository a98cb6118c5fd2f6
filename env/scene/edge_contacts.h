// SPDX-License-Identifier: Apache-2.0
// Contacts of a robot's body with edges: held on the side from which the body came.
//
// Contacts are soft. A body that meets a face at speed v sinks into it by some millimetres, and if
// the face reaches less than that above the body's bottom, the shortest way out is up: MuJoCo's
// colliders, which see one moment, lift the body over an edge that holds it. This collider
// remembers the normal between a body geom and a solid from when they were still apart. While they
// overlap, it moves the geom back along that normal until the two are just apart, reads the contact
// there, and applies it with the depth at which the geom really is. So the normal turns only as it
// would between rigid bodies: a geom that rises above the edge, or turns a rounded or slanted side
// to it, is lifted.
//
// An edge must still meet the side of a geom that is raised by 0.2 mm plus twice its sink into the
// floor that carries it. So the seams of a floor and the foot of a ramp are no edges. Walls are
// higher than bodies and are left to MuJoCo.
//
// The memory is mjData's user data: it is a part of the state and is cleared when the data are
// reset. Assumes convex geoms. Up to 16 solids near one geom are remembered.
#pragma once

#include <mujoco/mujoco.h>

#include <span>

namespace floorproof {

constexpr double kLookAhead_m = 0.01;  // distance at which edges are noticed: 2.5 m/s at 4 ms

// Installs the collider for all models of the process, as InstallWheelCollider and after it, before
// other threads start. Calls after the first do nothing. Geoms that are not marked pass through to
// the colliders installed before.
void InstallEdgeCollider();

// Makes room for the memory of the geoms that the spec has so far: the robot's. Before compiling.
void ReserveEdgeMemory(mjSpec* spec);

// Marks the geoms of the robot's body. Once, after compiling; no more than there is room for.
void MarkBodyGeoms(mjModel* model, std::span<const int> geoms);

// Removes the marks: bodies collide as in stock MuJoCo.
void UnmarkBodyGeoms(mjModel* model);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What flows through an episode's loop: commands, and the true motion as detectors see it.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "env/core/path.h"
#include "env/known/estimate.h"

namespace floorproof {

// What a tracker asks for, and how far along the path it is (monotone).
struct Command {
  BodyTwist twist;
  HingeState hinges;  // to be held, or turned at these rates towards these angles; not its fork
  // The segment now tracked goes from waypoint `segment` to `segment + 1`. Until a dwell is over it
  // is the one that led there.
  std::size_t segment = 0;
  bool dwelling = false;  // standing still on purpose
  // To be done in this dwell, in order: the tracker's own list, until its path changes.
  std::span<const WaypointTask> tasks = {};
  bool turning = false;   // to turn or fold where it stands: it moves only to hold its place
  bool reacting = false;  // going back from what it met; `segment` is the one that it left
  bool done = false;      // last waypoint reached
};

// The robot touching what stands in its way: its body, but for what it rests upon, or a wheel at a
// face too steep to stand on.
struct ObstacleContact {
  static constexpr int kFloor = -2;
  int hazard = -1;  // index into HazardMap::hazards; -1: wall or furniture of the map; kFloor: the
                    // base floor, or its edge
  Vec2 p_W = Vec2::Zero();       // where
  Vec2 normal_W = Vec2::Zero();  // unit, from the obstacle to the robot, in the plane
  int block = 0;  // index into RobotSpec::blocks of what touches, or carries the wheel that
                  // does; 0 of a rigid robot
  double closing_mps = 0;  // the body's speed into the obstacle there, just before this step
  double impulse_ns = 0;   // normal force times the step
  double height_m = 0;     // of the place, world z
  bool wheel = false;      // a wheel or caster touches
};

// Force on the robot in the world's axes, N, and its moment about the body's origin, N m.
struct Wrench {
  Vec3 force_W_n = Vec3::Zero(), moment_W_nm = Vec3::Zero();
  // Power at a body that moves with this planar velocity, W.
  double Power(const Vec2& v_W, double wz_radps) const {
    return force_W_n.head<2>().dot(v_W) + moment_W_nm.z() * wz_radps;
  }
};

// What one thing does to the robot through all of its contacts, wheels and body alike.
struct Touch {
  int hazard = -1;  // index into HazardMap::hazards; -1: walls or furniture of the map
  Wrench normal, friction;
};

// What truly happened in one step of the plant. Fixed size: the loop allocates nothing.
struct Truth {
  static constexpr int kMaxContacts = 16, kMaxTouches = 8;

  double t_s = 0;
  Vec3 p_WB = Vec3::Zero();  // body origin: on the floor below the robot's centre at rest
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;
  double tilt_rad = 0;  // between the body's z and the world's
  Vec3 v_WB_W = Vec3::Zero();
  BodyTwist V_WB_B;
  HingeState hinges;
  int shape = 0;         // index into RobotSpec::shapes, -1 between two of them; 0 of a rigid robot
  double power_w = 0;    // electrical, motors and hotel load
  double battery_v = 0;  // at the terminals, 0: empty
  double battery_a = 0;  // motors' drivers and hotel load
  double belly_load_n =
      0;  // weight that floor or hazards carry through the body instead of the wheels
  int belly_hazard = -1;  // index of the hazard that carries most of it; -1: none or the floor
  int wheel_contacts = 0;
  double driven_load_n = 0;  // weight that the driven wheels carry
  double rim_mps = 0;        // speed of the driven wheels' rims, mean of their amounts
  // Centre of mass to the border of the hull of what carries it, positive inside. What pushes from
  // aside moves the centre by its moment.
  double support_margin_m = 0;
  Vec2 off_support_W = Vec2::Zero();  // unit, from that border to the centre where it is outside
  double wheel_floor_z_m = 0;         // lowest point of the lowest driven wheel, world z
  // How far a driven wheel has dropped that lost its footing, the most of all
  // (env/sim/drop_meter.h); where that wheel is, and the index of the hazard on which it stood, -1:
  // the base floor.
  double drop_m = 0;
  Vec2 drop_W = Vec2::Zero();
  int drop_hazard = -1;
  double landing_mps = 0;  // downwards, of a wheel that came to stand again in this step
  int near_hazard = -1;    // a hazard under or at a wheel or the body now; -1: none
  std::array<ObstacleContact, kMaxContacts> contacts;  // the first num_contacts hold, body first
  int num_contacts = 0;
  int carried = 0;  // how often it was taken up and set down elsewhere by what befell it
  std::array<Touch, kMaxTouches> touches;  // the first num_touches hold
  int num_touches = 0;

  Pose2 X_WB() const { return {p_WB.x(), p_WB.y(), yaw_rad}; }
};

// What detectors and records see: what happened, and what the robot was about. The episode's loop
// puts it together.
struct Sample : Truth {
  Command command;                  // of this control period
  double cross_track_m = 0;         // of the true position to the segment now tracked; unsigned
  Vec2 off_track_W = Vec2::Zero();  // the same as a vector, from that segment to the robot, m
  // The way gone along the path, m: metres along it, less the distance from it; falls when the
  // robot goes back or aside. Where the path is replaced by another, it goes on from where it was.
  double progress_m = 0;
  // Room across that segment to the nearer pair of obstacles, halved, when the period began.
  double cross_track_half_width_m = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How far driven wheels have dropped: what a fall is made of, wherever it happens.
//
// A wheel stands where a contact under it carries it, on a surface less steep than 45 degrees. Once
// it stands no more it has lost its footing, and it has dropped by the least of three heights:
//   what it has come down since, from the place where it stood;
//   the most room that has been between it and the surface below since;
//   the edges by which the surface below it has gone down since, steeper than 45 degrees.
// The first alone would count a descent, the second a wheel that is lifted. The two together would
// count a robot that rocks over the ridge between two slopes, its wheels in the air and the ground
// before them one that it drives on: there is no edge. While an edge is still under a wheel that
// rolls off it, the room is measured from that edge. Where a wheel comes to stand again, the drop
// is that from stand to stand.
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <vector>

#include "env/core/motion.h"
#include "env/sensors/rays.h"

namespace floorproof {

class DropMeter {
 public:
  // `scene` outlives it; of a robot with so many driven wheels.
  DropMeter(const Scene& scene, std::size_t wheels) : rays_(scene), wheels_(wheels) {}

  // Forgets where the wheels stood: the robot is set down elsewhere.
  void Reset();
  // In each step, first: what touches a wheel from below. `hazard`: index of the contact's, or -1.
  void OnContact(std::size_t wheel, const Vec3& p_W, double normal_z, int hazard);
  // Then, with the lowest point of each wheel, world frame: fills in `truth`. Model and data are
  // those of the simulation. Allocates nothing.
  void Update(const mjModel* model, const mjData* data, std::span<const Vec3> lowest_W,
              Truth& truth);

 private:
  struct Wheel {
    // Of this step.
    bool stands = false, touches = false;
    Vec3 stand_W = Vec3::Zero();  // the highest contacts of either kind
    double stand_up = 0;          // the vertical part of its normal
    double touch_m = 0;
    int stand_hazard = -1;
    // Since it stood.
    bool stood = false;  // at all, since it was set down
    double stood_m = 0, most_room_m = 0;
    int stood_hazard = -1;
    // Since it stood upright.
    Vec3 floor_W = Vec3::Zero();  // the surface below it in the step before
    double edges_m = 0;
    double low_m = 0;  // in the step before
  };
  static void FollowFloor(const Vec3& floor_W, Wheel& wheel);
  // From this point down to the first surface of the world.
  double RoomBelow(const mjData* data, const Vec3& p_W) const;

  Rays rays_;
  std::vector<Wheel> wheels_;
};

}  // namespace floorproof

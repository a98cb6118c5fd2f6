// SPDX-License-Identifier: Apache-2.0
#include "env/sim/drop_meter.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

constexpr double kStands = 0.7;         // least vertical part of a normal on which a wheel stands
constexpr double kUpright = 0.94;       // 20 degrees: the contact is close to below the axle
constexpr double kBottomless_m = 1000;  // room where nothing lies below

}  // namespace

double DropMeter::RoomBelow(const mjData* d, const Vec3& p_W) const {
  constexpr double kAbove_m = 0.01;  // the point may be a hair below the surface
  const RayHit hit =
      rays_.Cast(d, p_W + kAbove_m * Vec3::UnitZ(), -Vec3::UnitZ(), kBottomless_m + kAbove_m);
  return hit.hits() ? std::max(0.0, hit.range_m - kAbove_m) : kBottomless_m;
}

void DropMeter::Reset() { std::ranges::fill(wheels_, Wheel{}); }

void DropMeter::OnContact(std::size_t wheel, const Vec3& p_W, double normal_z, int hazard) {
  Wheel& w = wheels_[wheel];
  if (!w.touches || p_W.z() > w.touch_m) w.touch_m = p_W.z();
  w.touches = true;
  if (normal_z < kStands || (w.stands && p_W.z() <= w.stand_W.z())) return;
  w.stands = true;
  w.stand_W = p_W;
  w.stand_up = normal_z;
  w.stand_hazard = hazard;
}

// Adds up the edges between here and where the surface was seen before, those up taken off.
void DropMeter::FollowFloor(const Vec3& floor_W, Wheel& w) {
  constexpr double kFlaw_m = 0.002;
  const double down_m = w.floor_W.z() - floor_W.z();
  if (std::abs(down_m) > (floor_W - w.floor_W).head<2>().norm() + kFlaw_m)
    w.edges_m = std::max(0.0, w.edges_m + down_m);
  w.floor_W = floor_W;
}

void DropMeter::Update(const mjModel* m, const mjData* d, std::span<const Vec3> lowest_W,
                       Truth& truth) {
  truth.drop_m = truth.landing_mps = 0;
  truth.drop_hazard = -1;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    Wheel& w = wheels_[i];
    const Vec3& low_W = lowest_W[i];
    const double down_m = w.stood_m - (w.stands ? w.stand_W.z() : low_W.z());
    const bool is_upright = w.stands && w.stand_up > kUpright;
    if (w.stood && !is_upright) {
      const double room_m = RoomBelow(d, low_W);
      FollowFloor({low_W.x(), low_W.y(), low_W.z() - room_m}, w);
      const double edge_m = w.touches ? std::max(0.0, w.touch_m - low_W.z()) : 0;
      if (!w.stands) w.most_room_m = std::max(w.most_room_m, edge_m + room_m);
    }
    const double drop_m = w.stood ? std::min({down_m, w.most_room_m, w.edges_m}) : 0;
    if (drop_m > truth.drop_m) {
      truth.drop_m = drop_m;
      truth.drop_W = low_W.head<2>();
      truth.drop_hazard = w.stood_hazard;
    }
    if (w.stands) {
      if (drop_m > 0)
        truth.landing_mps = std::max(truth.landing_mps, (w.low_m - low_W.z()) / m->opt.timestep);
      if (is_upright || !w.stood) {
        w.floor_W = w.stand_W;
        w.edges_m = 0;
      }
      w.stood = true;
      w.stood_m = w.stand_W.z();
      w.stood_hazard = w.stand_hazard;
      w.most_room_m = 0;
    }
    w.low_m = low_W.z();
    w.stands = w.touches = false;
  }
}

}  // namespace floorproof

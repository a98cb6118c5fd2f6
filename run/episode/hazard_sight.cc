// SPDX-License-Identifier: Apache-2.0
#include "run/episode/hazard_sight.h"

#include <algorithm>
#include <cmath>

#include "env/core/wall_gap.h"

namespace floorproof {
namespace {

constexpr double kMoved_m = 0.005;  // less is not looked at
// How far from a solid a beam that met it may end: four standard deviations of a scanner of the
// default's class, and a tapered or rounded face.
constexpr double kNear_m = 0.03, kNearShare = 0.02;
constexpr double kPlane_m = 0.005;  // by so much a robot that drives is not level

}  // namespace

HazardSight::HazardSight(const HazardMap& map, const RobotSpec& robot, double control_s)
    : map_(map), robot_(robot), control_s_(control_s), seen_(map.hazards.size()) {
  for (std::size_t i = 0; i < map.hazards.size(); ++i)
    for (const Solid& solid : map.hazards[i].solids)
      if (solid.kind == Solid::Kind::kPrism && !solid.base.empty())
        parts_.push_back({static_cast<int>(i), solid.base, BoxAround(solid.base), solid.z_low_m,
                          solid.z_high_m});
  in_plane_.reserve(parts_.size());
}

bool HazardSight::Sees(std::span<const Reading> readings) {
  return std::ranges::any_of(readings, [](Reading reading) {
    return reading == Reading::kScan || reading == Reading::kBump || reading == Reading::kCliffs;
  });
}

int HazardSight::IndexOf(const std::string& hazard) const {
  const auto at = std::ranges::find(map_.hazards, hazard, &Hazard::id);
  return at == map_.hazards.end() ? -1 : static_cast<int>(at - map_.hazards.begin());
}

void HazardSight::OnControl(const Observation& sensed, const Sample& sample) {
  const Vec2 p_W = sample.p_WB.head<2>();
  if (!last_W_) last_W_ = p_W;
  if (const double way_m = (p_W - *last_W_).norm(); way_m >= kMoved_m) {
    way_m_ += way_m;
    last_W_ = p_W;
  }
  speed_mps_ = sample.v_WB_W.head<2>().norm();
  if (sensed.scan.fresh) SeeScan(sensed.scan, sample);
  if (sensed.cliffs.any()) SeeDrops(sensed.cliffs, sample.X_WB());
}

void HazardSight::SeeScan(const LidarScan& scan, const Sample& sample) {
  const Pose2 X_WL = sample.X_WB() * scan.X_BL;
  const double plane_m = sample.p_WB.z() + scan.height_m;
  in_plane_.clear();
  for (const Part& part : parts_)
    if (plane_m <= part.high_m - kPlane_m && plane_m >= part.low_m) in_plane_.push_back(&part);
  if (in_plane_.empty()) return;
  scan.ForEachEnd([&](const Vec2& p_L) {
    const Vec2 p_W = X_WL * p_L;
    double near_m = kNear_m + kNearShare * p_L.norm();
    const double reach_m = near_m;
    int nearest = -1;
    for (const Part* part : in_plane_) {
      if ((p_W.array() < part->box.low.array() - near_m).any() ||
          (p_W.array() > part->box.high.array() + near_m).any())
        continue;
      const double distance_m = SignedDistance(part->base_W, p_W);
      if (distance_m > near_m) continue;
      near_m = std::max(distance_m, 0.0);
      nearest = part->hazard;
    }
    if (nearest >= 0 && !IsAtWall(p_W, reach_m)) See(nearest);
  });
}

void HazardSight::SeeDrops(const CliffRing& cliffs, const Pose2& X_WB) {
  for (int i = 0; i < cliffs.n; ++i) {
    if (!cliffs.drop[static_cast<std::size_t>(i)]) continue;
    const Vec2 p_W = X_WB * cliffs.p_B[static_cast<std::size_t>(i)];
    for (std::size_t h = 0; h < map_.hazards.size(); ++h)
      for (const Polygon& polygon : map_.hazards[h].footprint)
        if (Contains(polygon, p_W)) See(static_cast<int>(h));
  }
}

bool HazardSight::IsAtWall(const Vec2& p_W, double reach_m) const {
  return WallGap(map_, {}, {p_W.x(), p_W.y(), 0}, reach_m) < reach_m;
}

void HazardSight::See(int hazard) {
  auto& seen = seen_[static_cast<std::size_t>(hazard)];
  if (seen) return;
  const double braking_m = speed_mps_ * speed_mps_ / (2 * robot_.max_accel_mps2);
  seen = {way_m_, speed_mps_ * control_s_ + braking_m};
}

bool HazardSight::IsUpon(int hazard, const Sample& sample) const {
  if (sample.near_hazard == hazard) return true;
  const Pose2 X_WB = sample.X_WB();
  const auto& footprint = map_.hazards[static_cast<std::size_t>(hazard)].footprint;
  return std::ranges::any_of(robot_.wheels, [&](const WheelSpec& wheel) {
    const Vec2 p_W = X_WB * Vec2(wheel.p_BW.head<2>());
    return std::ranges::any_of(footprint,
                               [&](const Polygon& polygon) { return Contains(polygon, p_W); });
  });
}

bool HazardSight::InTime(int hazard) const {
  const auto& seen = seen_[static_cast<std::size_t>(hazard)];
  return seen && way_m_ - seen->way_m >= seen->stop_m;
}

}  // namespace floorproof

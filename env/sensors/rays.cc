// SPDX-License-Identifier: Apache-2.0
#include "env/sensors/rays.h"

#include <algorithm>
#include <cmath>

#include "env/scene/walls.h"

namespace floorproof {
namespace {

constexpr mjtByte kMet[mjNGROUP] = {0, 0, 0, 0, 1, 1};
static_assert(mjNGROUP == 6 && kSolidGroup == 4 && kGlassGroup == 5);

}  // namespace

Rays::Rays(const Scene& scene) : scene_(scene) {}

RayHit Rays::Cast(const mjData* data, const Vec3& p_W, const Vec3& direction_W,
                  double most_m) const {
  RayHit hit = Wall(p_W, direction_W, most_m);
  int geom = -1;
  mjtNum normal[3] = {0, 0, 0};
  const double range_m =
      mj_ray(scene_.model.get(), data, p_W.data(), direction_W.data(), kMet, 1, -1, &geom, normal);
  if (geom >= 0 && range_m >= 0 && range_m <= most_m && range_m < hit.range_m)
    hit = {range_m, geom, Vec3(normal)};
  return hit;
}

void Rays::CastAll(mjData* data, const Vec3& p_W, const std::vector<double>& directions_W,
                   double most_m, std::vector<RayHit>& hits) {
  const std::size_t n = hits.size();
  geom_.resize(n);
  range_.resize(n);
  normal_.resize(3 * n);
  mj_multiRay(scene_.model.get(), data, p_W.data(), directions_W.data(), kMet, 1, -1, geom_.data(),
              range_.data(), normal_.data(), static_cast<int>(n), most_m);
  for (std::size_t i = 0; i < n; ++i) {
    hits[i] = Wall(p_W, Vec3(&directions_W[3 * i]), most_m);
    if (geom_[i] >= 0 && range_[i] >= 0 && range_[i] <= most_m && range_[i] < hits[i].range_m)
      hits[i] = {range_[i], geom_[i], Vec3(&normal_[3 * i])};
  }
}

// A wall that only the map holds: upright, from the base floor to kWallHeight_m.
RayHit Rays::Wall(const Vec3& p_W, const Vec3& direction_W, double most_m) const {
  const WallPool& pool = scene_.pool;
  const double flat = direction_W.head<2>().norm();
  if (pool.num == 0 || flat < 1e-9) return {};
  const Pose2 X_GW = pool.X_WG.Inverse();
  const double flat_m =
      pool.grid.Cast(X_GW * Vec2(p_W.head<2>()), X_GW.Rotate(direction_W.head<2>() / flat), most_m);
  const double range_m = flat_m / flat;
  const double z_m = p_W.z() + range_m * direction_W.z();
  if (!(range_m <= most_m) || z_m < 0 || z_m > kWallHeight_m) return {};
  return {range_m, -1, Vec3::Zero()};
}

}  // namespace floorproof

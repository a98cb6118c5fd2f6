// SPDX-License-Identifier: Apache-2.0
#include "render/floor_paint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

// Its axes: along `ahead`, seen from above, and the plane's normal.
void SetAxes(const Vec2& ahead, const Vec3& normal, mjvGeom& geom) {
  const Vec3 along =
      Vec3(ahead.x(), ahead.y(), -normal.head<2>().dot(ahead) / normal.z()).normalized();
  const Vec3 across = normal.cross(along);
  for (int i = 0; i < 3; ++i) {
    geom.mat[3 * i] = static_cast<float>(along[i]);
    geom.mat[3 * i + 1] = static_cast<float>(across[i]);
    geom.mat[3 * i + 2] = static_cast<float>(normal[i]);
  }
}

// A flat mark on the floor, `half_m` from its middle to its border.
mjvGeom Mark(mjtGeom type, const Vec2& p_W, const Lie& lie, double half_m,
             const std::array<float, 4>& rgba) {
  constexpr double kHalfThick_m = 0.0005;
  const bool disc = type == mjGEOM_CYLINDER;
  const mjtNum size[3] = {half_m, disc ? kHalfThick_m : half_m, kHalfThick_m};
  const mjtNum pos[3] = {p_W.x(), p_W.y(), lie.z_m - kHalfThick_m};
  mjvGeom geom;
  mjv_initGeom(&geom, type, size, pos, nullptr, rgba.data());
  SetAxes(Vec2::UnitX(), Vec3(-lie.gradient.x(), -lie.gradient.y(), 1).normalized(), geom);
  geom.category = mjCAT_DECOR;
  geom.specular = 0;
  geom.modelrbound = static_cast<float>(half_m);
  return geom;
}

}  // namespace

std::size_t FloorPaint::Place(const mjvGeom& geom) {
  if (static_cast<int>(geoms_.size()) < max_marks_) {
    geoms_.push_back(geom);
    return geoms_.size() - 1;
  }
  const std::size_t slot = next_;
  geoms_[slot] = geom;
  next_ = slot + 1 < geoms_.size() ? slot + 1 : kept_;
  return slot;
}

// MuJoCo adds the sun's light to everything that is not hidden. If two marks were at exactly the
// same height, their overlap would shine twice. Neighbours therefore lie microns apart.
double FloorPaint::Layer(double z_m) {
  constexpr int kLayers = 50;
  constexpr double kApart_m = 20e-6;
  layer_ = (layer_ + 1) % kLayers;
  return z_m - kApart_m * layer_;
}

std::size_t FloorPaint::AddStripe(const Vec2& a_W, const Vec2& b_W, const Lie& lie, double width_m,
                                  const std::array<float, 4>& rgba) {
  const Lie layer(Layer(lie.z_m), lie.gradient);
  const std::size_t slot = Place(Mark(mjGEOM_BOX, a_W, layer, 0.5 * width_m, rgba));
  MoveStripe(slot, a_W, b_W);
  return slot;
}

void FloorPaint::AddDisc(const Vec2& p_W, const Lie& lie, double radius_m,
                         const std::array<float, 4>& rgba) {
  Place(Mark(mjGEOM_CYLINDER, p_W, {Layer(lie.z_m), lie.gradient}, radius_m, rgba));
}

void FloorPaint::MoveStripe(std::size_t stripe, const Vec2& a_W, const Vec2& b_W) {
  mjvGeom& geom = geoms_[stripe];
  const Vec2 d = b_W - a_W, m = 0.5 * (a_W + b_W);
  const double length = d.norm();
  const Vec2 u = length > 0 ? Vec2(d / length) : Vec2::UnitX();
  const Vec3 normal(geom.mat[2], geom.mat[5], geom.mat[8]);
  const Vec2 rise = -normal.head<2>() / normal.z();
  geom.pos[2] += static_cast<float>(rise.dot(m - Vec2(geom.pos[0], geom.pos[1])));
  geom.pos[0] = static_cast<float>(m.x());
  geom.pos[1] = static_cast<float>(m.y());
  SetAxes(u, normal, geom);
  geom.size[0] = static_cast<float>(0.5 * length * std::hypot(1, rise.dot(u)));
  geom.modelrbound = std::hypot(geom.size[0], geom.size[1]);
}

}  // namespace floorproof

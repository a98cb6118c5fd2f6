// SPDX-License-Identifier: Apache-2.0
// Marks on the floor of a picture.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <cstddef>
#include <vector>

#include "env/geometry/geometry.h"

namespace floorproof {

// The plane that a mark lies in: the height of its first point or middle, and its rise per metre
// along the world's x and y.
struct Lie {
  Lie(double height_m) : z_m(height_m) {}  // NOLINT: a level floor is a height
  Lie(double height_m, const Vec2& rise) : z_m(height_m), gradient(rise) {}
  double z_m;
  Vec2 gradient = Vec2::Zero();
};

// Stripes and discs painted on the floor: a planned path, a driven trace. They cast no shadow.
class FloorPaint {
 public:
  explicit FloorPaint(int max_marks = 4000) : max_marks_(max_marks) {}
  // A flat stripe from a to b, width_m wide, with its top in this plane or up to 1 mm below; with
  // alpha below 1 the floor shows through. Returns its number. Beyond max_marks the oldest marks
  // are dropped, except those that are kept.
  std::size_t AddStripe(const Vec2& a_W, const Vec2& b_W, const Lie& lie, double width_m,
                        const std::array<float, 4>& rgba);
  void MoveStripe(std::size_t stripe, const Vec2& a_W, const Vec2& b_W);  // within its plane
  void AddDisc(const Vec2& p_W, const Lie& lie, double radius_m, const std::array<float, 4>& rgba);
  // Everything painted so far is kept for good.
  void Keep() { kept_ = next_ = geoms_.size(); }
  const std::vector<mjvGeom>& geoms() const { return geoms_; }
  int max_marks() const { return max_marks_; }

 private:
  std::size_t Place(const mjvGeom& geom);
  double Layer(double z_m);

  int max_marks_;
  int layer_ = 0;
  std::size_t kept_ = 0, next_ = 0;
  std::vector<mjvGeom> geoms_;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Boxes that are found by place: a grid of buckets, each of which lists the boxes that reach into
// it. All are given in one frame, in metres.
#pragma once

#include <cstddef>
#include <vector>

#include "env/geometry/box.h"

namespace floorproof {

class BoxGrid {
 public:
  BoxGrid() = default;
  // Takes time and memory as the boxes' number and the buckets that they cover.
  explicit BoxGrid(std::vector<Box2> boxes);

  const std::vector<Box2>& boxes() const { return boxes_; }
  // Indices of all boxes that meet the rectangle [low, high] (borders count), ascending,
  // each once. Allocates only what `found` lacks.
  void Near(const Vec2& low, const Vec2& high, std::vector<int>& found) const;
  // At least as many as Near() finds in any square of this half side (m), wherever it stands.
  int MostNear(double half_side_m) const;
  // Distance (m) along the ray to the first face of a box, measured like mj_ray: from within a box,
  // the distance to where the ray leaves it. `direction` has length 1. Infinity when nothing is
  // met within `most_m`. Takes time proportional to the ray's length, not to the map's size.
  double Cast(const Vec2& from, const Vec2& direction, double most_m) const;

 private:
  struct Range {
    int x0, y0, x1, y1;  // both ends included
  };
  Range Buckets(const Vec2& low, const Vec2& high) const;
  std::size_t Bucket(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(ix);
  }

  std::vector<Box2> boxes_;
  std::vector<Range> ranges_;  // of the buckets that each box covers
  Vec2 low_ = Vec2::Zero();
  double bucket_m_ = 1;
  int width_ = 0, height_ = 0;
  std::vector<int> first_, listed_;  // boxes of bucket b: listed_[first_[b]] to [first_[b + 1] - 1]
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/map/wall_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace floorproof {
namespace {

constexpr double kBucket_m = 0.5;
constexpr double kMaxBuckets = 1e6;
constexpr double kHair_m = 1e-9;  // boxes on a border of buckets are listed on both sides
constexpr double kNone = std::numeric_limits<double>::infinity();

// Where the line from + t * direction lies within [low, high] of one axis.
struct Span {
  double in = -kNone, out = kNone;
};
Span Within(double from, double direction, double low, double high) {
  if (direction == 0) return from < low || from > high ? Span{kNone, -kNone} : Span{};
  const double a = (low - from) / direction, b = (high - from) / direction;
  return {std::min(a, b), std::max(a, b)};
}
Span Within(const Vec2& from, const Vec2& direction, const Vec2& low, const Vec2& high) {
  const Span x = Within(from.x(), direction.x(), low.x(), high.x());
  const Span y = Within(from.y(), direction.y(), low.y(), high.y());
  return {std::max(x.in, y.in), std::min(x.out, y.out)};
}

}  // namespace

WallGrid::WallGrid(std::vector<WallBox> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) return;
  Vec2 high = boxes_.front().high_G;
  low_G_ = boxes_.front().low_G;
  for (const WallBox& box : boxes_) {
    low_G_ = low_G_.cwiseMin(box.low_G);
    high = high.cwiseMax(box.high_G);
  }
  const Vec2 size = high - low_G_;
  bucket_m_ =
      std::max({kBucket_m, std::sqrt(size.prod() / kMaxBuckets), size.maxCoeff() / kMaxBuckets});
  width_ = static_cast<int>(size.x() / bucket_m_) + 1;
  height_ = static_cast<int>(size.y() / bucket_m_) + 1;

  // Count, add up, fill: one flat list.
  first_.assign(Bucket(0, height_) + 1, 0);
  const auto for_each = [this](const Range& r, auto&& call) {
    for (int iy = r.y0; iy <= r.y1; ++iy)
      for (int ix = r.x0; ix <= r.x1; ++ix) call(Bucket(ix, iy));
  };
  for (const WallBox& box : boxes_) {
    const Vec2 hair(kHair_m, kHair_m);
    ranges_.push_back(Buckets(box.low_G - hair, box.high_G + hair));
    for_each(ranges_.back(), [this](std::size_t b) { ++first_[b + 1]; });
  }
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  listed_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    for_each(ranges_[i], [&](std::size_t b) {
      listed_[static_cast<std::size_t>(next[b]++)] = static_cast<int>(i);
    });
}

WallGrid::Range WallGrid::Buckets(const Vec2& low_G, const Vec2& high_G) const {
  const auto index = [this](double along_m, int n) {
    return static_cast<int>(std::clamp(along_m / bucket_m_, 0.0, n - 1.0));
  };
  const Vec2 low = low_G - low_G_, high = high_G - low_G_;
  return {index(low.x(), width_), index(low.y(), height_), index(high.x(), width_),
          index(high.y(), height_)};
}

void WallGrid::Near(const Vec2& low_G, const Vec2& high_G, std::vector<int>& found) const {
  found.clear();
  if (boxes_.empty()) return;
  const Range r = Buckets(low_G, high_G);
  for (int iy = r.y0; iy <= r.y1; ++iy)
    for (int ix = r.x0; ix <= r.x1; ++ix) {
      const std::size_t b = Bucket(ix, iy);
      for (int k = first_[b]; k < first_[b + 1]; ++k) {
        const int i = listed_[static_cast<std::size_t>(k)];
        // A box is reported by the first bucket that it shares with the rectangle.
        const Range& own = ranges_[static_cast<std::size_t>(i)];
        if (ix != std::max(own.x0, r.x0) || iy != std::max(own.y0, r.y0)) continue;
        const WallBox& box = boxes_[static_cast<std::size_t>(i)];
        if ((box.low_G.array() <= high_G.array()).all() &&
            (box.high_G.array() >= low_G.array()).all())
          found.push_back(i);
      }
    }
  std::ranges::sort(found);
}

int WallGrid::MostNear(double half_side_m) const {
  // A square whose centre lies in a bucket lies within that bucket widened by half a side. A square
  // whose centre lies beyond the grid meets no more than the same square moved to the border.
  std::size_t most = 0;
  std::vector<int> found;
  const Vec2 half(half_side_m, half_side_m), side(bucket_m_, bucket_m_);
  for (int iy = 0; iy < height_; ++iy)
    for (int ix = 0; ix < width_; ++ix) {
      const Vec2 corner = low_G_ + bucket_m_ * Vec2(ix, iy);
      Near(corner - half, corner + side + half, found);
      most = std::max(most, found.size());
    }
  return static_cast<int>(most);
}

double WallGrid::Cast(const Vec2& from_G, const Vec2& direction_G, double most_m) const {
  if (boxes_.empty()) return kNone;
  const Vec2 size = bucket_m_ * Vec2(width_, height_);
  const Span whole = Within(from_G, direction_G, low_G_, low_G_ + size);
  const double begin = std::max(whole.in, 0.0), end = std::min(whole.out, most_m);
  if (!(begin <= end)) return kNone;

  // From bucket to bucket (Amanatides and Woo, 1987): `next` is where the ray leaves the bucket's
  // column or row.
  const Vec2 entry = from_G + begin * direction_G;
  const Range at = Buckets(entry, entry);
  int cell[2] = {at.x0, at.y0}, step[2];
  const int count[2] = {width_, height_};
  double next[2], stride[2];
  for (int k = 0; k < 2; ++k) {
    const double d = direction_G[k];
    step[k] = d > 0 ? 1 : -1;
    stride[k] = d == 0 ? kNone : bucket_m_ / std::abs(d);
    const double border = low_G_[k] + bucket_m_ * (cell[k] + (d > 0 ? 1 : 0));
    next[k] = d == 0 ? kNone : (border - from_G[k]) / d;
  }
  double best = kNone;
  for (;;) {
    const std::size_t b = Bucket(cell[0], cell[1]);
    for (int i = first_[b]; i < first_[b + 1]; ++i) {
      const WallBox& box = boxes_[static_cast<std::size_t>(listed_[static_cast<std::size_t>(i)])];
      const Span span = Within(from_G, direction_G, box.low_G, box.high_G);
      if (span.in > span.out || span.out < 0) continue;
      best = std::min(best, span.in >= 0 ? span.in : span.out);
    }
    const int k = next[0] < next[1] ? 0 : 1;
    if (next[k] >= std::min(best, end)) return best <= most_m ? best : kNone;
    cell[k] += step[k];
    if (cell[k] < 0 || cell[k] >= count[k]) return best <= most_m ? best : kNone;
    next[k] += stride[k];
  }
}

}  // namespace floorproof

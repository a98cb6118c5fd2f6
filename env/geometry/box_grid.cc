// SPDX-License-Identifier: Apache-2.0
#include "env/geometry/box_grid.h"

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

BoxGrid::BoxGrid(std::vector<Box2> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) return;
  Vec2 high = boxes_.front().high;
  low_ = boxes_.front().low;
  for (const Box2& box : boxes_) {
    low_ = low_.cwiseMin(box.low);
    high = high.cwiseMax(box.high);
  }
  const Vec2 size = high - low_;
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
  for (const Box2& box : boxes_) {
    const Vec2 hair(kHair_m, kHair_m);
    ranges_.push_back(Buckets(box.low - hair, box.high + hair));
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

BoxGrid::Range BoxGrid::Buckets(const Vec2& low, const Vec2& high) const {
  const auto index = [this](double along_m, int n) {
    return static_cast<int>(std::clamp(along_m / bucket_m_, 0.0, n - 1.0));
  };
  const Vec2 from = low - low_, to = high - low_;
  return {index(from.x(), width_), index(from.y(), height_), index(to.x(), width_),
          index(to.y(), height_)};
}

void BoxGrid::Near(const Vec2& low, const Vec2& high, std::vector<int>& found) const {
  found.clear();
  if (boxes_.empty()) return;
  const Range r = Buckets(low, high);
  for (int iy = r.y0; iy <= r.y1; ++iy)
    for (int ix = r.x0; ix <= r.x1; ++ix) {
      const std::size_t b = Bucket(ix, iy);
      for (int k = first_[b]; k < first_[b + 1]; ++k) {
        const int i = listed_[static_cast<std::size_t>(k)];
        // A box is reported by the first bucket that it shares with the rectangle.
        const Range& own = ranges_[static_cast<std::size_t>(i)];
        if (ix != std::max(own.x0, r.x0) || iy != std::max(own.y0, r.y0)) continue;
        const Box2& box = boxes_[static_cast<std::size_t>(i)];
        if ((box.low.array() <= high.array()).all() && (box.high.array() >= low.array()).all())
          found.push_back(i);
      }
    }
  std::ranges::sort(found);
}

int BoxGrid::MostNear(double half_side_m) const {
  // A square whose centre lies in a bucket lies within that bucket widened by half a side. A square
  // whose centre lies beyond the grid meets no more than the same square moved to the border.
  std::size_t most = 0;
  std::vector<int> found;
  const Vec2 half(half_side_m, half_side_m), side(bucket_m_, bucket_m_);
  for (int iy = 0; iy < height_; ++iy)
    for (int ix = 0; ix < width_; ++ix) {
      const Vec2 corner = low_ + bucket_m_ * Vec2(ix, iy);
      Near(corner - half, corner + side + half, found);
      most = std::max(most, found.size());
    }
  return static_cast<int>(most);
}

double BoxGrid::Cast(const Vec2& from, const Vec2& direction, double most_m) const {
  if (boxes_.empty()) return kNone;
  const Vec2 size = bucket_m_ * Vec2(width_, height_);
  const Span whole = Within(from, direction, low_, low_ + size);
  const double begin = std::max(whole.in, 0.0), end = std::min(whole.out, most_m);
  if (!(begin <= end)) return kNone;

  // From bucket to bucket (Amanatides and Woo, 1987): `next` is where the ray leaves the bucket's
  // column or row.
  const Vec2 entry = from + begin * direction;
  const Range at = Buckets(entry, entry);
  int cell[2] = {at.x0, at.y0}, step[2];
  const int count[2] = {width_, height_};
  double next[2], stride[2];
  for (int k = 0; k < 2; ++k) {
    const double d = direction[k];
    step[k] = d > 0 ? 1 : -1;
    stride[k] = d == 0 ? kNone : bucket_m_ / std::abs(d);
    const double border = low_[k] + bucket_m_ * (cell[k] + (d > 0 ? 1 : 0));
    next[k] = d == 0 ? kNone : (border - from[k]) / d;
  }
  double best = kNone;
  for (;;) {
    const std::size_t b = Bucket(cell[0], cell[1]);
    for (int i = first_[b]; i < first_[b + 1]; ++i) {
      const Box2& box = boxes_[static_cast<std::size_t>(listed_[static_cast<std::size_t>(i)])];
      const Span span = Within(from, direction, box.low, box.high);
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

// SPDX-License-Identifier: Apache-2.0
// A 1-tree is a spanning tree of all vertices but one, and two edges to that one. Every tour is a
// 1-tree, so none is shorter than the least of them (Held & Karp, "The Traveling-Salesman Problem
// and Minimum Spanning Trees", Operations Research 18, 1970). A weight pi_v, added to all edges at
// v, makes any tour longer by 2 pi_v, so for any weights
//   bound = least 1-tree with weights - 2 sum pi.
// Weights are raised where the tree has more than two edges and lowered where it has one:
// subgradient ascent (part II, Mathematical Programming 1, 1971), with steps t = lambda (known -
// bound) / |g|^2 (Held, Wolfe & Crowder, "Validation of subgradient optimization", Mathematical
// Programming 6, 1974) along g = 0.7 (degree - 2) + 0.3 of the one before.
//
// The way is closed by one more vertex between its end and the start, whose edge to the start is
// in every 1-tree. The other one costs nothing where the way is open, else the way back.
// Proven: lengths are rounded down to whole units, weights are whole, all sums are exact. What
// comes out is lowered by 1e-12 of itself for the rounding of sums of lengths. Not done: a way of
// that length. The bound stays some 0.7 % below the shortest way.
#include "planners/orders/one_tree_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floorproof {
namespace {

constexpr int kBits = 28;  // of the greatest length and weight: three of them fit in 31
constexpr double kFirstLambda = 1, kLeastLambda = 1e-3, kShrink = 0.7;
constexpr double kNoLength_m = 1e-200;  // nor scaled any more
constexpr double kMargin = 1e-12;       // n additions of doubles are wrong by less, for n < 9000

class Ascent {
 public:
  Ascent(const PlaceDistances& distances, bool closed)
      : size_(distances.size()),
        units_per_m_(std::exp2(kBits - 1 - std::ilogb(distances.Greatest()))),
        length_(Z(size_) * Z(size_)),
        end_(Z(size_), 0),
        weight_(Z(size_), 0),
        degree_(Z(size_)),
        direction_(Z(size_), 0.0) {
    for (int a = 0; a < size_; ++a)
      for (int b = 0; b < size_; ++b)
        length_[Z(a) * Z(size_) + Z(b)] =
            static_cast<std::int32_t>(std::floor(distances(a, b) * units_per_m_));
    for (int a = 0; closed && a < size_; ++a) end_[Z(a)] = length_[Z(a)];
  }

  double Run(double known_m, int iterations) {
    const double known = known_m * units_per_m_;
    const int patience = std::max(10, size_ / 20);
    double best = -std::numeric_limits<double>::infinity(), lambda = kFirstLambda;
    int since = 0;
    for (int k = 0; k < iterations && lambda > kLeastLambda; ++k) {
      const auto bound = static_cast<double>(LeastOneTree());
      if (++since; bound > best) since = 0, best = bound;
      if (since >= patience) lambda *= kShrink, since = 0;
      if (!Step(lambda * (known - bound))) break;
    }
    return best / units_per_m_ * (1 - kMargin);
  }

 private:
  // Prim's algorithm. Its length with weights, less twice these; leaves the places' degrees.
  std::int64_t LeastOneTree() {
    std::ranges::fill(degree_, 0);
    left_.clear();
    for (int v = 1; v < size_; ++v)
      left_.push_back({std::numeric_limits<std::int32_t>::max(), weight_[Z(v)], v, 0});
    std::int64_t sum = 0;
    for (int at = 0; !left_.empty();) {
      const std::int32_t* length = &length_[Z(at) * Z(size_)];
      const std::int32_t weight = weight_[Z(at)];
      std::size_t nearest = 0;
      std::int32_t least = std::numeric_limits<std::int32_t>::max();
      for (std::size_t k = 0; k < left_.size(); ++k) {
        Left& other = left_[k];
        const std::int32_t key = length[other.place] + weight + other.weight;
        const bool is_nearer = key < other.key;
        other.from = is_nearer ? at : other.from;
        other.key = is_nearer ? key : other.key;
        if (other.key < least) least = other.key, nearest = k;
      }
      const Left next = left_[nearest];
      left_[nearest] = left_.back();
      left_.pop_back();
      sum += next.key;
      ++degree_[Z(next.from)], ++degree_[Z(next.place)];
      at = next.place;
    }
    int end = 1;
    for (int v = 2; v < size_; ++v)
      if (end_[Z(v)] + weight_[Z(v)] < end_[Z(end)] + weight_[Z(end)]) end = v;
    ++degree_[Z(end)], ++degree_[0];
    sum += end_[Z(end)] + weight_[Z(end)] + weight_[0];
    for (const std::int32_t weight : weight_) sum -= 2 * std::int64_t{weight};
    return sum;
  }

  // False: the 1-tree is a tour, or there is nothing to gain.
  bool Step(double scaled_gap) {
    double squares = 0;
    for (int v = 0; v < size_; ++v) {
      direction_[Z(v)] = 0.7 * (degree_[Z(v)] - 2) + 0.3 * direction_[Z(v)];
      squares += (degree_[Z(v)] - 2) * (degree_[Z(v)] - 2);
    }
    if (squares == 0 || scaled_gap <= 0) return false;
    const double most = std::exp2(kBits);
    for (int v = 0; v < size_; ++v)
      weight_[Z(v)] = static_cast<std::int32_t>(std::clamp(
          std::round(weight_[Z(v)] + scaled_gap / squares * direction_[Z(v)]), -most, most));
    return true;
  }

  struct Left {  // a place that is not in the tree yet
    std::int32_t key, weight;
    int place, from;
  };
  int size_;
  double units_per_m_;                // a power of two: scaling rounds nothing
  std::vector<std::int32_t> length_;  // row by row
  std::vector<std::int32_t> end_;     // of the closing vertex' edges
  std::vector<std::int32_t> weight_;  // pi
  std::vector<int> degree_;
  std::vector<double> direction_;
  std::vector<Left> left_;
};

}  // namespace

double OneTreeBound(const PlaceDistances& distances, bool closed, double known_m, int iterations) {
  if (distances.size() < 2 || distances.Greatest() < kNoLength_m) return 0;
  return std::max(0.0, Ascent(distances, closed).Run(known_m, iterations));
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A closed tour as an array with positions, changed by turning parts of it round (flips).
//
// Any exchange of edges is a sequence of flips. A flip turns the part asked for or the rest of the
// tour, whichever is shorter: as closed tours both give the same. In the second case the array is
// read backwards from then on. Flips are kept in a journal and can be undone.
// The tour can be looked at in a mirror: Next and Prev change places, so that a search written for
// one side of a vertex does for the other. Linear in the part turned; no lists of two levels.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "planners/search/index.h"

namespace floorproof {

class ArrayTour {
 public:
  // `order` holds each vertex 0, 1, ... once.
  explicit ArrayTour(std::vector<int> order)
      : n_(static_cast<int>(order.size())), order_(std::move(order)), position_(order_.size()) {
    for (int p = 0; p < n_; ++p) position_[Z(order_[Z(p)])] = p;
  }

  int size() const { return n_; }
  const std::vector<int>& order() const { return order_; }
  std::int64_t work() const { return work_; }  // one a flip and eight vertices turned

  int Next(int v) const { return Neighbour(v, !backwards_); }
  int Prev(int v) const { return Neighbour(v, backwards_); }
  // `count` vertices on, fewer than the tour has; back if it is negative.
  int Ahead(int v, int count) const {
    const int p = position_[Z(v)] + (backwards_ ? -count : count);
    return order_[Z(p >= n_ ? p - n_ : p < 0 ? p + n_ : p)];
  }
  // Vertices from a on to b, both included.
  int Length(int a, int b) const {
    const int d =
        backwards_ ? position_[Z(a)] - position_[Z(b)] : position_[Z(b)] - position_[Z(a)];
    return (d < 0 ? d + n_ : d) + 1;
  }

  void Mirror() {
    mirrored_ = !mirrored_;
    backwards_ = !backwards_;
  }
  bool mirrored() const { return mirrored_; }

  // Turns the part from a on to b round: before a..b after -> before b..a after.
  void Flip(int a, int b) {
    journal_.push_back(mirrored_ ? std::pair{b, a} : std::pair{a, b});
    Turn(a, b);
  }

  std::size_t flips() const { return journal_.size(); }
  void ForgetFlips() { journal_.clear(); }
  void UndoTo(std::size_t flips) {
    const bool mirrored = mirrored_;  // the journal is kept as seen without the mirror
    if (mirrored) Mirror();
    while (journal_.size() > flips) {
      Turn(journal_.back().second, journal_.back().first);
      journal_.pop_back();
    }
    if (mirrored) Mirror();
  }

 private:
  int Neighbour(int v, bool up) const {
    int p = position_[Z(v)] + (up ? 1 : -1);
    if (p == n_) p = 0;
    if (p < 0) p = n_ - 1;
    return order_[Z(p)];
  }
  void Turn(int a, int b) {
    int count = Length(a, b);
    if (2 * count > n_) {
      const int after = Next(b);
      b = Prev(a), a = after, count = n_ - count;
      backwards_ = !backwards_;
      std::swap(a, b);
    }
    int i = position_[Z(backwards_ ? b : a)], j = position_[Z(backwards_ ? a : b)];
    work_ += 1 + count / 8;
    for (int k = count / 2; k > 0; --k) {
      std::swap(order_[Z(i)], order_[Z(j)]);
      position_[Z(order_[Z(i)])] = i;
      position_[Z(order_[Z(j)])] = j;
      if (++i == n_) i = 0;
      if (--j < 0) j = n_ - 1;
    }
  }

  int n_;
  std::vector<int> order_, position_;
  bool backwards_ = false;  // the array is read from its end to its front
  bool mirrored_ = false;
  std::vector<std::pair<int, int>> journal_;
  std::int64_t work_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Links between neighbouring cells, at most two a cell, as many as possible.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planners/lines/index.h"

namespace floorproof {

// A greatest simple 2-matching: cells and links form paths and rings.
class TwoMatching {
 public:
  // `kind`, by cell, row by row, `stride` cells a row with a border of zeros: neighbours of the
  // same kind > 0 may be linked. `most`, by cell: 0, 1 or 2 links.
  TwoMatching(std::vector<std::int32_t> kind, int stride, std::vector<int> most);

  std::int64_t links() const { return links_; }

  // Joins cells that have too few links in pairs, mostly two steps apart: links are taken out and
  // put in by turns until the want has moved from one cell next to the other's.
  void PairEnds();
  // The cells that `at` is linked to or joined with; -1: none.
  std::array<int, 2> LinkedTo(int at) const;

 private:
  static constexpr std::size_t kApart = 4;  // no direction

  int Beside(int at, std::size_t d) const { return at + step_[d]; }
  std::size_t Direction(int from, int to) const;
  bool Linked(int at, std::size_t d) const { return linked_[Z(at)] >> d & 1; }
  bool MayLink(int at, std::size_t d) const {
    return kind_[Z(at)] > 0 && kind_[Z(Beside(at, d))] == kind_[Z(at)];
  }
  void Toggle(int at, std::size_t d);
  void Connect(int a, int b);
  bool Layer();
  bool Augment(int root);
  template <class Visit>
  void ForPartners(int at, bool beside, const Visit& visit) const;
  int Spread(int end);
  void Pair(int end);
  std::vector<std::int32_t> kind_;
  std::array<int, 4> step_;                 // directions; the one back is 2 on
  std::vector<std::uint8_t> linked_;        // by cell: a bit a direction
  std::vector<std::array<int, 2>> joined_;  // by cell; -1: none
  std::vector<int> room_;                   // by cell: for more links
  std::int64_t links_ = 0;

  std::vector<int> black_, level_, queue_;
  std::vector<std::pair<int, std::size_t>> stack_;
  std::vector<std::array<int, 2>> from_;  // by cell that a want has moved to: from where, over what
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A maximum simple 2-matching of a floor's cells.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "planners/search/index.h"

namespace floorproof {

// A set of edges between neighbouring cells in which no cell has more than two, or fewer where that
// is said, and which has as many edges as possible. Its components are paths and cycles.
class TwoMatching {
 public:
  // `kind`, by cell, row by row, `stride` cells a row, with a border of zeros: there may be an edge
  // between neighbours of the same kind > 0. `degree`, by cell: the most edges it may have, 0 to 2.
  TwoMatching(std::vector<std::int32_t> kind, int stride, std::vector<int> degree);

  std::int64_t edges() const { return edges_; }

  // Gives cells that have too few edges more, in pairs: edges are taken out and put in by turns,
  // until one such cell is next to another. Some of the edges put in are jumps, between cells that
  // are two steps apart; they do not count as edges of the matching.
  void PairDeficientCells();
  // The cells at the other ends of its edges and jumps; -1: none.
  std::array<int, 2> Partners(int at) const;

 private:
  static constexpr std::size_t kApart = 4;  // no direction

  int Beside(int at, std::size_t d) const { return at + step_[d]; }
  std::size_t Direction(int from, int to) const;
  bool HasEdge(int at, std::size_t d) const { return has_edge_[Z(at)] >> d & 1; }
  bool MayHaveEdge(int at, std::size_t d) const {
    return kind_[Z(at)] > 0 && kind_[Z(Beside(at, d))] == kind_[Z(at)];
  }
  void Toggle(int at, std::size_t d);
  void Connect(int a, int b);
  bool Layer();
  bool Augment(int root);
  template <class Visit>
  void ForCandidates(int at, bool beside, const Visit& visit) const;
  int Spread(int deficient);
  void Pair(int deficient);
  std::vector<std::int32_t> kind_;
  std::array<int, 4> step_;                // directions; the one back is 2 on
  std::vector<std::uint8_t> has_edge_;     // by cell: a bit a direction
  std::vector<std::array<int, 2>> jumps_;  // by cell: to where; -1: none
  std::vector<int> spare_;                 // by cell: how many more edges it may have
  std::int64_t edges_ = 0;

  std::vector<int> black_, level_, queue_;
  std::vector<std::pair<int, std::size_t>> stack_;
  // By cell that the deficit has moved to: from which cell, and over which one between.
  std::vector<std::array<int, 2>> from_;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Colour the cells like a chessboard: every edge joins a black cell and a white one. So the
// matching is one of a bipartite graph, found by shortest augmenting paths, layer by layer
// (Hopcroft & Karp 1973, here with up to two edges a cell). The first edges are laid along rows, so
// that most of the floor stays straight.
//
// Some cells stay deficient: they have fewer edges than they may. Most of these are of one colour,
// and no edge joins two of one colour. But a deficit can move. A cell u takes an edge to v, v gives
// up its edge to w: now w is deficient, which has u's colour. Or u takes a jump to v two steps
// away, at the price of the cell between, and v gives up its edge to w: now w has the other colour.
// A breadth-first search, by price, moves a deficit to a cell that can be paired with another one.
#include "planners/walk/two_matching.h"

#include <algorithm>

namespace floorproof {

TwoMatching::TwoMatching(std::vector<std::int32_t> kind, int stride, std::vector<int> degree)
    : kind_(std::move(kind)),
      step_{1, stride, -1, -stride},
      has_edge_(kind_.size(), 0),
      jumps_(kind_.size(), {-1, -1}),
      spare_(std::move(degree)),
      level_(kind_.size()) {
  const int count = static_cast<int>(kind_.size());
  for (const std::size_t d : {0u, 1u})
    for (int at = 0; at < count; ++at)
      if (spare_[Z(at)] > 0 && MayHaveEdge(at, d) && spare_[Z(Beside(at, d))] > 0) Toggle(at, d);
  for (int at = 0; at < count; ++at)
    if (kind_[Z(at)] > 0 && (at % stride + at / stride) % 2 == 0) black_.push_back(at);
  while (Layer())
    for (const int at : black_)
      while (spare_[Z(at)] > 0 && level_[Z(at)] == 0 && Augment(at)) {
      }
}

std::size_t TwoMatching::Direction(int from, int to) const {
  for (std::size_t d = 0; d < 4; ++d)
    if (Beside(from, d) == to) return d;
  return kApart;
}

void TwoMatching::Toggle(int at, std::size_t d) {
  const int to = Beside(at, d), change = HasEdge(at, d) ? -1 : 1;
  has_edge_[Z(at)] = static_cast<std::uint8_t>(has_edge_[Z(at)] ^ 1u << d);
  has_edge_[Z(to)] = static_cast<std::uint8_t>(has_edge_[Z(to)] ^ 1u << (d + 2) % 4);
  spare_[Z(at)] -= change;
  spare_[Z(to)] -= change;
  edges_ += change;
}

// The level of a black cell: how many edges an alternating path from a deficient black cell takes
// out on the way there. Whether such a path leads to a deficient white cell.
bool TwoMatching::Layer() {
  std::fill(level_.begin(), level_.end(), -1);
  queue_.clear();
  for (const int at : black_)
    if (spare_[Z(at)] > 0) level_[Z(at)] = 0, queue_.push_back(at);
  int last = -1;
  for (std::size_t k = 0; k < queue_.size(); ++k) {
    const int at = queue_[k];
    if (last >= 0 && level_[Z(at)] > last) break;
    for (std::size_t d = 0; d < 4; ++d) {
      if (HasEdge(at, d) || !MayHaveEdge(at, d)) continue;
      const int white = Beside(at, d);
      if (spare_[Z(white)] > 0) last = level_[Z(at)];
      for (std::size_t e = 0; e < 4; ++e) {
        const int next = Beside(white, e);
        if (!HasEdge(white, e) || level_[Z(next)] >= 0) continue;
        level_[Z(next)] = level_[Z(at)] + 1;
        queue_.push_back(next);
      }
    }
  }
  return last >= 0;
}

// Depth first along the layers. The stack is our own: a path may be as long as the floor has cells.
bool TwoMatching::Augment(int root) {
  stack_.assign(1, {root, 0});
  while (!stack_.empty()) {
    auto& [at, turn] = stack_.back();  // turn: the pairs of directions to try, one by one
    if (turn == 16) {
      level_[Z(at)] = -1;
      stack_.pop_back();
      continue;
    }
    const std::size_t d = turn / 4, e = turn % 4;
    if (HasEdge(at, d) || !MayHaveEdge(at, d)) {
      turn += 4 - e;
      continue;
    }
    const int white = Beside(at, d);
    if (spare_[Z(white)] > 0) {
      Toggle(at, d);
      stack_.pop_back();
      for (const auto& [from, behind] : stack_) {
        Toggle(from, (behind - 1) / 4);
        Toggle(Beside(from, (behind - 1) / 4), (behind - 1) % 4);
      }
      return true;
    }
    ++turn;
    const int next = Beside(white, e);
    if (HasEdge(white, e) && level_[Z(next)] == level_[Z(at)] + 1) stack_.push_back({next, 0});
  }
  return false;
}

std::array<int, 2> TwoMatching::Partners(int at) const {
  std::array<int, 2> cells = {-1, -1};
  std::size_t count = 0;
  for (std::size_t d = 0; d < 4; ++d)
    if (HasEdge(at, d)) cells[count++] = Beside(at, d);
  for (const int to : jumps_[Z(at)])
    if (to >= 0) cells[count++] = to;
  return cells;
}

void TwoMatching::PairDeficientCells() {
  from_.assign(kind_.size(), {-1, -1});
  std::vector<int> deficient;
  for (int at = 0; at < static_cast<int>(kind_.size()); ++at)
    for (int k = 0; k < spare_[Z(at)]; ++k) deficient.push_back(at);
  for (const int at : deficient)
    if (spare_[Z(at)] > 0) Pair(at);
}

// An edge between neighbours, else a jump.
void TwoMatching::Connect(int a, int b) {
  const std::size_t d = Direction(a, b);
  if (d != kApart) {
    Toggle(a, d);
    return;
  }
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    jumps_[Z(from)][jumps_[Z(from)][0] < 0 ? 0 : 1] = to;
    --spare_[Z(from)];
  }
}

// Calls visit for the cells that `at` may take an edge to (beside), or a jump.
template <class Visit>
void TwoMatching::ForCandidates(int at, bool beside, const Visit& visit) const {
  for (std::size_t d = 0; d < 4; ++d) {
    if (!MayHaveEdge(at, d)) continue;
    const int next = Beside(at, d);
    if (beside) {
      if (!HasEdge(at, d)) visit(next);
      continue;
    }
    for (std::size_t e = 0; e < 4; ++e) {
      const int to = Beside(next, e);
      if (to != at && MayHaveEdge(next, e) && jumps_[Z(at)][0] != to && jumps_[Z(at)][1] != to)
        visit(to);
    }
  }
}

// Moves the deficit of a cell over the floor; from_ keeps how. The cell from which it can be paired
// with another one; -1: none.
int TwoMatching::Spread(int deficient) {
  queue_.assign(1, deficient);
  from_[Z(deficient)] = {deficient, deficient};
  std::size_t done = 0;
  while (done < queue_.size()) {
    // All cells that the deficit reaches at one price. Edges cost nothing, so they come first.
    const std::size_t first = done;
    int found = -1;
    const auto move = [&](int at, int via) {
      if (spare_[Z(via)] > 0) {
        found = at;
        return;
      }
      for (std::size_t e = 0; e < 4; ++e) {
        const int next = Beside(via, e);
        if (!HasEdge(via, e) || from_[Z(next)][0] >= 0) continue;
        from_[Z(next)] = {at, via};
        queue_.push_back(next);
      }
    };
    for (; done < queue_.size(); ++done) {
      const int at = queue_[done];
      ForCandidates(at, true, [&](int via) { move(at, via); });
      if (found >= 0) return found;
    }
    const std::size_t last = done;
    for (std::size_t k = first; k < last; ++k) {
      const int at = queue_[k];
      ForCandidates(at, false, [&](int via) { move(at, via); });
      if (found >= 0) return found;
    }
  }
  return -1;
}

void TwoMatching::Pair(int deficient) {
  --spare_[Z(deficient)];  // not to be paired with itself
  const int last = Spread(deficient);
  ++spare_[Z(deficient)];
  if (last >= 0) {
    std::vector<std::array<int, 2>> moves;  // over what, to where; last first
    for (int to = last; to != deficient; to = from_[Z(to)][0])
      moves.push_back({from_[Z(to)][1], to});
    int at = deficient;
    bool whole = true;
    for (auto it = moves.rbegin(); it != moves.rend() && whole; ++it) {
      const auto [via, to] = *it;
      const std::size_t in = Direction(at, via), out = Direction(via, to);
      // An earlier move may have taken what this one counts on.
      whole = !(in != kApart && HasEdge(at, in)) && HasEdge(via, out);
      if (!whole) break;
      Toggle(via, out);
      Connect(at, via);
      at = to;
    }
    if (whole) {
      int partner = -1;
      for (const bool beside : {true, false})
        ForCandidates(at, beside, [&](int via) {
          if (partner < 0 && via != at && spare_[Z(via)] > 0) partner = via;
        });
      if (partner >= 0) Connect(at, partner);
    }
  }
  for (const int cell : queue_) from_[Z(cell)] = {-1, -1};
}

}  // namespace floorproof

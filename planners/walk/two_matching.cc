// SPDX-License-Identifier: Apache-2.0
// Cells are coloured like a chess board, so a greatest matching is one of a bipartite graph:
// shortest augmenting chains, layer by layer (Hopcroft & Karp 1973, with up to two links a cell).
// Rows are linked first, so that most of the floor stays straight. What is left are cells that want
// a link, most of them of one colour. A want moves from u to w when u takes a link to v and v gives
// up its link to w: w has u's colour. Or u is joined with v two steps away, at the price of the
// cell between, and w has the other colour. A search by price, breadth first, takes it to where
// another want can be met.
#include "planners/walk/two_matching.h"

#include <algorithm>

namespace floorproof {

TwoMatching::TwoMatching(std::vector<std::int32_t> kind, int stride, std::vector<int> most)
    : kind_(std::move(kind)),
      step_{1, stride, -1, -stride},
      linked_(kind_.size(), 0),
      joined_(kind_.size(), {-1, -1}),
      room_(std::move(most)),
      level_(kind_.size()) {
  const int count = static_cast<int>(kind_.size());
  for (const std::size_t d : {0u, 1u})
    for (int at = 0; at < count; ++at)
      if (room_[Z(at)] > 0 && MayLink(at, d) && room_[Z(Beside(at, d))] > 0) Toggle(at, d);
  for (int at = 0; at < count; ++at)
    if (kind_[Z(at)] > 0 && (at % stride + at / stride) % 2 == 0) black_.push_back(at);
  while (Layer())
    for (const int at : black_)
      while (room_[Z(at)] > 0 && level_[Z(at)] == 0 && Augment(at)) {
      }
}

std::size_t TwoMatching::Direction(int from, int to) const {
  for (std::size_t d = 0; d < 4; ++d)
    if (Beside(from, d) == to) return d;
  return kApart;
}

void TwoMatching::Toggle(int at, std::size_t d) {
  const int to = Beside(at, d), change = Linked(at, d) ? -1 : 1;
  linked_[Z(at)] = static_cast<std::uint8_t>(linked_[Z(at)] ^ 1u << d);
  linked_[Z(to)] = static_cast<std::uint8_t>(linked_[Z(to)] ^ 1u << (d + 2) % 4);
  room_[Z(at)] -= change;
  room_[Z(to)] -= change;
  links_ += change;
}

// Levels: of black cells, the links to be taken out on the way there from a black cell with room.
// Whether such a way leads to a white cell with room.
bool TwoMatching::Layer() {
  std::fill(level_.begin(), level_.end(), -1);
  queue_.clear();
  for (const int at : black_)
    if (room_[Z(at)] > 0) level_[Z(at)] = 0, queue_.push_back(at);
  int last = -1;
  for (std::size_t k = 0; k < queue_.size(); ++k) {
    const int at = queue_[k];
    if (last >= 0 && level_[Z(at)] > last) break;
    for (std::size_t d = 0; d < 4; ++d) {
      if (Linked(at, d) || !MayLink(at, d)) continue;
      const int white = Beside(at, d);
      if (room_[Z(white)] > 0) last = level_[Z(at)];
      for (std::size_t e = 0; e < 4; ++e) {
        const int next = Beside(white, e);
        if (!Linked(white, e) || level_[Z(next)] >= 0) continue;
        level_[Z(next)] = level_[Z(at)] + 1;
        queue_.push_back(next);
      }
    }
  }
  return last >= 0;
}

// Depth first along the layers, with a stack of our own: chains may be as long as the floor is.
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
    if (Linked(at, d) || !MayLink(at, d)) {
      turn += 4 - e;
      continue;
    }
    const int white = Beside(at, d);
    if (room_[Z(white)] > 0) {
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
    if (Linked(white, e) && level_[Z(next)] == level_[Z(at)] + 1) stack_.push_back({next, 0});
  }
  return false;
}

std::array<int, 2> TwoMatching::LinkedTo(int at) const {
  std::array<int, 2> cells = {-1, -1};
  std::size_t count = 0;
  for (std::size_t d = 0; d < 4; ++d)
    if (Linked(at, d)) cells[count++] = Beside(at, d);
  for (const int to : joined_[Z(at)])
    if (to >= 0) cells[count++] = to;
  return cells;
}

void TwoMatching::PairEnds() {
  from_.assign(kind_.size(), {-1, -1});
  std::vector<int> ends;
  for (int at = 0; at < static_cast<int>(kind_.size()); ++at)
    for (int k = 0; k < room_[Z(at)]; ++k) ends.push_back(at);
  for (const int end : ends)
    if (room_[Z(end)] > 0) Pair(end);
}

// Links or joins two cells that have room.
void TwoMatching::Connect(int a, int b) {
  const std::size_t d = Direction(a, b);
  if (d != kApart) {
    Toggle(a, d);
    return;
  }
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    joined_[Z(from)][joined_[Z(from)][0] < 0 ? 0 : 1] = to;
    --room_[Z(from)];
  }
}

// Calls visit for the cells that `at` may be linked to (beside), or joined with.
template <class Visit>
void TwoMatching::ForPartners(int at, bool beside, const Visit& visit) const {
  for (std::size_t d = 0; d < 4; ++d) {
    if (!MayLink(at, d)) continue;
    const int next = Beside(at, d);
    if (beside) {
      if (!Linked(at, d)) visit(next);
      continue;
    }
    for (std::size_t e = 0; e < 4; ++e) {
      const int to = Beside(next, e);
      if (to != at && MayLink(next, e) && joined_[Z(at)][0] != to && joined_[Z(at)][1] != to)
        visit(to);
    }
  }
}

// Moves the want of `end` about; from_ keeps how. The cell that it can be met from; -1: none.
int TwoMatching::Spread(int end) {
  queue_.assign(1, end);
  from_[Z(end)] = {end, end};
  std::size_t done = 0;
  while (done < queue_.size()) {
    // All cells of one price, found one from the other.
    const std::size_t first = done;
    int met = -1;
    const auto move = [&](int at, int via) {
      if (room_[Z(via)] > 0) {
        met = at;
        return;
      }
      for (std::size_t e = 0; e < 4; ++e) {
        const int next = Beside(via, e);
        if (!Linked(via, e) || from_[Z(next)][0] >= 0) continue;
        from_[Z(next)] = {at, via};
        queue_.push_back(next);
      }
    };
    for (; done < queue_.size(); ++done) {
      const int at = queue_[done];
      ForPartners(at, true, [&](int via) { move(at, via); });
      if (met >= 0) return met;
    }
    const std::size_t last = done;
    for (std::size_t k = first; k < last; ++k) {
      const int at = queue_[k];
      ForPartners(at, false, [&](int via) { move(at, via); });
      if (met >= 0) return met;
    }
  }
  return -1;
}

void TwoMatching::Pair(int end) {
  --room_[Z(end)];  // not to be met by itself
  const int met = Spread(end);
  ++room_[Z(end)];
  if (met >= 0) {
    std::vector<std::array<int, 2>> moves;  // over what, to where; last first
    for (int to = met; to != end; to = from_[Z(to)][0]) moves.push_back({from_[Z(to)][1], to});
    int at = end;
    bool whole = true;
    for (auto it = moves.rbegin(); it != moves.rend() && whole; ++it) {
      const auto [via, to] = *it;
      const std::size_t in = Direction(at, via), out = Direction(via, to);
      // An earlier move may have taken what this one counts on.
      whole = !(in != kApart && Linked(at, in)) && Linked(via, out);
      if (!whole) break;
      Toggle(via, out);
      Connect(at, via);
      at = to;
    }
    if (whole) {
      int partner = -1;
      for (const bool beside : {true, false})
        ForPartners(at, beside, [&](int via) {
          if (partner < 0 && via != at && room_[Z(via)] > 0) partner = via;
        });
      if (partner >= 0) Connect(at, partner);
    }
  }
  for (const int cell : queue_) from_[Z(cell)] = {-1, -1};
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A floor of cells as the robot thinks it is, with its moves on it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "planners/online/robot_cells.h"
#include "planners/search/best_first.h"

namespace floorproof {

// Cells are numbered by rows, with a border around them that nobody enters. Of each cell it holds
// the steps that lead out of it, and those to an uncovered neighbour, a bit each.
class ThoughtFloor {
 public:
  static constexpr int kNone = -1;
  static constexpr int kStraight = 5, kDiagonal = 7, kTwice = 20;  // costs

  // All cells are open. `diagonals`: whether the robot takes diagonal steps.
  ThoughtFloor(int width, int height, bool diagonals)
      : width_(width + 2),
        height_(height + 2),
        steps_(diagonals ? 0xff : 0x55),
        open_(Size(), 0),
        search_(Size()) {
    marks_.exits = marks_.uncovered = marks_.visits = open_;
    for (std::size_t k = 0; k < kSteps.size(); ++k) by_[k] = kSteps[k].iy * width_ + kSteps[k].ix;
    for (int iy = 0; iy < height; ++iy)
      for (int ix = 0; ix < width; ++ix) SetOpen(NumberOf({ix, iy}), true);
  }

  int NumberOf(Cell c) const { return (c.iy + 1) * width_ + c.ix + 1; }
  int After(int i, int step) const { return i + by_[Z(step)]; }

  void SetOpen(int i, bool open) {
    if ((open_[Z(i)] != 0) == open) return;
    open_[Z(i)] = open;
    TellBeside(i, IsUncovered(i));
    FindExits(i);
    for (const int by : by_)
      if (!IsBorder(i + by)) FindExits(i + by);
  }
  bool IsUncovered(int i) const { return open_[Z(i)] != 0 && marks_.visits[Z(i)] == 0; }
  bool MayStep(int i, int step) const { return (marks_.exits[Z(i)] >> step & 1) != 0; }
  bool IsVisited(int i) const { return marks_.visits[Z(i)] != 0; }

  // The robot comes to a cell that is open.
  void Visit(int i) {
    std::uint8_t& visits = marks_.visits[Z(i)];
    if (visits == 0) TellBeside(i, false);
    if (visits < std::numeric_limits<std::uint8_t>::max()) ++visits;
  }
  // It did not come there, though that was said.
  void TakeBack(int i) {
    if (marks_.visits[Z(i)] > 0) --marks_.visits[Z(i)];
    TellBeside(i, IsUncovered(i));
  }

  // The rule; kNone: a dead end.
  int Choose(int i, int heading) const {
    int best = kNone, least = std::numeric_limits<int>::max();
    ForEach(marks_.exits[Z(i)] & marks_.uncovered[Z(i)] & steps_, [&](int k) {
      const int beside = kBits[marks_.uncovered[Z(After(i, k))]];
      const int score = 2 * beside + (k % 2 == 1 ? kAside : 0) + (k != heading ? kTurn : 0);
      if (score >= least) return;
      least = score;
      best = k;
    });
    return best;
  }

  // What a step costs beyond a straight one to an uncovered cell, of which none can be saved.
  int CostOf(int i, int step) const {
    const int length = step % 2 == 0 ? kStraight : kDiagonal;
    const int visits = marks_.visits[Z(After(i, step))];
    return visits == 0 ? 2 * (length - kStraight) : length + (visits == 1 ? kTwice : 0);
  }

  // The cheapest way out of a dead end, as steps; none: there is none. Returns what it costs. A way
  // that costs `most` is not looked for to its end: `most` then, and no steps.
  int WayOut(int from, std::vector<int>& steps, int most = std::numeric_limits<int>::max()) {
    steps.clear();
    search_.Begin();
    search_.Reach(from, 0);
    const int found = search_.Run(
        [&](const auto& at) { return at.cost >= most || (at.node != from && !IsVisited(at.node)); },
        [&](const auto& at, const auto& reach) {
          ForEach(marks_.exits[Z(at.node)], [&](int k) {
            const int to = After(at.node, k);
            reach(to, at.cost + (k % 2 == 0 ? kStraight : kDiagonal) +
                          (marks_.visits[Z(to)] == 1 ? kTwice : 0));
          });
        });
    if (found == search_.kNone) return 0;
    if (search_.CostOf(found) >= most) return most;
    const std::vector<int> path = search_.PathTo(found);
    for (std::size_t n = 1; n < path.size(); ++n)
      steps.push_back(
          static_cast<int>(std::ranges::find(by_, path[n] - path[n - 1]) - by_.begin()));
    return search_.CostOf(found);
  }

  // How many cells the last way out has looked at.
  std::int64_t effort() const { return search_.pops(); }

  // Calls call(step) for each step of a set, the first first.
  template <class Call>
  static void ForEach(unsigned steps, const Call& call) {
    for (; steps != 0; steps &= steps - 1) call(std::countr_zero(steps));
  }

 private:
  friend class LookAhead;
  // In halves of an uncovered neighbour, what a diagonal step counts, and what a turn does.
  static constexpr int kAside = 12, kTurn = 3;

  // How many steps are in a set.
  static constexpr std::array<std::int8_t, 256> kBits = [] {
    std::array<std::int8_t, 256> bits{};
    for (std::size_t set = 0; set < bits.size(); ++set)
      bits[set] = static_cast<std::int8_t>(std::popcount(set));
    return bits;
  }();

  // What changes with the robot's moves, and can be put back as it was.
  struct Marks {
    std::vector<std::uint8_t> exits, uncovered;  // steps, a bit each
    std::vector<std::uint8_t> visits;
  };

  std::size_t Size() const { return Z(width_) * Z(height_); }
  bool IsBorder(int i) const {
    const int column = i % width_, row = i / width_;
    return column == 0 || row == 0 || column == width_ - 1 || row == height_ - 1;
  }
  static constexpr unsigned Bit(std::size_t step) { return 1U << step % kSteps.size(); }
  static void Set(std::uint8_t& bits, unsigned bit, bool on) {
    bits = static_cast<std::uint8_t>(on ? bits | bit : bits & ~bit);
  }
  // To its neighbours, whether a cell is uncovered.
  void TellBeside(int i, bool uncovered) {
    for (std::size_t k = 0; k < kSteps.size(); ++k)
      if (const std::size_t j = Z(i + by_[k]); j < marks_.uncovered.size())
        Set(marks_.uncovered[j], Bit(k + kSteps.size() / 2), uncovered);
  }
  void FindExits(int i) {
    const auto open = [&](std::size_t k) { return open_[Z(i + by_[k % kSteps.size()])] != 0; };
    for (std::size_t k = 0; k < kSteps.size(); ++k)
      Set(marks_.exits[Z(i)], Bit(k), open(k) && (k % 2 == 0 || (open(k - 1) && open(k + 1))));
  }

  int width_, height_;  // the border included
  unsigned steps_;
  std::array<int, kSteps.size()> by_{};
  std::vector<std::uint8_t> open_;
  Marks marks_;
  BestFirstSearch<int, BucketFrontier<kDiagonal + kTwice + 1>> search_;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A floor of cells on which moves are tried in thought.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planners/online/robot_cells.h"
#include "planners/search/best_first.h"

namespace floorproof {

// The floor as the robot thinks it is, with the robot's moves on it, which can be taken back. Cells
// are numbered by rows, with a border around them that nobody enters.
class ThoughtFloor {
 public:
  static constexpr int kNone = -1;
  // `diagonals`: whether the robot takes diagonal steps.
  ThoughtFloor(const GridFrame& cells, bool diagonals)
      : width_(cells.width + 2),
        stride_(diagonals ? 1 : 2),
        open_(Size(cells), 0),
        visits_(Size(cells), 0),
        beside_(Size(cells), 0),
        column_(Size(cells), 0),
        search_(Size(cells)) {
    for (std::size_t k = 0; k < kSteps.size(); ++k) by_[k] = kSteps[k].iy * width_ + kSteps[k].ix;
    for (int iy = 0; iy < cells.height; ++iy)
      for (int ix = 0; ix < cells.width; ++ix) {
        const int i = NumberOf({ix, iy});
        column_[Z(i)] = ix + 1;
        SetOpen(i, true);
      }
  }

  int NumberOf(Cell c) const { return (c.iy + 1) * width_ + c.ix + 1; }
  int After(int i, std::size_t step) const { return i + by_[step]; }

  void SetOpen(int i, bool open) {
    if ((open_[Z(i)] != 0) == open) return;
    const bool before = IsUncovered(i);
    open_[Z(i)] = open;
    TellBeside(i, before);
  }
  bool IsUncovered(int i) const { return open_[Z(i)] && visits_[Z(i)] == 0; }

  // The robot comes to a cell.
  void Visit(int i) {
    if (log_) log_->push_back(i);
    const bool before = IsUncovered(i);
    ++visits_[Z(i)];
    TellBeside(i, before);
  }

  // It did not come there, though that was said.
  void TakeBack(int i) {
    const bool before = IsUncovered(i);
    --visits_[Z(i)];
    TellBeside(i, before);
  }

  bool MayStep(int i, std::size_t k) const {
    if (!open_[Z(i + by_[k])]) return false;
    return k % 2 == 0 || (open_[Z(i + by_[k - 1])] && open_[Z(i + by_[(k + 1) % kSteps.size()])]);
  }

  // The rule; kNone: a dead end.
  int Choose(int i, int heading) const {
    int best = kNone, least = 1000;
    for (std::size_t k = 0; k < kSteps.size(); k += stride_) {
      const int to = i + by_[k];
      if (!IsGoal(to) || !MayStep(i, k)) continue;
      const int score = 2 * (beside_[Z(to)] + (k % 2 == 1 ? 3 : 0)) + (Int(k) != heading ? 1 : 0);
      if (score >= least) continue;
      least = score;
      best = Int(k);
    }
    return best;
  }

  // The cheapest way out of a dead end, as steps; none: there is none. Returns what it costs.
  int WayOut(int from, std::vector<int>& steps) {
    steps.clear();
    search_.Begin();
    search_.Reach(from, 0);
    const int found = search_.Run([&](const auto& at) { return IsGoal(at.node); },
                                  [&](const auto& at, const auto& reach) {
                                    for (std::size_t k = 0; k < kSteps.size(); ++k) {
                                      if (!MayStep(at.node, k) || !IsNear(at.node + by_[k]))
                                        continue;
                                      const int to = at.node + by_[k];
                                      reach(to, at.cost + (k % 2 == 0 ? kStraight : kDiagonal) +
                                                    (visits_[Z(to)] == 1 ? kTwice : 0));
                                    }
                                  });
    if (found == search_.kNone) return 0;
    const std::vector<int> path = search_.PathTo(found);
    for (std::size_t n = 1; n < path.size(); ++n)
      steps.push_back(Int(std::ranges::find(by_, path[n] - path[n - 1]) - by_.begin()));
    return search_.CostOf(found);
  }

  // What dead ends cost where the rule is followed after this step, until all is covered within
  // `around` cells; no more than `most` is counted. Leaves the floor as it was.
  int Rollout(int from, int step, int around, int most) {
    thought_.clear();
    log_ = &thought_;
    const int row = from / width_, column = column_[Z(from)];
    near_ = Near{(row - around) * width_, (row + around + 1) * width_, column - around,
                 column + around};
    int at = from + by_[Z(step)], heading = step, cost = 0;
    Visit(at);
    while (cost < most) {
      const int next = Choose(at, heading);
      if (next != kNone) {
        way_.assign(1, next);
      } else {
        cost += WayOut(at, way_);
        if (way_.empty()) break;
      }
      for (const int k : way_) {
        heading = k;
        at += by_[Z(k)];
        Visit(at);
      }
    }
    near_.reset();
    log_ = nullptr;
    for (const int i : thought_) TakeBack(i);
    return cost;
  }

 private:
  static std::size_t Size(const GridFrame& cells) {
    return static_cast<std::size_t>(cells.width + 2) * static_cast<std::size_t>(cells.height + 2);
  }
  template <class T>
  static int Int(T n) {
    return static_cast<int>(n);
  }
  // Where only what is near counts, whether it is.
  bool IsNear(int i) const {
    return !near_ || (i >= near_->first && i < near_->last && column_[Z(i)] >= near_->low &&
                      column_[Z(i)] <= near_->high);
  }
  bool IsGoal(int i) const { return IsUncovered(i) && IsNear(i); }
  void TellBeside(int i, bool before) {
    const int more = Int(IsUncovered(i)) - Int(before);
    if (more == 0) return;
    for (const int by : by_)
      if (const int j = i + by; j >= 0 && j < Int(beside_.size()))
        beside_[Z(j)] = static_cast<std::int8_t>(beside_[Z(j)] + more);
  }

  static constexpr int kStraight = 5, kDiagonal = 7, kTwice = 15;  // costs

  // Some cells around one: a band of numbers, and columns in it.
  struct Near {
    int first, last, low, high;
  };

  int width_;
  std::size_t stride_;  // of kSteps
  std::array<int, kSteps.size()> by_{};
  std::vector<std::uint8_t> open_;
  std::vector<std::int32_t> visits_;
  std::vector<std::int8_t> beside_;  // uncovered neighbours
  std::vector<std::int32_t> column_;
  BestFirstSearch<int, BucketFrontier<kDiagonal + kTwice + 1>> search_;
  std::optional<Near> near_;
  std::vector<int>* log_ = nullptr;
  std::vector<int> thought_, way_;
};

}  // namespace floorproof

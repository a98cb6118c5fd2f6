// SPDX-License-Identifier: Apache-2.0
// Coverage of an unknown floor that keeps along the frontier of what is covered, and looks ahead.
//
// The rule: go to the uncovered cell beside the robot that has the fewest uncovered neighbours; a
// diagonal step counts as three more, and straight on wins where equal. At a dead end go the
// cheapest way to an uncovered cell. So the robot winds along walls and lanes, yet it runs into
// dead ends that it could have seen. Hence, where there is a choice, each cell beside the robot is
// tried: from there the rule is driven in thought until all is covered within some cells around the
// robot, and the cell after which dead ends cost least is taken. Unknown floor is thought to be
// free. (A rollout: Bertsekas, Tsitsiklis & Wu, "Rollout algorithms for combinatorial
// optimization", 1997.) It is driven to its end, on a small part of the floor: broken off, it would
// prefer what puts dead ends off.
//
// A way out of a dead end costs its length, and much more for each cell that is covered for the
// second time on it. Cells covered twice already cost no more than their length.
// Ours. Assumed: r is at least a step. Not done: choosing a way out by what lies behind its end.
// Where all is covered but something far away, the way out is searched for over all of the known
// floor.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "planners/online/cell_params.h"
#include "planners/online/online_planner.h"
#include "planners/online/robot_cells.h"
#include "planners/search/best_first.h"

namespace floorproof {
namespace {

constexpr int kNone = -1;
constexpr int kStraight = 5, kDiagonal = 7, kTwice = 15;  // costs

// The floor as the robot thinks it is, with the robot's moves on it, which can be taken back. Cells
// are numbered by rows, with a border around them that nobody enters.
class ThoughtFloor {
 public:
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
    for (const int i : thought_) {
      const bool before = IsUncovered(i);
      --visits_[Z(i)];
      TellBeside(i, before);
    }
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

class FrontierCoverage final : public OnlinePlanner {
 public:
  void Visit(ParamVisitor& v) override {
    params_.Visit(v);
    v("look_around", look_around_, Between(0, 100),
      "for so many cells around it thinks its way through before each step; 0: the rule alone");
  }
  double radius_m() const override { return params_.radius_m; }
  std::optional<double> step_m() const override { return params_.step_m; }

  void Start(const OnlineTask& task) override {
    cells_ = params_.Cells(task);
    // What it would step to must be seen.
    const bool diagonals = params_.radius_m >= std::sqrt(2.0) * cells_.frame().cell_m;
    floor_.emplace(cells_.frame(), diagonals);
    for (int iy = 0; iy < cells_.frame().height; ++iy)
      for (int ix = 0; ix < cells_.frame().width; ++ix)
        floor_->SetOpen(floor_->NumberOf({ix, iy}), cells_.MayBeFree({ix, iy}));
    here_.reset();
    heading_ = kNone;
    route_.clear();
    dead_ends_ = 0;
  }

  OnlineStep Next(const OnlineInput& input) override {
    cells_.Update(input.known, input.changed);
    for (const Cell c : cells_.changed()) floor_->SetOpen(floor_->NumberOf(c), cells_.MayBeFree(c));
    const Cell here = cells_.At(input.estimate.X_WB.p());
    if (here_ != here) floor_->Visit(floor_->NumberOf(here));
    const bool first = !here_;
    here_ = here;
    heading_ = Choose(floor_->NumberOf(here));
    if (heading_ != kNone)
      return {OnlineStep::Kind::kTarget, cells_.frame().Center(here + kSteps[Z(heading_)])};
    if (first) return {OnlineStep::Kind::kNowhere, {}, "there is no free floor around the robot"};
    return {OnlineStep::Kind::kDone, {}, "all known floor that can be reached is covered"};
  }

  std::vector<std::pair<std::string, double>> figures() const override {
    return {{"dead_ends", dead_ends_}};
  }

 private:
  // The step to take; kNone: there is no more to cover that can be reached.
  int Choose(int at) {
    for (;;) {
      if (route_.empty()) {
        const int by_rule = floor_->Choose(at, heading_);
        if (by_rule != kNone) return LookAhead(at, by_rule);
        floor_->WayOut(at, route_);
        if (route_.empty()) return kNone;
        std::ranges::reverse(route_);
        dead_ends_ += 1;
      }
      const int step = route_.back();
      route_.pop_back();
      if (cells_.MayStep(*here_, Z(step))) return step;
      // What was thought free is not known to be: not that way, then, unless it is seen to be.
      route_.clear();
      floor_->SetOpen(floor_->After(at, Z(step)), false);
    }
  }

  int LookAhead(int at, int by_rule) {
    std::array<int, kSteps.size()> choices;
    std::size_t n = 0;
    choices[n++] = by_rule;
    for (std::size_t k = 0; k < kSteps.size(); ++k)
      if (static_cast<int>(k) != by_rule && cells_.MayStep(*here_, k) &&
          floor_->IsUncovered(floor_->After(at, k)))
        choices[n++] = static_cast<int>(k);
    if (n == 1 || look_around_ == 0) return by_rule;
    int best = by_rule, least = 1'000'000'000;
    for (std::size_t i = 0; i < n; ++i) {
      const int cost = floor_->Rollout(at, choices[i], look_around_, least);
      if (cost >= least) continue;
      least = cost;
      best = choices[i];
    }
    return best;
  }

  CellParams params_;
  int look_around_ = 16;

  RobotCells cells_;
  std::optional<ThoughtFloor> floor_;
  std::optional<Cell> here_;
  int heading_ = kNone;
  std::vector<int> route_;  // steps; the next is the last
  double dead_ends_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(OnlinePlanner, FrontierCoverage)

}  // namespace floorproof

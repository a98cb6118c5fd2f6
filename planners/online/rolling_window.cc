// SPDX-License-Identifier: Apache-2.0
// Coverage of an unknown floor by a finite state machine in a rolling window.
//
// The robot knows what lies within radius r of it: a window that rolls with it. Beside uncovered
// cells it goes to the one with the most free neighbours (F1). Else it goes to the nearest
// uncovered cell in the window (F2), straight, and around what stands in the way (F3).
//
// Reference: Li Caihong, Wang Fengying, Song Yong, Liang Zhenying, Wang Zhiqiang, "A Complete
// Coverage Path Planning Algorithm for Mobile Robot Based on FSM and Rolling Window Approach in
// Unknown Environment": properties Eqs. 1-3, F1 Eqs. 4-10, F2 Eqs. 11-12, F3 section 4.3.
//
// Where the paper is silent, ours:
//   Of cells with equally many free neighbours F1 takes the first counter-clockwise from east; of
//   equally near ones F2 takes the first by rows from below.
//   F3 tries segments as long as the way to the target, turned by 0, theta, -theta, 2 theta, ...
//   Along the first that is clear it takes one step, then it tries anew. Its turns are counted
//   until the target is reached, so that it cannot go to and fro for ever. Where F3 gives up, or
//   the window holds no uncovered cell though the known floor does, the robot goes the shortest way
//   over known floor to the nearest uncovered cell. No covered cell needs to be gone to for what
//   lies beyond it: when it was covered, all within r of it was seen.
// Assumed: r is at least a step. Not done: looking ahead; pockets are left, and come back to.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "planners/online/nearest_uncovered.h"
#include "planners/online/online_planner.h"
#include "planners/online/robot_cells.h"

namespace floorproof {
namespace {

class RollingWindow final : public OnlinePlanner {
 public:
  void Visit(ParamVisitor& v) override {
    params_.Visit(v);
    v("turn_deg", turn_deg_, Between(1, 180), "theta: by how much F3 turns at a time (deg)");
    v("most_turns", most_turns_, AtLeast(1), "after so many turns for one target F3 gives up");
  }
  const OnlineParams& params() const override { return params_; }

  void Start(const OnlineTask& task) override {
    cells_ = CellsOf(task, params_);
    way_out_.emplace(cells_.frame());
    radius_ = params_.radius_m / cells_.frame().cell_m + kSlack;
    window_.clear();
    const int reach = static_cast<int>(radius_);
    for (int iy = -reach; iy <= reach; ++iy)
      for (int ix = -reach; ix <= reach; ++ix)
        if (IsEnabled({ix, iy})) window_.push_back({ix, iy});
    std::ranges::stable_sort(window_, {}, [](Cell by) { return SquaredLength(by); });
    here_.reset();
    target_.reset();
    route_.clear();
    given_up_ = beyond_window_ = 0;
  }

  OnlineStep Next(const OnlineInput& input) override {
    cells_.Update(input.known, input.changed);
    if (input.missed && here_) cells_.TakeBack(*here_);
    const Cell here = cells_.FreeAt(input.estimate.X_WB.p());
    if (here_ != here || input.missed) cells_.Visit(here);
    const bool first = !here_;
    here_ = here;
    if (const std::optional<Cell> next = Choose())
      return {OnlineStep::Kind::kTarget, cells_.frame().Center(*next)};
    if (first) return {OnlineStep::Kind::kNowhere, {}, "there is no free floor around the robot"};
    return {OnlineStep::Kind::kDone, {}, "all known floor that can be reached is covered"};
  }

  std::vector<std::pair<std::string, double>> figures() const override {
    return {{"f3_given_up", given_up_}, {"beyond_window", beyond_window_}};
  }

 private:
  static constexpr double kSlack = 1e-9;

  static int SquaredLength(Cell by) { return by.ix * by.ix + by.iy * by.iy; }
  // Eq. 3, `by` from the robot.
  bool IsEnabled(Cell by) const { return std::sqrt(SquaredLength(by)) <= radius_; }
  bool IsFree(Cell by) const { return IsEnabled(by) && cells_.IsFree(*here_ + by); }

  // The cell to step to. State S1, at the start, is S2 or S3; without a cell it is S5.
  std::optional<Cell> Choose() {
    if (target_ == here_ || (target_ && !cells_.IsFree(*target_))) target_.reset();
    if (!target_ && route_.empty()) {
      if (const auto beside = GreatestRelated()) return beside;  // S2
      target_ = NearestInWindow();                               // S3
      turns_ = 0;
      beyond_window_ += target_ ? 0 : 1;
    }
    if (target_) {  // S4
      if (const auto next = TowardsTarget()) return next;
      target_.reset();
      ++given_up_;
    }
    return AlongRoute();
  }

  // F1. Of the uncovered cells beside the robot, the first of the greatest Related (Eqs. 8-10).
  std::optional<Cell> GreatestRelated() const {
    std::optional<Cell> best;
    int most = -1;
    for (std::size_t k = 0; k < kSteps.size(); ++k) {
      if (!IsEnabled(kSteps[k]) || !cells_.MayStep(*here_, k)) continue;
      if (cells_.visits(*here_ + kSteps[k]) > 0) continue;
      const int related = Related(kSteps[k]);
      if (related <= most) continue;
      most = related;
      best = *here_ + kSteps[k];
    }
    return best;
  }

  // Eqs. 4-6: of a cell at `by` from the robot the free neighbours in the window. In a corner of
  // the window there are at most three, at its border five, within it eight.
  int Related(Cell by) const {
    return static_cast<int>(
        std::ranges::count_if(kSteps, [&](Cell step) { return IsFree(by + step); }));
  }

  // F2, Eqs. 11 and 12.
  std::optional<Cell> NearestInWindow() const {
    for (const Cell by : window_)
      if (cells_.IsUncovered(*here_ + by)) return *here_ + by;
    return std::nullopt;
  }

  // F3: the next cell on the way to the target; none: it has turned too often.
  std::optional<Cell> TowardsTarget() {
    const Vec2 way(target_->ix - here_->ix, target_->iy - here_->iy);
    for (int turn = 0; turns_ <= most_turns_; ++turn, ++turns_) {
      const int side = turn % 2 == 1 ? 1 : -1;  // left first
      const double by_rad = side * ((turn + 1) / 2) * turn_deg_ * kPi / 180;
      if (std::abs(by_rad) > kPi + kSlack) break;
      if (const auto next = FirstAlong(Pose2{0, 0, by_rad}.Rotate(way))) return next;
    }
    return std::nullopt;
  }

  // The first cell of a straight segment from the robot to the cell at `way`; none: not clear.
  std::optional<Cell> FirstAlong(const Vec2& way) const {
    const Cell to = {static_cast<int>(std::lround(way.x())),
                     static_cast<int>(std::lround(way.y()))};
    const int n = std::max(std::abs(to.ix), std::abs(to.iy));
    if (n == 0) return std::nullopt;
    Cell at = {0, 0}, first = {0, 0};
    for (int i = 1; i <= n; ++i) {
      const Cell next = OnLine(to, i, n);
      if (!cells_.MayStep(*here_ + at, StepOf({next.ix - at.ix, next.iy - at.iy})))
        return std::nullopt;
      at = next;
      if (i == 1) first = next;
    }
    return *here_ + first;
  }

  // The next cell of the shortest way to the nearest uncovered cell.
  std::optional<Cell> AlongRoute() {
    const auto leads_on = [this] {
      if (route_.empty()) return false;
      const auto step = StepOf({route_.back().ix - here_->ix, route_.back().iy - here_->iy});
      return step < kSteps.size() && cells_.MayStep(*here_, step);
    };
    if (!leads_on()) {
      route_ = way_out_->PathFrom(*here_, cells_);
      std::ranges::reverse(route_);
    }
    if (route_.empty()) return std::nullopt;
    const Cell next = route_.back();
    route_.pop_back();
    return next;
  }

  OnlineParams params_;
  double turn_deg_ = 45;
  int most_turns_ = 16;

  RobotCells cells_;
  std::optional<NearestUncovered> way_out_;
  double radius_ = 0;         // r in steps
  std::vector<Cell> window_;  // from the robot, the nearest first
  std::optional<Cell> here_, target_;
  int turns_ = 0;
  std::vector<Cell> route_;  // the next cell is the last
  double given_up_ = 0, beyond_window_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(OnlinePlanner, RollingWindow)

}  // namespace floorproof

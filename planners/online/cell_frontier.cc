// SPDX-License-Identifier: Apache-2.0
#include "planners/online/cell_frontier.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floorproof {
namespace {

constexpr int kNone = ThoughtFloor::kNone;
// What another way must cost less than the one that the robot is about to go, at the least.
constexpr int kBetter = 2 * ThoughtFloor::kStraight;

// What it would step to must be seen: diagonals, too.
bool SeesDiagonals(const OnlineParams& params, const RobotCells& cells) {
  return params.radius_m >= std::sqrt(2.0) * cells.frame().cell_m;
}

}  // namespace

CellFrontier::CellFrontier(const OnlineTask& task, const OnlineParams& params, int look_around)
    : cells_(CellsOf(task, params)),
      floor_(cells_.frame().width, cells_.frame().height, SeesDiagonals(params, cells_)) {
  if (look_around > 0) ahead_.emplace(look_around, SeesDiagonals(params, cells_));
  cells_.TellChanges();
  for (int iy = 0; iy < cells_.frame().height; ++iy)
    for (int ix = 0; ix < cells_.frame().width; ++ix)
      floor_.SetOpen(floor_.NumberOf({ix, iy}), cells_.MayBeFree({ix, iy}));
}

OnlineStep CellFrontier::Next(const OnlineInput& input) {
  cells_.Update(input.known, input.changed);
  for (const Cell c : cells_.changed()) floor_.SetOpen(floor_.NumberOf(c), cells_.MayBeFree(c));
  if (input.missed && here_) floor_.TakeBack(floor_.NumberOf(*here_));
  // Its steps began elsewhere.
  if (input.missed || input.left_its_way()) {
    route_.clear();
    plan_.clear();
  }
  const Cell here = cells_.FreeAt(input.estimate.X_WB.p());
  if (here_ != here || input.missed) floor_.Visit(floor_.NumberOf(here));
  const bool first = !here_;
  here_ = here;
  heading_ = Choose(floor_.NumberOf(here));
  if (heading_ != kNone)
    return {OnlineStep::Kind::kTarget, cells_.frame().Center(here + kSteps[Z(heading_)])};
  if (first) return {OnlineStep::Kind::kNowhere, {}, "there is no free floor around the robot"};
  return {OnlineStep::Kind::kDone, {}, "all known floor that can be reached is covered"};
}

// The step to take; kNone: there is no more to cover that can be reached.
int CellFrontier::Choose(int at) {
  for (;;) {
    const int by_rule = route_.empty() ? floor_.Choose(at, heading_) : kNone;
    if (by_rule == kNone && route_.empty()) {
      floor_.WayOut(at, route_);
      if (route_.empty()) return kNone;
      std::ranges::reverse(route_);
      dead_ends_ += 1;
    }
    const int step = by_rule != kNone ? by_rule : route_.back();
    if (cells_.MayStep(*here_, Z(step))) {
      if (by_rule != kNone) return Best(at, by_rule);
      route_.pop_back();
      return step;
    }
    route_.clear();
    NotThatWay(at, Z(step));
  }
}

// What was thought free is not known to be: it is not entered, unless it is seen to be free.
void CellFrontier::NotThatWay(int at, std::size_t step) {
  const auto close = [&](std::size_t k) {
    if (!cells_.IsFree(*here_ + kSteps[k]))
      floor_.SetOpen(floor_.After(at, static_cast<int>(k)), false);
  };
  close(step);
  if (step % 2 == 0) return;
  close(step - 1);
  close((step + 1) % kSteps.size());
}

// The step that the rule takes, the one that was planned, or another to an uncovered cell.
int CellFrontier::Best(int at, int by_rule) {
  if (!ahead_) return by_rule;
  const auto leads_on = [&](int step) {
    return cells_.MayStep(*here_, Z(step)) && floor_.IsUncovered(floor_.After(at, step));
  };
  if (planned_from_ != here_ || (!plan_.empty() && !leads_on(plan_.front()))) plan_.clear();
  const bool planned = !plan_.empty();
  if (!planned) plan_.assign(1, by_rule);
  ahead_->Stand(floor_, at);
  int least = ahead_->CostOf(plan_, std::numeric_limits<int>::max()) - kBetter;
  plan_ = ahead_->way();
  const auto consider = [&](int step) {
    const int cost = ahead_->CostOf({&step, 1}, least);
    if (cost >= least) return;
    least = cost;
    plan_ = ahead_->way();
  };
  if (planned) consider(by_rule);
  for (int k = 0; k < static_cast<int>(kSteps.size()); ++k)
    if (k != by_rule && leads_on(k)) consider(k);
  const int step = plan_.front();
  plan_.erase(plan_.begin());
  planned_from_ = *here_ + kSteps[Z(step)];
  return step;
}

}  // namespace floorproof

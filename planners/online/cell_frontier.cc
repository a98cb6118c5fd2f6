// SPDX-License-Identifier: Apache-2.0
#include "planners/online/cell_frontier.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace floorproof {
namespace {

constexpr int kNone = ThoughtFloor::kNone;

}  // namespace

// What it would step to must be seen: diagonals, too.
CellFrontier::CellFrontier(const OnlineTask& task, const OnlineParams& params, int look_around)
    : look_around_(look_around),
      cells_(CellsOf(task, params)),
      floor_(cells_.frame(), params.radius_m >= std::sqrt(2.0) * cells_.frame().cell_m) {
  cells_.TellChanges();
  for (int iy = 0; iy < cells_.frame().height; ++iy)
    for (int ix = 0; ix < cells_.frame().width; ++ix)
      floor_.SetOpen(floor_.NumberOf({ix, iy}), cells_.MayBeFree({ix, iy}));
}

OnlineStep CellFrontier::Next(const OnlineInput& input) {
  cells_.Update(input.known, input.changed);
  for (const Cell c : cells_.changed()) floor_.SetOpen(floor_.NumberOf(c), cells_.MayBeFree(c));
  if (input.missed && here_) floor_.TakeBack(floor_.NumberOf(*here_));
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
      if (by_rule != kNone) return LookAhead(at, by_rule);
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
    if (!cells_.IsFree(*here_ + kSteps[k])) floor_.SetOpen(floor_.After(at, k), false);
  };
  close(step);
  if (step % 2 == 0) return;
  close(step - 1);
  close((step + 1) % kSteps.size());
}

int CellFrontier::LookAhead(int at, int by_rule) {
  std::array<int, kSteps.size()> choices;
  std::size_t n = 0;
  choices[n++] = by_rule;
  for (std::size_t k = 0; k < kSteps.size(); ++k)
    if (static_cast<int>(k) != by_rule && cells_.MayStep(*here_, k) &&
        floor_.IsUncovered(floor_.After(at, k)))
      choices[n++] = static_cast<int>(k);
  if (n == 1 || look_around_ == 0) return by_rule;
  int best = by_rule, least = 1'000'000'000;
  for (std::size_t i = 0; i < n; ++i) {
    const int cost = floor_.Rollout(at, choices[i], look_around_, least);
    if (cost >= least) continue;
    least = cost;
    best = choices[i];
  }
  return best;
}

}  // namespace floorproof

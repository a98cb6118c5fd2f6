// SPDX-License-Identifier: Apache-2.0
#include "planners/online/lane_frontier.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace floorproof {
namespace {

constexpr double kBeside = 0.4;     // worth of a metre with the frontier on one side, of new floor
constexpr double kAskew = 0.1;      // of new floor, that a metre along a diagonal costs
constexpr double kTurn_m = 0.015;   // of new floor, that 45 degrees of turning cost
constexpr double kLeastNew = 0.25;  // of the tool's width, that a lane is to sweep
// Of the tool's area, that must be open at a place that the robot goes to: at the least, more for
// each metre of the way, and what is always enough. A narrow tool finds more places that are small:
// for it a metre asks for more.
constexpr double kLeastOpen = 0.08, kOpenAMetre = 0.09, kNarrow = 0.025, kEnoughOpen = 0.8;
constexpr double kSecondLeg = 1.0;  // tool widths
constexpr double kFirstLegs[] = {0.1, 0.25, 0.5, 1.0};
constexpr double kSamePlace_m = 1e-3;

int Turns(int from, std::size_t to) {
  if (from < 0) return 0;
  const int by = std::abs(from - static_cast<int>(to));
  return std::min(by, 8 - by);
}

}  // namespace

LaneFrontier::LaneFrontier(const OnlineTask& task)
    : floor_(task.ground, task.body, task.clear, task.tool),
      width_(task.tool_width_m / floor_.frame().cell_m) {}

struct LaneFrontier::Tried {
  Cell at;
  int heading;
  double length = 0, worth = 0, fresh = 0;  // cells
};

// Drives on in thought, as far as the floor is free.
void LaneFrontier::Go(std::size_t step, int most, Tried& way) const {
  const Cell by = kSteps[step];
  const double cell = std::hypot(by.ix, by.iy);
  const Cell left = floor_.beside(step), right = floor_.beside((step + 4) % kSteps.size());
  way.worth -= kTurn_m / floor_.frame().cell_m * Turns(way.heading, step);
  for (int i = 0; i < most; ++i) {
    const Cell next = way.at + by;
    if (!floor_.IsFree(next)) return;
    int fresh = 0;
    for (const Cell& c : floor_.added(step)) fresh += floor_.IsOpen(next + c);
    const int beside = !floor_.IsOpen(next + left) + !floor_.IsOpen(next + right);
    way.at = next;
    way.heading = static_cast<int>(step);
    way.length += cell;
    const double share =
        static_cast<double>(fresh) / static_cast<double>(floor_.added(step).size());
    way.fresh += cell * share;
    way.worth += cell * (share + (fresh > 0 ? kBeside * beside : 0) - (step % 2 == 1 ? kAskew : 0));
  }
}

LaneFrontier::Legs LaneFrontier::BestLegs(Cell from) const {
  Legs best;
  const auto judge = [&](const Tried& first, const Tried& both) {
    if (both.length == 0 || both.fresh < kLeastNew * both.length) return;
    const double value = both.worth / both.length;
    if (value > best.value) best = {value, first.at, first.heading};
  };
  const int second = static_cast<int>(std::ceil(kSecondLeg * width_));
  for (std::size_t a = 0; a < kSteps.size(); ++a) {
    Tried first{from, heading_};
    int gone = 0;
    for (const double leg : kFirstLegs) {
      const int to = static_cast<int>(std::ceil(leg * width_));
      const Cell was = first.at;
      Go(a, to - gone, first);
      if (first.at == was) break;
      gone = to;
      for (std::size_t b = 0; b < kSteps.size(); ++b) {
        if ((b + 4) % 8 == a) continue;
        Tried both = first;
        Go(b, second, both);
        judge(first, both);
      }
    }
  }
  return best;
}

// What was driven since the last call.
void LaneFrontier::Sweep(const OnlineInput& input) {
  if (input.missed && here_W_) {
    floor_.TakeBack(*before_W_, *here_W_);
    here_W_ = before_W_;
  } else if (here_W_) {
    floor_.Stand(*before_W_, *here_W_);
  }
  const Vec2 now_W = input.estimate.X_WB.p();
  before_W_ = here_W_ ? here_W_ : now_W;
  here_W_ = now_W;
  floor_.Sweep(*before_W_, now_W);
}

void LaneFrontier::PopReached() {
  while (!route_.empty() && (route_.back().to_W - *here_W_).norm() < kSamePlace_m)
    route_.pop_back();
}

OnlineStep LaneFrontier::Next(const OnlineInput& input) {
  const bool first = !here_W_;
  floor_.Update(input.known, input.changed);
  Sweep(input);
  const Cell here = floor_.FreeAt(*here_W_, floor_.frame().cell_m * width_);
  PopReached();
  // Since the way was found, something may have come into sight on its later legs.
  const bool blocked = !route_.empty() && route_.back().is_free &&
                       !floor_.Sees(here, floor_.frame().ToCell(route_.back().to_W));
  if (blocked || input.left_its_way()) route_.clear();
  if (route_.empty()) {
    if (const Legs legs = BestLegs(here); legs.value > 0) {
      heading_ = legs.heading;
      return {OnlineStep::Kind::kTarget, floor_.frame().Center(legs.first)};
    }
    const auto tool = static_cast<double>(floor_.tool().size());
    const double cell_m = floor_.frame().cell_m;
    const double a_metre = kOpenAMetre + kNarrow / (width_ * cell_m);
    route_ =
        floor_.WayToOpen(here, {kLeastOpen * tool, kEnoughOpen * tool, a_metre * tool * cell_m});
    std::ranges::reverse(route_);
    dead_ends_ += !route_.empty();
    PopReached();
  }
  if (!route_.empty()) {
    const Vec2 next_W = route_.back().to_W;
    route_.pop_back();
    const Vec2 way = floor_.frame().X_WG.Inverse().Rotate(next_W - *here_W_);
    heading_ = static_cast<int>(std::lround(std::atan2(way.y(), way.x()) / (kPi / 4)) + 8) % 8;
    return {OnlineStep::Kind::kTarget, next_W};
  }
  if (first) return {OnlineStep::Kind::kNowhere, {}, "there is no free floor around the robot"};
  return {OnlineStep::Kind::kDone, {}, "all known floor that can be reached is covered"};
}

}  // namespace floorproof

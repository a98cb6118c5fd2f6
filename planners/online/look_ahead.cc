// SPDX-License-Identifier: Apache-2.0
#include "planners/online/look_ahead.h"

#include <algorithm>
#include <initializer_list>

namespace floorproof {

LookAhead::LookAhead(int around, bool diagonals)
    : side_(2 * around + 1), floor_(side_, side_, diagonals), taken_(floor_.marks_) {}

void LookAhead::Stand(const ThoughtFloor& floor, int at) {
  const int n = floor_.width_;
  const int low_x = at % floor.width_ - n / 2, low_y = at / floor.width_ - n / 2;
  const int first_x = std::max(0, -low_x), last_x = std::min(n, floor.width_ - low_x);
  const int first_y = std::max(0, -low_y), last_y = std::min(n, floor.height_ - low_y);
  const auto take = [&](const std::vector<std::uint8_t>& from, std::vector<std::uint8_t>& to) {
    std::ranges::fill(to, std::uint8_t{0});
    for (int y = first_y; y < last_y; ++y)
      std::copy_n(&from[Z((low_y + y) * floor.width_ + low_x + first_x)], last_x - first_x,
                  &to[Z(y * n + first_x)]);
  };
  take(floor.marks_.exits, taken_.exits);
  take(floor.marks_.uncovered, taken_.uncovered);
  take(floor.marks_.visits, taken_.visits);
  // Nothing leads beyond the border: into it, from the cells beside it.
  const auto close = [&](int i, std::initializer_list<int> steps) {
    for (const int k : steps) taken_.exits[Z(i)] &= static_cast<std::uint8_t>(~(1U << k));
  };
  for (int t = 0; t < n; ++t) {
    for (const int border : {t, (n - 1) * n + t, t * n, t * n + n - 1}) taken_.exits[Z(border)] = 0;
    close(n + t, {5, 6, 7});
    close((n - 2) * n + t, {1, 2, 3});
    close(t * n + 1, {3, 4, 5});
    close(t * n + n - 2, {7, 0, 1});
  }
  CountUncovered();
  effort_ = 0;
}

void LookAhead::CountUncovered() {
  const int start = floor_.width_ * (floor_.width_ / 2) + floor_.width_ / 2;
  seen_.assign(taken_.exits.size(), 0);
  seen_[Z(start)] = 1;
  todo_.assign(1, start);
  uncovered_ = 0;
  while (!todo_.empty()) {
    const int i = todo_.back();
    todo_.pop_back();
    ThoughtFloor::ForEach(taken_.exits[Z(i)], [&](int k) {
      const int to = floor_.After(i, k);
      if (seen_[Z(to)] != 0) return;
      seen_[Z(to)] = 1;
      uncovered_ += taken_.visits[Z(to)] == 0 ? 1 : 0;
      todo_.push_back(to);
    });
  }
}

int LookAhead::CostOf(std::span<const int> begin, int most) {
  floor_.marks_ = taken_;
  at_ = floor_.width_ * (floor_.width_ / 2) + floor_.width_ / 2;
  heading_ = begin.front();
  cost_ = 0;
  left_ = uncovered_;
  way_.clear();
  for (std::size_t i = 0; i < begin.size() && cost_ < most && floor_.MayStep(at_, begin[i]); ++i)
    Go(begin[i]);
  while (cost_ < most && left_ > 0) {
    if (effort_ > kMostEffort) return most;
    if (const int by_rule = floor_.Choose(at_, heading_); by_rule != ThoughtFloor::kNone) {
      Go(by_rule);
      continue;
    }
    floor_.WayOut(at_, way_out_, most - cost_);
    effort_ += floor_.effort();
    if (way_out_.empty()) return most;
    for (const int step : way_out_) Go(step);
  }
  return std::min(cost_, most);
}

void LookAhead::Go(int step) {
  cost_ += floor_.CostOf(at_, step);
  at_ = floor_.After(at_, step);
  heading_ = step;
  left_ -= floor_.IsVisited(at_) ? 0 : 1;
  floor_.Visit(at_);
  way_.push_back(step);
  ++effort_;
}

}  // namespace floorproof

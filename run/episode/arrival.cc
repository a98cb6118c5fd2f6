// SPDX-License-Identifier: Apache-2.0
#include "run/episode/arrival.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

constexpr double kApart_m = 0.05;  // between looks at a plan
constexpr double kMostLooks = 1e6;

}  // namespace

PlanPassed::PlanPassed(const Path& plan, double near_m) : near_m_(near_m) {
  const double apart_m = std::max(kApart_m, Length(plan) / kMostLooks);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan[i].task) tasks_.push_back({plan[i].p_W});
    if (i + 1 == plan.size()) break;
    const Vec2 from_W = plan[i].p_W, way_W = plan[i + 1].p_W - from_W;
    const int looks = std::max(1, static_cast<int>(std::ceil(way_W.norm() / apart_m)));
    for (int k = 0; k < looks; ++k) {
      const Vec2 p_W = from_W + (k + 0.5) / looks * way_W;
      looks_.push_back({Key(p_W.x(), p_W.y()), p_W, way_W.norm() / looks});
    }
  }
  std::ranges::stable_sort(looks_, {}, &Look::key);
}

std::int64_t PlanPassed::Key(double x, double y) const {
  constexpr std::int64_t kColumns = std::int64_t{1} << 31;
  const auto square = [this](double v) {
    return static_cast<std::int64_t>(std::floor(std::clamp(v / near_m_, -1e9, 1e9)));
  };
  return square(y) * kColumns + square(x);
}

void PlanPassed::Add(const Vec2& p_W, bool dwelling) {
  if (dwelling)
    for (Task& task : tasks_) task.done |= (task.p_W - p_W).norm() <= near_m_;
  if ((p_W - last_W_).norm() < 0.1 * near_m_ && !dwelling) return;
  last_W_ = p_W;
  for (int row = -1; row <= 1; ++row) {
    const double y = p_W.y() + row * near_m_;
    const std::int64_t first = Key(p_W.x() - near_m_, y), last = Key(p_W.x() + near_m_, y);
    for (auto look = std::ranges::lower_bound(looks_, first, {}, &Look::key);
         look != looks_.end() && look->key <= last; ++look)
      look->passed |= (look->p_W - p_W).norm() <= near_m_;
  }
}

double PlanPassed::left_m() const {
  double left_m = 0;
  for (const Look& look : looks_) left_m += look.passed ? 0 : look.share_m;
  return left_m;
}

int PlanPassed::tasks_missed() const {
  return static_cast<int>(std::ranges::count(tasks_, false, &Task::done));
}

std::optional<Vec2> PlanPassed::first_missed_W() const {
  const auto missed = std::ranges::find(tasks_, false, &Task::done);
  return missed == tasks_.end() ? std::nullopt : std::optional(missed->p_W);
}

void RestWatch::Add(const Truth& truth) {
  if (truth.v_WB_W.norm() > kRest_mps || std::abs(truth.V_WB_B.wz_radps) > kRest_radps)
    moved_s_ = truth.t_s;
}

}  // namespace floorproof

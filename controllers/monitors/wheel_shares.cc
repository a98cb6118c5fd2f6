// SPDX-License-Identifier: Apache-2.0
#include "controllers/monitors/wheel_shares.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

// Whether all are told to turn about as fast as each other.
bool AreToldAlike(std::span<const double> told_radps) {
  constexpr double kAlike = 0.9;  // the slowest, of the fastest
  double least = std::abs(told_radps.front()), most = 0;
  for (const double told : told_radps) {
    least = std::min(least, std::abs(told));
    most = std::max(most, std::abs(told));
  }
  return least >= kAlike * most;
}

}  // namespace

void WheelShares::Start(const WheelShareParams& params, const RobotSpec& robot) {
  constexpr double kTurns = 0.2;  // of its speed at cruise
  params_ = params;
  wheels_.clear();
  for (const WheelSpec& wheel : robot.wheels)
    wheels_.push_back({kTurns * robot.cruise_mps / wheel.radius_m, true, 0, {}});
  scrub_ = std::ranges::none_of(robot.wheels,
                                [](const WheelSpec& wheel) { return wheel.roller_radius_m > 0; });
  shares_.assign(wheels_.size(), {});
  lean_.Reset();
  level_s_ = 0;
  turning_a_.reserve(wheels_.size());
}

int WheelShares::Odd(std::span<const WheelShare> shares) const {
  return static_cast<int>(std::ranges::count_if(
      shares, [&](const WheelShare& share) { return share && !Agrees(*share); }));
}

std::span<const WheelShare> WheelShares::Update(const MonitorReadings& now) {
  if (!now.power.heard || now.hinges.n > 0) return {};
  turning_a_.clear();
  const bool shared = !scrub_ || AreToldAlike(now.commanded_radps);
  for (std::size_t w = 0; w < wheels_.size(); ++w) {
    Wheel& wheel = wheels_[w];
    const double told = now.commanded_radps[w];
    const bool turns = shared && std::abs(told) > wheel.least_radps;
    wheel.turns_s = turns && (told > 0) == wheel.forward ? wheel.turns_s + now.dt_s : 0;
    wheel.forward = told > 0;
    shares_[w].reset();
    if (wheel.turns_s == 0) wheel.draws_a.Reset();
    if (!turns) continue;
    const double along_a = (told > 0 ? 1 : -1) * now.power.motor_a[w];
    const double mean_a = wheel.draws_a.Update(along_a, now.dt_s, params_.mean_s);
    if (wheel.turns_s <= params_.mean_s) continue;
    shares_[w] = mean_a;
    turning_a_.push_back(mean_a);
  }
  const bool leans = lean_.Update(now) > params_.most_lean_deg * kPi / 180;
  level_s_ = leans ? 0 : level_s_ + now.dt_s;
  constexpr std::size_t kFewest = 4;
  constexpr double kForgets = 3;  // means, until what it drew on an edge is out of them
  if (turning_a_.size() < kFewest || level_s_ < kForgets * params_.mean_s) return {};
  const auto middle = turning_a_.begin() + static_cast<std::ptrdiff_t>(turning_a_.size() / 2);
  std::ranges::nth_element(turning_a_, middle);
  if (*middle < params_.least_a) return {};
  for (WheelShare& share : shares_)
    if (share) *share /= *middle;
  return shares_;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/online_navigator.h"

#include <algorithm>

namespace floorproof {
namespace {

constexpr double kLook_s = 1;  // at the start the robot stands for some turns of its lidar
constexpr double kAskAhead_m =
    0.5;  // more than it needs to brake, and than its tracker looks ahead
constexpr double kSamePlace_m = 1e-3;
constexpr int kMostVain = 100;  // targets where the robot is, in a row

}  // namespace

OnlineNavigator::OnlineNavigator(OnlinePlanner& planner, const Robot& robot, const Vec2& start_W,
                                 std::uint64_t seed)
    : planner_(planner), robot_(robot), seed_(seed), path_{At(start_W)} {
  changed_.reserve(4096);
}

Waypoint OnlineNavigator::At(const Vec2& p_W) const {
  Waypoint at;
  at.p_W = p_W;
  at.yaw_rad = robot_.yaw_rad;
  at.speed_mps = planner_.params().speed_mps.value_or(0);
  return at;
}

bool OnlineNavigator::HasLooked(const NavigatorInput& input) {
  if (!since_s_) since_s_ = input.t_s;
  return input.t_s - *since_s_ >= kLook_s;
}

PathChange OnlineNavigator::Update(const NavigatorInput& input) {
  const std::vector<Cell>& changed = *input.known->changed;
  changed_.insert(changed_.end(), changed.begin(), changed.end());
  if (!started_) {
    if (!HasLooked(input)) return PathChange::kNone;
    started_ = true;
    planner_.Start({input.known->frame, input.estimate.X_WB, robot_.clear, robot_.tool,
                    robot_.tool_width_m, seed_});
    driven_ = {At(input.estimate.X_WB.p())};
  } else if (!input.recovered && (leads_ != Leads::kOn || !input.at_end)) {
    return leads_ == Leads::kOn ? GoOn(input) : PathChange::kNone;
  }
  // From where it stands.
  path_ = {At(input.estimate.X_WB.p())};
  Ask(input, input.estimate);
  asked_from_ = 0;
  return PathChange::kAnew;
}

// Asks for the next target once the robot is near the last one.
PathChange OnlineNavigator::GoOn(const NavigatorInput& input) {
  if (input.segment + 2 < path_.size()) return PathChange::kNone;
  const Vec2 last_W = path_.back().p_W;
  if ((last_W - input.estimate.X_WB.p()).norm() > kAskAhead_m) return PathChange::kNone;
  Estimate there = input.estimate;
  there.X_WB.x_m = last_W.x();
  there.X_WB.y_m = last_W.y();
  const std::size_t from = path_.size() - 1;
  if (!Ask(input, there)) return PathChange::kNone;
  path_.erase(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(input.segment));
  asked_from_ = from - input.segment;
  return PathChange::kLonger;
}

// Whether there is a new target.
bool OnlineNavigator::Ask(const NavigatorInput& input, const Estimate& at) {
  const OnlineStep next = planner_.Next(
      {*input.known, changed_, at, input.recovered && !input.met_drop,
       input.recovered && input.met_drop, input.recovered && input.segment < asked_from_});
  changed_.clear();
  const bool first = driven_.size() == 1;
  switch (next.kind) {
    case OnlineStep::Kind::kTarget:
      leads_ = Leads::kOn;
      if ((next.target_W - path_.back().p_W).norm() < kSamePlace_m) {
        if (++vain_ < kMostVain) return false;
        leads_ = Leads::kNowhere;
        why_ = "its planner goes for the place where the robot is";
        return false;
      }
      vain_ = 0;
      path_.push_back(At(next.target_W));
      driven_.push_back(path_.back());
      return true;
    case OnlineStep::Kind::kDone:
      leads_ = Leads::kToEnd;
      break;
    case OnlineStep::Kind::kNowhere:
      leads_ = first ? Leads::kNowhere : Leads::kToEnd;
      break;
  }
  why_ = next.why;
  return false;
}

void OnlineNavigator::GoOnFrom(std::size_t waypoint) {
  path_.erase(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(waypoint));
  asked_from_ -= std::min(asked_from_, waypoint);
}

}  // namespace floorproof

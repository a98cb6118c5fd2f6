// SPDX-License-Identifier: Apache-2.0
#include "run/episode/online_navigator.h"

#include <algorithm>
#include <cmath>

#include "controllers/follower_params.h"

namespace floorproof {
namespace {

constexpr double kLook_s = 1;  // at the start the robot stands for some turns of its lidar
constexpr double kAskAhead_m =
    0.5;  // more than it needs to brake, and than its tracker looks ahead
constexpr double kSamePlace_m = 1e-3;
constexpr double kCut_m = 0.1;      // of room around the place of a bend that is driven through
constexpr double kGraze_m = 0.005;  // so deep into the body, what is seen may be noise
constexpr double kStands_m = 0.02;  // a way that needs no braking
constexpr int kMostVain = 100;      // targets where the robot is, in a row

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
                    robot_.tool_width_m, seed_, robot_.body});
    driven_ = {At(input.estimate.X_WB.p())};
  } else if (!input.recovered) {
    if (IsBlocked(input)) return StopAhead(input);
    if (!input.at_end || leads_ != Leads::kOn) return GoOn(input);
  }
  return FromHere(input, false);
}

PathChange OnlineNavigator::FromHere(const NavigatorInput& input, bool stopped) {
  const std::size_t reached = input.at_end ? path_.size() - 1 : input.segment;
  LeaveOut(path_.size() - 1 - reached);
  path_ = {At(input.estimate.X_WB.p())};
  if ((path_.back().p_W - driven_.back().p_W).norm() > kStands_m) driven_.push_back(path_.back());
  Ask(input, reached, stopped);
  return PathChange::kAnew;
}

// The last targets were not reached: what was driven ends elsewhere.
void OnlineNavigator::LeaveOut(std::size_t targets) {
  driven_.resize(driven_.size() - std::min(targets, driven_.size() - 1));
}

// Asks for the next target once the robot is near the last one; looks after the bends ahead.
PathChange OnlineNavigator::GoOn(const NavigatorInput& input) {
  const Vec2 left_W = path_.back().p_W - input.estimate.X_WB.p();
  const bool longer = leads_ == Leads::kOn && input.segment + 2 >= path_.size() &&
                      left_W.norm() <= kAskAhead_m && Ask(input, asked_from_, false);
  if (!longer && input.known->changed->empty()) return PathChange::kNone;
  if (!StopAtNarrowBends(*input.known, input.segment) && !longer) return PathChange::kNone;
  GoOnFrom(input.segment);
  return PathChange::kLonger;
}

// Its way leads elsewhere from where it can have come to rest.
PathChange OnlineNavigator::StopAhead(const NavigatorInput& input) {
  const BodyTwist& v = input.estimate.V_WB_B;
  const double speed_mps = std::hypot(v.vx_mps, v.vy_mps);
  double left_m = speed_mps * (kWheelLag_s + speed_mps / (2 * std::max(robot_.brakes_mps2, 1e-3)));
  if (input.at_end || left_m < kStands_m) return FromHere(input, true);
  Vec2 stop_W = input.estimate.X_WB.p();
  std::size_t next = input.segment + 1;
  for (; next < path_.size(); ++next) {
    const Vec2 way_W = path_[next].p_W - stop_W;
    if (way_W.norm() > left_m) {
      stop_W += way_W.normalized() * left_m;
      break;
    }
    left_m -= way_W.norm();
    stop_W = path_[next].p_W;
  }
  if (next < path_.size()) {
    LeaveOut(path_.size() - next);
    path_.resize(next);
    path_.push_back(At(stop_W));
    driven_.push_back(path_.back());
  }
  path_.back().stops = true;
  Ask(input, next - 1, true);
  StopAtNarrowBends(*input.known, input.segment);
  GoOnFrom(input.segment);
  return PathChange::kLonger;
}

// Asks for a target behind the end of the path; whether there is one. `reached`: the last waypoint
// of the path that the planner knew to which the robot comes.
bool OnlineNavigator::Ask(const NavigatorInput& input, std::size_t reached, bool stopped) {
  Estimate there = input.estimate;
  there.X_WB.x_m = path_.back().p_W.x();
  there.X_WB.y_m = path_.back().p_W.y();
  const OnlineStep next =
      planner_.Next({*input.known, changed_, there, input.recovered && !input.met_drop,
                     input.recovered && input.met_drop, reached < asked_from_, stopped});
  changed_.clear();
  asked_from_ = path_.size() - 1;
  switch (next.kind) {
    case OnlineStep::Kind::kTarget:
      leads_ = Leads::kOn;
      any_target_ = true;
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
      leads_ = any_target_ ? Leads::kToEnd : Leads::kNowhere;
      break;
  }
  why_ = next.why;
  return false;
}

// Whether that changes any.
bool OnlineNavigator::StopAtNarrowBends(const KnownMap& known, std::size_t segment) {
  bool any = false;
  for (std::size_t i = segment + 1; i + 1 < path_.size(); ++i) {
    if (path_[i].stops || !IsNarrow(known, path_[i].p_W)) continue;
    path_[i].stops = any = true;
  }
  return any;
}

// Whether a bend there must not be cut.
bool OnlineNavigator::IsNarrow(const KnownMap& known, const Vec2& p_W) const {
  const Extent near = robot_.clear.Wider(kCut_m) / known.frame.cell_m;
  const Vec2 middle = known.frame.X_WG.Inverse() * p_W / known.frame.cell_m - Vec2(0.5, 0.5);
  const Vec2 low = middle - near.Reach(), high = middle + near.Reach();
  for (int iy = static_cast<int>(std::ceil(low.y())); iy <= high.y(); ++iy)
    for (int ix = static_cast<int>(std::ceil(low.x())); ix <= high.x(); ++ix)
      if (!known.frame.Inside({ix, iy}) ||
          (near.Holds(Vec2(ix, iy) - middle) && known.At(ix, iy) == CellState::kOccupied))
        return true;
  return false;
}

// Whether something has come into sight that the body would meet on its way, and does not touch
// where it is.
bool OnlineNavigator::IsBlocked(const NavigatorInput& input) const {
  const KnownMap& known = *input.known;
  const double cell_m = known.frame.cell_m;
  const Extent met = robot_.body.Wider(cell_m / 2 - kGraze_m) / cell_m;
  const Pose2 X_GW = known.frame.X_WG.Inverse();
  const auto on_grid = [&](const Vec2& p_W) -> Vec2 { return X_GW * p_W / cell_m; };
  const Vec2 here = on_grid(input.estimate.X_WB.p());
  for (const Cell& c : *known.changed) {
    if (known.At(c) != CellState::kOccupied) continue;
    const Vec2 p = Vec2(c.ix + 0.5, c.iy + 0.5);
    if (met.Holds(p - here)) continue;
    Vec2 from = here;
    for (std::size_t i = input.segment + 1; i < path_.size(); ++i) {
      const Vec2 to = on_grid(path_[i].p_W);
      if (met.PassesOver(p - from, to - from)) return true;
      from = to;
    }
  }
  return false;
}

void OnlineNavigator::GoOnFrom(std::size_t waypoint) {
  path_.erase(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(waypoint));
  asked_from_ -= std::min(asked_from_, waypoint);
}

}  // namespace floorproof

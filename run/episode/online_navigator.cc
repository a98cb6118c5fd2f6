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
constexpr double kApart_m = 0.002;  // so near to the body, what is known will be touched
constexpr double kAside_m = 0.01;   // so far from its path it has come off
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
    if (IsBlocked(input) || IsAstray(input)) return StopAhead(input);
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

double OnlineNavigator::BrakingDistance(const Estimate& estimate) const {
  const BodyTwist& v = estimate.V_WB_B;
  const double speed_mps = std::hypot(v.vx_mps, v.vy_mps);
  return speed_mps * (kWheelLag_s + speed_mps / (2 * std::max(robot_.brakes_mps2, 1e-3)));
}

// Its way leads elsewhere from where it can have come to rest.
PathChange OnlineNavigator::StopAhead(const NavigatorInput& input) {
  double left_m = BrakingDistance(input.estimate);
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
  const Vec2 middle = known.frame.ToGrid(p_W) / known.frame.cell_m - Vec2(0.5, 0.5);
  const Vec2 low = middle - near.Reach(), high = middle + near.Reach();
  for (int iy = static_cast<int>(std::ceil(low.y())); iy <= high.y(); ++iy)
    for (int ix = static_cast<int>(std::ceil(low.x())); ix <= high.x(); ++ix)
      if (!known.frame.Inside({ix, iy}) ||
          (near.Holds(Vec2(ix, iy) - middle) && known.At(ix, iy) == CellState::kOccupied))
        return true;
  return false;
}

// From there to the next waypoint, and on along the path.
void OnlineNavigator::LayOnGrid(const NavigatorInput& input, const Vec2& from_W) {
  const GridFrame& grid = input.known->frame;
  const Pose2 X_GW = grid.X_WG.Inverse();
  on_grid_.clear();
  on_grid_.push_back(X_GW * from_W / grid.cell_m);
  for (std::size_t i = input.segment + 1; i < path_.size(); ++i)
    on_grid_.push_back(X_GW * path_[i].p_W / grid.cell_m);
}

bool OnlineNavigator::PassesOver(Cell c, const Extent& body, double slack) const {
  const Vec2 middle(c.ix + 0.5, c.iy + 0.5);
  for (std::size_t i = 0; i + 1 < on_grid_.size(); ++i)
    if (body.PassesOverSquare(middle - on_grid_[i], 0.5, on_grid_[i + 1] - on_grid_[i], slack))
      return true;
  return false;
}

// Whether something has come into sight that the body would meet on its way, and does not touch
// where it is.
bool OnlineNavigator::IsBlocked(const NavigatorInput& input) {
  const KnownMap& known = *input.known;
  if (known.changed->empty()) return false;
  LayOnGrid(input, input.estimate.X_WB.p());
  const Extent body = robot_.body / known.frame.cell_m;
  const double slack = kGraze_m / known.frame.cell_m;
  return std::ranges::any_of(*known.changed, [&](Cell c) {
    return known.At(c) == CellState::kOccupied &&
           !body.HoldsPartOf(Vec2(c.ix + 0.5, c.iy + 0.5) - on_grid_[0], 0.5, slack) &&
           PassesOver(c, body, slack);
  });
}

// Whether the robot, which does not follow its path to the millimetre, is about to touch what lies
// beside the path, before its next waypoint; unless it stops there anyway.
bool OnlineNavigator::IsAstray(const NavigatorInput& input) {
  if (input.segment + 1 >= path_.size()) return false;
  const KnownMap& known = *input.known;
  const Pose2& X_WB = input.estimate.X_WB;
  const Waypoint& next = path_[input.segment + 1];
  const double ahead_m = BrakingDistance(input.estimate);
  const Vec2 left_W = next.p_W - X_WB.p(), leg_W = next.p_W - path_[input.segment].p_W;
  const double aside_m = std::abs(Cross(left_W, leg_W)) / std::max(leg_W.norm(), kSamePlace_m);
  if (ahead_m < kStands_m || aside_m < kAside_m) return false;
  if (next.stops && left_W.norm() < ahead_m + kStands_m) return false;
  const BodyTwist& v = input.estimate.V_WB_B;
  const Vec2 way_W = X_WB.Rotate(Vec2(v.vx_mps, v.vy_mps)).normalized() *
                     std::min(ahead_m + kStands_m, left_W.norm());
  LayOnGrid(input, path_[input.segment].p_W);
  const double cell_m = known.frame.cell_m;
  const Pose2 X_GW = known.frame.X_WG.Inverse();
  const Vec2 here = X_GW * X_WB.p() / cell_m, way = X_GW.Rotate(way_W) / cell_m;
  const Extent body = robot_.body / cell_m;
  const double slack = -kApart_m / cell_m;
  const Cell at = known.frame.ToCell(X_WB.p());
  const int reach = static_cast<int>(body.Reach().maxCoeff() + way.norm()) + 1;
  for (int iy = at.iy - reach; iy <= at.iy + reach; ++iy)
    for (int ix = at.ix - reach; ix <= at.ix + reach; ++ix) {
      const Cell c = {ix, iy};
      const Vec2 by = Vec2(ix + 0.5, iy + 0.5) - here;
      if (known.frame.Inside(c) && known.At(c) == CellState::kOccupied &&
          body.PassesOverSquare(by, 0.5, way, slack) && !body.HoldsPartOf(by, 0.5, slack) &&
          !PassesOver(c, body, slack))
        return true;
    }
  return false;
}

void OnlineNavigator::GoOnFrom(std::size_t waypoint) {
  path_.erase(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(waypoint));
  asked_from_ -= std::min(asked_from_, waypoint);
}

}  // namespace floorproof

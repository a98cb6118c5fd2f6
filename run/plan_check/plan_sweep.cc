// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/plan_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "controllers/drive.h"
#include "controllers/reconfiguration.h"
#include "env/geometry/convex.h"

namespace floorproof {
namespace {

constexpr double kPiece_m = 0.25;
constexpr double kTurn_rad = 3 * kPi / 180, kFold_rad = 5 * kPi / 180;
constexpr double kSamePoint_m = 1e-6;
constexpr double kRound = 0.998;  // a polygon of 72 corners is round

class Sweeper {
 public:
  Sweeper(const RobotModel& robot, const Pose2& start,
          const std::function<void(const SweptPiece&)>& visit)
      : robot_(robot.spec),
        holonomic_(IsHolonomic(robot_)),
        visit_(visit),
        X_WB_(start),
        shape_(robot_.shape),
        outline_B_(robot_.outline_B) {
    if (!robot_.hinges.empty()) Stand(StartState(robot_));
    FindRound();
  }

  void Drive(const Path& path) {
    X_WB_ = {path.front().p_W.x(), path.front().p_W.y(), X_WB_.yaw_rad};
    Fold(path.front().shape);
    Visit({}, 0);
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Waypoint& to = path[i];
      Fold(to.shape);
      const Vec2 way = to.p_W - X_WB_.p();
      const bool stays = way.norm() < kSamePoint_m;
      if (holonomic_ && to.yaw_rad)
        Turn(*to.yaw_rad);
      else if (!stays)
        Turn(std::atan2(way.y(), way.x()));
      if (!stays) Straight(to.p_W);
    }
  }

 private:
  void Stand(const HingeState& hinges) {
    const BlockMotions blocks = MoveBlocks(robot_.blocks, robot_.hinges, hinges);
    outline_B_.clear();
    for (std::size_t k = 0; k < robot_.blocks.size(); ++k)
      outline_B_.push_back(InFrame(blocks.block[k].X_BK, robot_.blocks[k].outline_K));
  }

  // Round about its centre, it sweeps nothing by turning.
  void FindRound() {
    double most_m = 0;
    for (const Polygon& part : outline_B_)
      for (const Vec2& p : part) most_m = std::max(most_m, p.norm());
    round_ = std::ranges::any_of(outline_B_, [&](const Polygon& part) {
      return -SignedDistance(part, Vec2::Zero()) > kRound * most_m;
    });
  }

  static Polygon InFrame(const Pose2& X, Polygon polygon) {
    for (Vec2& p : polygon) p = X * p;
    return polygon;
  }

  void Turn(double to_rad) {
    const double from_rad = X_WB_.yaw_rad, by_rad = WrapAngle(to_rad - from_rad);
    const auto n = static_cast<int>(std::ceil(std::abs(by_rad) / kTurn_rad));
    for (int k = 1; k < n && !round_; ++k) {
      X_WB_.yaw_rad = WrapAngle(from_rad + by_rad * k / n);
      Visit({}, 0);
    }
    X_WB_.yaw_rad = to_rad;
  }

  void Fold(const std::string& name) {
    if (name.empty() || robot_.hinges.empty()) return;
    const int next = FindShape(robot_, name);
    if (next < 0 || next == shape_) return;
    const auto& shapes = robot_.shapes;
    const HingeWay way = FoldingWay(robot_, shapes[static_cast<std::size_t>(shape_)].hinge_rad,
                                    shapes[static_cast<std::size_t>(next)].hinge_rad);
    for (std::size_t leg = 0; leg + 1 < way.size(); ++leg) {
      double most_rad = 0;
      for (std::size_t h = 0; h < way[leg].size(); ++h)
        most_rad = std::max(most_rad, std::abs(way[leg + 1][h] - way[leg][h]));
      const auto n = static_cast<int>(std::ceil(most_rad / kFold_rad));
      for (int k = 1; k <= n; ++k) {
        std::vector<double> at_rad = way[leg];
        for (std::size_t h = 0; h < at_rad.size(); ++h)
          at_rad[h] += (way[leg + 1][h] - way[leg][h]) * k / n;
        Stand(AtRest(at_rad));
        Visit({}, 0);
      }
    }
    shape_ = next;
    FindRound();
  }

  void Straight(const Vec2& to_W) {
    const Vec2 from_W = X_WB_.p(), way = to_W - from_W;
    const double length_m = way.norm();
    const auto n = static_cast<int>(std::ceil(length_m / kPiece_m));
    for (int k = 0; k < n; ++k) {
      const Vec2 at_W = from_W + way * k / n;
      X_WB_.x_m = at_W.x(), X_WB_.y_m = at_W.y();
      Visit(way / n, length_m / n);
    }
    X_WB_.x_m = to_W.x(), X_WB_.y_m = to_W.y();
  }

  void Visit(const Vec2& by_W, double length_m) {
    parts_W_.clear();
    begin_W_.clear();
    double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
    const Vec2 direction_W = length_m > 0 ? Vec2(by_W / length_m) : Vec2(Vec2::Zero());
    for (const Polygon& part_B : outline_B_) {
      Polygon part_W = InFrame(X_WB_, part_B);
      for (const Vec2& p : part_W) {
        low_m = std::min(low_m, Cross(direction_W, p));
        high_m = std::max(high_m, Cross(direction_W, p));
      }
      parts_W_.push_back(length_m > 0 ? SweptBy(part_W, by_W) : part_W);
      begin_W_.push_back(std::move(part_W));
    }
    visit_({parts_W_, begin_W_, X_WB_, along_m_, length_m, direction_W, high_m - low_m});
    along_m_ += length_m;
  }

  const RobotSpec& robot_;
  bool holonomic_;
  const std::function<void(const SweptPiece&)>& visit_;
  Pose2 X_WB_;
  int shape_;
  std::vector<Polygon> outline_B_;
  bool round_ = false;
  std::vector<Polygon> parts_W_, begin_W_;
  double along_m_ = 0;
};

}  // namespace

void SweepPlan(const RobotModel& robot, const Pose2& start, const Path& path,
               const std::function<void(const SweptPiece&)>& visit) {
  if (!path.empty()) Sweeper(robot, start, visit).Drive(path);
}

}  // namespace floorproof

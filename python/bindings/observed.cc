// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/observed.h"

#include <algorithm>
#include <cmath>

#include "run/episode/robot_side.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

// A number that is none lies in the middle.
float Within(double value, float low, float high) {
  return std::isnan(value) ? 0.5f * (low + high) : std::clamp(static_cast<float>(value), low, high);
}

}  // namespace

Observed::Observed(const Scenario& s, const Outlook& outlook)
    : local(s.world, outlook.local_cells, outlook.local_cell_m), outlook_(outlook) {}

void Observed::Begin(const Scenario& s, SteppedEpisode& episode, bool follows,
                     const SpaceBounds* spaces) {
  const LidarScan& scan = episode.view().sensed.scan;
  const SpaceBounds own = SpaceBoundsOf(s, scan);
  if (spaces != nullptr) {
    RequireSameShape(s.spec, own, *spaces);
    lacks = spaces->Lacks(own);
  }
  bounds = spaces != nullptr ? *spaces : own;
  scan_most_m_ = std::min(own.lidar_m, bounds.lidar_m);
  lidar.resize(scan.range_m.size());
  ahead.resize(follows ? 2 * (1 + static_cast<std::size_t>(outlook_.plan_points)) : 0);
}

void Observed::Look(SteppedEpisode& episode, const std::optional<Vec2>& target_W) {
  const EpisodeView now = episode.view();
  const Pose2& X_WB = now.estimate.X_WB;
  const BodyTwist& V = now.estimate.V_WB_B;
  const LidarScan& scan = now.sensed.scan;
  for (std::size_t i = 0; i < lidar.size(); ++i)
    lidar[i] = Within(scan.range_m[i], 0, scan_most_m_);
  const auto &low = bounds.low, &high = bounds.high;
  pose = {Within(X_WB.x_m, low[0], high[0]), Within(X_WB.y_m, low[1], high[1]),
          Within(std::cos(X_WB.yaw_rad), -1, 1), Within(std::sin(X_WB.yaw_rad), -1, 1)};
  const std::array<float, 3>& fastest = bounds.fastest;
  twist = {Within(V.vx_mps, -fastest[0], fastest[0]), Within(V.vy_mps, -fastest[1], fastest[1]),
           Within(V.wz_radps, -fastest[2], fastest[2])};
  coverage = static_cast<float>(now.coverage);
  const Pose2 truth = now.sample.X_WB();
  state = {now.sample.t_s, now.coverage, truth.x_m, truth.y_m, truth.yaw_rad};
  local.Look(X_WB, episode.robot().known());
  if (!ahead.empty()) LookAhead(episode.robot(), X_WB, target_W);
}

// The target, then the points of the path ahead of where it thinks that it is, in its own frame;
// beyond the end the end.
void Observed::LookAhead(const RobotSide& robot, const Pose2& X_WB,
                         const std::optional<Vec2>& target_W) {
  const Path& path = robot.path();
  std::size_t i = std::min(robot.command().segment, path.size() < 2 ? 0 : path.size() - 2);
  const Vec2 &a = path[i].p_W, &b = path[std::min(i + 1, path.size() - 1)].p_W;
  Vec2 at_W = a + NearestFraction(a, b, X_WB.p()) * (b - a);
  const Pose2 X_BW = X_WB.Inverse();
  const float far_m = bounds.plan_m;
  const auto tell = [&](std::size_t k, const Vec2& p_W) {
    const Vec2 p_B = X_BW * p_W;
    ahead[2 * k] = Within(p_B.x(), -far_m, far_m);
    ahead[2 * k + 1] = Within(p_B.y(), -far_m, far_m);
  };
  for (std::size_t k = 1; 2 * k < ahead.size(); ++k) {
    double left_m = outlook_.plan_step_m;
    while (i + 1 < path.size()) {
      const Vec2 way = path[i + 1].p_W - at_W;
      if (way.norm() > left_m) {
        at_W += left_m * way.normalized();
        break;
      }
      left_m -= way.norm();
      at_W = path[++i].p_W;
    }
    tell(k, at_W);
    if (k == 1 && !target_W) tell(0, at_W);
  }
  if (target_W) tell(0, *target_W);
}

}  // namespace floorproof

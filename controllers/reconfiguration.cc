// SPDX-License-Identifier: Apache-2.0
#include "controllers/reconfiguration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "env/geometry/polygon.h"

namespace floorproof {
namespace {

constexpr double kStep_rad = kPi / 12;
constexpr double kTouch_m = 0.004;       // blocks that stand side by side touch: not a collision
constexpr double kMaxRate_radps = 0.35;  // 180 degrees in some 10 s
constexpr double kAccel_radps2 = 0.35;
constexpr double kRateShare = 0.6;  // of the motors' no-load speed
constexpr double kGain_per_s = 5;   // feedback on a hinge's angle
constexpr double kLag_rad = 0.1;    // farther behind than this the reference waits
constexpr double kArrived_rad = 0.01;

using Node = std::vector<int>;  // steps of each hinge

std::vector<double> Angles(const Node& node) {
  std::vector<double> rad;
  for (const int step : node) rad.push_back(step * kStep_rad);
  return rad;
}

int Steps(const Node& a, const Node& b) {
  int steps = 0;
  for (std::size_t h = 0; h < a.size(); ++h) steps += std::abs(a[h] - b[h]);
  return steps;
}

// Keeps the ends, and where another hinge begins to turn.
HingeWay Bends(const std::vector<Node>& nodes) {
  HingeWay way = {Angles(nodes.front())};
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    bool straight = i + 1 < nodes.size();
    for (std::size_t h = 0; straight && h < nodes[i].size(); ++h)
      straight = nodes[i + 1][h] - nodes[i][h] == nodes[i][h] - nodes[i - 1][h];
    if (!straight) way.push_back(Angles(nodes[i]));
  }
  return way;
}

}  // namespace

bool BlocksCollide(const RobotSpec& robot, std::span<const double> hinge_rad) {
  const BlockMotions motions = MoveBlocks(robot.blocks, robot.hinges, AtRest(hinge_rad));
  std::vector<Polygon> shrunk;
  for (std::size_t k = 0; k < robot.blocks.size(); ++k) {
    Polygon outline;
    for (const Vec2& p_K : robot.blocks[k].outline_K) {
      const Vec2 inward = (robot.blocks[k].centre_K - p_K).normalized();
      outline.push_back(motions.block[k].X_BK * Vec2(p_K + kTouch_m * inward));
    }
    shrunk.push_back(std::move(outline));
  }
  // Convex outlines are apart when an edge of one has all of the other outside.
  const auto separates = [](const Polygon& a, const Polygon& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vec2 edge = a[(i + 1) % a.size()] - a[i];
      if (std::ranges::all_of(b, [&](const Vec2& p) { return Cross(edge, p - a[i]) < 0; }))
        return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < shrunk.size(); ++i)
    for (std::size_t j = i + 1; j < shrunk.size(); ++j)
      if (!separates(shrunk[i], shrunk[j]) && !separates(shrunk[j], shrunk[i])) return true;
  return false;
}

HingeWay FoldingWay(const RobotSpec& robot, std::span<const double> from_rad,
                    std::span<const double> to_rad) {
  const auto lattice = [](std::span<const double> rad) {
    Node node;
    for (const double angle : rad) node.push_back(static_cast<int>(std::lround(angle / kStep_rad)));
    return node;
  };
  const Node from = lattice(from_rad), to = lattice(to_rad);
  const auto allowed = [&](const Node& node) {
    for (std::size_t h = 0; h < node.size(); ++h) {
      const HingeSpec& hinge = robot.hinges[h];
      const double rad = node[h] * kStep_rad;
      if (rad < hinge.min_rad || rad > hinge.max_rad) return false;
    }
    return !BlocksCollide(robot, Angles(node));
  };
  // Ordered by cost, then by the node itself: the same way on every machine.
  using Entry = std::pair<int, Node>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::map<Node, std::pair<int, Node>> best;  // steps so far, and the node before
  best[from] = {0, from};
  open.emplace(Steps(from, to), from);
  while (!open.empty()) {
    const Node node = open.top().second;
    const int cost = open.top().first - Steps(node, to);
    open.pop();
    if (cost > best[node].first) continue;
    if (node == to) {
      std::vector<Node> nodes = {to};
      while (nodes.back() != from) nodes.push_back(best[nodes.back()].second);
      std::ranges::reverse(nodes);
      return Bends(nodes);
    }
    for (std::size_t h = 0; h < node.size(); ++h)
      for (const int by : {-1, 1}) {
        Node next = node;
        next[h] += by;
        const auto known = best.find(next);
        if (known != best.end() && known->second.first <= cost + 1) continue;
        if (next != to && !allowed(next)) continue;
        best[next] = {cost + 1, node};
        open.emplace(cost + 1 + Steps(next, to), next);
      }
  }
  return {};
}

void Reconfiguration::Start(const RobotSpec& robot) {
  n_ = static_cast<int>(robot.hinges.size());
  max_rate_radps_ = kMaxRate_radps;
  for (const HingeSpec& hinge : robot.hinges)
    max_rate_radps_ = std::min(max_rate_radps_, kRateShare * hinge.max_rate_radps);
  hold_rad_ = StartState(robot).rad;
  way_ = nullptr;
}

void Reconfiguration::Fold(const HingeWay& way) {
  way_ = &way;
  leg_ = 0;
  s_rad_ = v_radps_ = 0;
}

// The largest turn of a hinge on that leg.
double Reconfiguration::LegLength(const HingeWay& way, std::size_t leg) const {
  double length_rad = 0;
  for (std::size_t h = 0; h < static_cast<std::size_t>(n_); ++h)
    length_rad = std::max(length_rad, std::abs(way[leg + 1][h] - way[leg][h]));
  return length_rad;
}

double Reconfiguration::Duration(const HingeWay& way) const {
  double time_s = 0;
  for (std::size_t leg = 0; leg + 1 < way.size(); ++leg) {  // from rest to rest
    const double length_rad = LegLength(way, leg);
    const double top_radps = std::min(max_rate_radps_, std::sqrt(kAccel_radps2 * length_rad));
    if (length_rad > 0) time_s += length_rad / top_radps + top_radps / kAccel_radps2;
  }
  return time_s;
}

HingeState Reconfiguration::Update(const HingeState& now, double dt_s) {
  HingeState command;
  command.n = n_;
  double lag_rad = 0;
  for (std::size_t h = 0; h < static_cast<std::size_t>(n_); ++h)
    lag_rad = std::max(lag_rad, std::abs(hold_rad_[h] - now.rad[h]));

  double rate_radps = 0;
  if (way_ != nullptr && leg_ + 1 < way_->size()) {
    const double left_rad = LegLength(*way_, leg_) - s_rad_;
    const double stopping = std::sqrt(2 * kAccel_radps2 * std::max(0.0, left_rad));
    v_radps_ = lag_rad > kLag_rad ? 0.0
                                  : std::min({v_radps_ + kAccel_radps2 * dt_s, max_rate_radps_,
                                              std::max(stopping, kAccel_radps2 * dt_s)});
    const double by_rad = std::min(v_radps_ * dt_s, left_rad);
    rate_radps = by_rad / dt_s;
    s_rad_ += by_rad;
  } else if (lag_rad < kArrived_rad) {
    way_ = nullptr;
  }
  for (std::size_t h = 0; h < static_cast<std::size_t>(n_); ++h) {
    double forward_radps = 0;
    if (way_ != nullptr && leg_ + 1 < way_->size()) {
      const double from = (*way_)[leg_][h], turn = (*way_)[leg_ + 1][h] - from;
      hold_rad_[h] = from + turn * s_rad_ / LegLength(*way_, leg_);
      forward_radps = turn / LegLength(*way_, leg_) * rate_radps;
    }
    command.rad[h] = now.rad[h];
    command.radps[h] = std::clamp(forward_radps + kGain_per_s * (hold_rad_[h] - now.rad[h]),
                                  -2 * max_rate_radps_, 2 * max_rate_radps_);
  }
  if (way_ != nullptr && leg_ + 1 < way_->size() && s_rad_ >= LegLength(*way_, leg_) - 1e-12) {
    ++leg_;
    s_rad_ = v_radps_ = 0;
  }
  return command;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/legs.h"

#include <cmath>
#include <utility>

namespace floorproof {
namespace {

constexpr double kStraight_rad = 0.005;
constexpr double kSame_m = 1e-6;

bool Dwells(const Waypoint& w) { return w.dwell_s > 0 || w.task; }

}  // namespace

std::vector<Leg> LegsOf(const Path& path, const Pose2& start) {
  std::vector<Leg> legs(1);
  legs[0].from = start;
  for (const Waypoint& w : path) {
    const Vec2 last = legs.back().At(legs.back().length_m).p(), way = w.p_W - last;
    Leg& before = legs.back();
    if (way.norm() < kSame_m || before.ends.empty()) {
      before.ends.push_back(w);
      before.dwells |= Dwells(w);
      if (way.norm() < kSame_m) continue;
      before.ends.clear();
      before.dwells = false;
    }
    Leg leg;
    leg.from = {last.x(), last.y(), std::atan2(way.y(), way.x())};
    leg.length_m = way.norm();
    leg.ends = {w};
    leg.dwells = Dwells(w);
    const bool on = legs.size() > 1 && !before.dwells &&
                    before.ends.front().speed_mps == w.speed_mps &&
                    std::abs(WrapAngle(leg.from.yaw_rad - before.from.yaw_rad)) < kStraight_rad;
    if (!on) {
      legs.push_back(std::move(leg));
      continue;
    }
    const Vec2 whole = w.p_W - before.from.p();
    before.from.yaw_rad = std::atan2(whole.y(), whole.x());
    before.length_m = whole.norm();
    before.ends = std::move(leg.ends);
    before.dwells = leg.dwells;
  }
  return legs;
}

}  // namespace floorproof

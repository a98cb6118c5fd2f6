// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/turn_curves.h"

#include <algorithm>
#include <cmath>

#include "planners/lines/leg_choice.h"

namespace floorproof {
namespace {

constexpr double kSame_m = 1e-6;
constexpr double kPiece_rad = 0.15;  // an arc's waypoints are so far apart

Waypoint WaypointAt(const Vec2& p_W, double speed_mps) {
  Waypoint w;
  w.p_W = p_W;
  w.speed_mps = speed_mps;
  return w;
}

// The waypoints of a curve behind its beginning.
void Add(const DubinsCurve& curve, double speed_mps, Path& path) {
  double before_m = 0;
  for (std::size_t k = 0; k < curve.turns.size(); ++k) {
    const double length_m = curve.length_m[k];
    if (length_m > kSame_m) {
      const double turn_rad = curve.turns[k] == 0 ? 0 : length_m / curve.radius_m;
      const int n = std::max(1, static_cast<int>(std::ceil(turn_rad / kPiece_rad)));
      for (int i = 1; i <= n; ++i) {
        const Vec2 p_W = curve.At(before_m + length_m * i / n).p();
        if ((p_W - path.back().p_W).norm() > kSame_m) path.push_back(WaypointAt(p_W, speed_mps));
      }
    }
    before_m += length_m;
  }
}

void CountLeftOut(const std::vector<Leg>& legs, const std::vector<JoinedLeg>& driven, double lane_m,
                  TurnedPath& out) {
  auto next = driven.begin();
  for (std::size_t i = 1; i < legs.size(); ++i) {
    const bool lane = legs[i].length_m > lane_m;
    out.lanes += lane;
    if (next != driven.end() && next->leg == i) {
      ++next;
      continue;
    }
    out.stops_left_out += legs[i].dwells;
    out.left_out += lane;
    if (lane) out.left_out_m += legs[i].length_m;
  }
}

}  // namespace

TurnedPath WithTurns(const Path& path, const TurnRequest& request) {
  const std::vector<Leg> legs = LegsOf(path, request.start);
  const std::vector<JoinedLeg> driven = ChooseLegs(legs, request);
  TurnedPath out;
  CountLeftOut(legs, driven, request.lane_m, out);
  if (driven.empty()) return out;
  out.path = legs[0].ends;
  if (out.path.empty()) out.path.push_back(WaypointAt(request.start.p(), 0));
  for (const auto& [index, curve, begin_m, end_m] : driven) {
    const Leg& leg = legs[index];
    const double speed_mps = leg.ends.front().speed_mps;
    Add(curve, speed_mps, out.path);
    if (end_m > leg.length_m - kSame_m)
      out.path.insert(out.path.end(), leg.ends.begin(), leg.ends.end());
    else if (end_m > begin_m + kSame_m)
      out.path.push_back(WaypointAt(leg.At(end_m).p(), speed_mps));
  }
  return out;
}

}  // namespace floorproof

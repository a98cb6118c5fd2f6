// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/passage_speeds.h"

#include <algorithm>

namespace floorproof {
namespace {

constexpr double kWorthIt = 1e-4;  // of a rate that is saved
constexpr double kSame_m = 1e-3;

// A part of the way that is driven at one speed.
struct Stretch {
  double from_m = 0, to_m = 0, speed_mps = 0;  // 0: the path's own
  std::vector<const PlannedPassage*> met;
};

double RunUp(const RobotSpec& robot) {
  constexpr double kMore_m = 0.05;
  const double v = robot.max_speed_mps, a = robot.max_accel_mps2;
  return kMore_m + (a > 0 ? v * v / (2 * a) : 0);
}

std::vector<Stretch> Together(const std::vector<PlannedPassage>& passages, double run_up_m) {
  std::vector<Stretch> stretches;
  for (const PlannedPassage& passage : passages) {
    const double from_m = passage.from_m - run_up_m;
    if (stretches.empty() || from_m > stretches.back().to_m)
      stretches.push_back({from_m, passage.to_m, 0, {}});
    stretches.back().to_m = std::max(stretches.back().to_m, passage.to_m);
    stretches.back().met.push_back(&passage);
  }
  return stretches;
}

double BestSpeed(const Stretch& stretch, const PlanRequest& request, const PathRates& rates) {
  const auto hazard = [&](const PlannedPassage* passage) -> const Hazard& {
    return request.map.hazards[static_cast<std::size_t>(passage->hazard)];
  };
  std::vector<double> speeds;
  for (const PlannedPassage* passage : stretch.met)
    for (const double speed : rates.Speeds(hazard(passage), passage->passage))
      speeds.push_back(speed);
  std::ranges::sort(speeds);
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  const auto sum = [&](double speed_mps) {  // 0: as planned
    double rate = 0;
    for (const PlannedPassage* passage : stretch.met) {
      Approach at = passage->at;
      if (speed_mps > 0) at.speed_mps = speed_mps;
      rate += rates.Expected(hazard(passage), passage->passage, at, TravelOf(*passage)).value_or(0);
    }
    return rate;
  };
  double best = 0, least = sum(0) - kWorthIt;
  for (const double speed : speeds)
    if (const double rate = sum(speed); rate < least) best = speed, least = rate;
  return best;
}

}  // namespace

Path AtBestSpeeds(const Path& path, const PlanRequest& request, const PathRates& rates) {
  const std::vector<PlannedPassage> passages = rates.Passages(path);
  std::vector<Stretch> stretches = Together(passages, RunUp(request.robot));
  for (Stretch& stretch : stretches) stretch.speed_mps = BestSpeed(stretch, request, rates);
  std::erase_if(stretches, [](const Stretch& stretch) { return stretch.speed_mps == 0; });
  if (stretches.empty()) return path;

  Path out = {path.front()};
  double along_m = 0;
  std::size_t s = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 from = path[i - 1].p_W, way = path[i].p_W - from;
    const double length_m = way.norm(), end_m = along_m + length_m;
    // A leg up to this place of the way, at this speed; all that it asks for holds, but what is to
    // be done at its end.
    const auto cut = [&](double at_m, double speed_mps) {
      Waypoint part;
      part.p_W = from + (at_m - along_m) / length_m * way;
      part.yaw_rad = path[i].yaw_rad;
      part.shape = path[i].shape;
      part.speed_mps = speed_mps;
      out.push_back(part);
    };
    double speed_mps = path[i].speed_mps;
    while (s < stretches.size() && stretches[s].from_m < end_m - kSame_m) {
      const Stretch& stretch = stretches[s];
      if (stretch.from_m > along_m + kSame_m) cut(stretch.from_m, path[i].speed_mps);
      if (stretch.to_m > end_m - kSame_m) {
        speed_mps = stretch.speed_mps;
        if (stretch.to_m <= end_m + kSame_m) ++s;
        break;
      }
      if (stretch.to_m > along_m + kSame_m) cut(stretch.to_m, stretch.speed_mps);
      ++s;
    }
    Waypoint last = path[i];
    last.speed_mps = speed_mps;
    out.push_back(last);
    along_m = end_m;
  }
  return out;
}

}  // namespace floorproof

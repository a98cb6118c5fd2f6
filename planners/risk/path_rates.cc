// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/path_rates.h"

#include <algorithm>
#include <map>
#include <utility>

#include "planners/risk/terrain_yaw.h"

namespace floorproof {
namespace {

constexpr double kSpeedShares[] = {kLeastMeasuredSpeed, 0.4, 0.6, 0.8, 1};  // of the top speed

Approach In(const DriveConditions& conditions, Approach at) {
  at.friction = conditions.friction;
  at.mass_kg = conditions.mass_kg;
  at.clearance_m = conditions.clearance_m;
  return at;
}

// Way in one passage or in several at a time.
double Covered(const std::vector<PlannedPassage>& passages) {
  std::vector<std::pair<double, double>> spans;
  for (const PlannedPassage& passage : passages) spans.emplace_back(passage.from_m, passage.to_m);
  std::ranges::sort(spans);
  double covered_m = 0, to_m = 0;
  for (const auto& [from_m, end_m] : spans) {
    covered_m += std::max(0.0, end_m - std::max(from_m, to_m));
    to_m = std::max(to_m, end_m);
  }
  return covered_m;
}

}  // namespace

PathRates::PathRates(const PlanRequest& request)
    : request_(request),
      conditions_(request.conditions.begin(), request.conditions.end()),
      rates_(*request.model) {
  const RobotSpec& robot = request.robot;
  if (conditions_.empty())
    conditions_ = {{request.map.floor_friction, robot.mass_kg, robot.clearance_m}};
}

std::optional<double> PathRates::Expected(const Hazard& hazard, Passage passage, Approach at,
                                          const Vec2& travel_W) const {
  const RateEvaluator* rates = rates_.Find(hazard.type, passage, at);
  if (rates == nullptr) return std::nullopt;
  Covariates covariates(rates->kind().axes, rates_.model().mirrored, SizeAsMet(hazard, travel_W));
  double sum = 0;
  for (const DriveConditions& conditions : conditions_)
    sum += Total(rates->At(covariates.Of(In(conditions, at))));
  return sum / static_cast<double>(conditions_.size());
}

std::vector<double> PathRates::Speeds(const Hazard& hazard, Passage passage) const {
  std::vector<double> speeds;
  const RateEvaluator* rates = rates_.Find(hazard.type, passage, {});
  if (rates == nullptr) return speeds;
  const auto axis = std::ranges::find(rates->kind().axes, "speed_mps", &RateAxis::name);
  if (axis == rates->kind().axes.end()) return speeds;
  for (const double share : kSpeedShares) {
    const double speed_mps = share * request_.robot.max_speed_mps;
    if (speed_mps >= axis->lower && speed_mps <= axis->upper) speeds.push_back(speed_mps);
  }
  return speeds;
}

std::vector<PlannedPassage> PathRates::Passages(const Path& path) const {
  const bool holds_yaw = HoldsYaw(request_.robot);
  std::vector<PlannedPassage> passages =
      FindPassages(request_.map, request_.robot, request_.start, path, holds_yaw);
  std::erase_if(passages, [&](const PlannedPassage& passage) {
    return !IsOfTheSite(request_.map.hazards[static_cast<std::size_t>(passage.hazard)]);
  });
  return passages;
}

PathSurvival PathRates::Of(const Path& path) const {
  PathSurvival out;
  out.passages = Passages(path);
  std::vector<PlannedMeeting> meetings;
  std::map<std::pair<int, const RateEvaluator*>, std::size_t> firsts;  // meetings
  for (std::size_t i = 0; i < out.passages.size(); ++i) {
    const PlannedPassage& passage = out.passages[i];
    const Hazard& hazard = request_.map.hazards[static_cast<std::size_t>(passage.hazard)];
    const RateEvaluator* rates = rates_.Find(hazard.type, passage.passage, passage.at);
    const bool over = passage.passage == Passage::kOver;
    out.crossings += over;
    out.unmeasured += over && rates == nullptr;
    if (rates == nullptr) continue;
    const auto first = firsts.try_emplace({passage.hazard, rates}, i).first->second;
    meetings.push_back({rates, SizeAsMet(hazard, TravelOf(passage)), passage.at, 1, i, first});
  }
  if (const RateEvaluator* floor = rates_.Find(kFreeFloor, Passage::kBeside, {})) {
    Approach at;
    at.speed_mps = request_.robot.cruise_mps;
    at.wall_m = kFarWall_m;
    meetings.push_back({floor,
                        {},
                        at,
                        Length(path) - Covered(out.passages),
                        out.passages.size(),
                        out.passages.size()});
  }
  std::vector<std::vector<PlannedMeeting>> by_condition(conditions_.size(), meetings);
  for (std::size_t c = 0; c < conditions_.size(); ++c)
    for (PlannedMeeting& meeting : by_condition[c]) meeting.at = In(conditions_[c], meeting.at);
  out.survival = PredictSurvival(by_condition, out.passages.size() + 1, rates_.model());
  return out;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A prediction in words, and as predict.json.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/quantity.h"
#include "run/plan_check/prediction.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

std::string WithInterval(const Probability& p) {
  return fmt::format("{} ({} to {})", PercentText(p.value), PercentText(p.lower),
                     PercentText(p.upper));
}

Probability AnyFailure(const Prediction& prediction) {
  const Probability& none = prediction.survival.no_failure;
  return {1 - none.value, 1 - none.upper, 1 - none.lower};
}

// By probability, the likeliest first.
std::vector<const PredictedMeeting*> Ranked(const Prediction& prediction) {
  std::vector<const PredictedMeeting*> ranked;
  for (const PredictedMeeting& meeting : prediction.meetings) ranked.push_back(&meeting);
  std::ranges::stable_sort(ranked, std::ranges::greater(),
                           [](const PredictedMeeting* m) { return m->probability; });
  return ranked;
}

std::string Where(const Encounter& met) {
  if (met.type == kWallBeside) return fmt::format("walls beside, {}", LengthText(met.way_m));
  if (met.type == kFreeFloor) return fmt::format("free floor, {}", LengthText(met.way_m));
  return fmt::format("{} ({}, {}) at ({:.2f}, {:.2f})", met.hazard, met.type, Name(met.passage),
                     met.x_m, met.y_m);
}

Json ProbabilityJson(const Probability& p) {
  return {{"probability", p.value}, {"lower", p.lower}, {"upper", p.upper}};
}

Json MeetingJson(const PredictedMeeting& meeting) {
  const Encounter& met = meeting.expected;
  Json json = {{"hazard", met.hazard}, {"type", met.type}, {"passage", Name(met.passage)}};
  json["probability"] = meeting.probability;
  json["beyond"] = meeting.beyond;
  json["t_s"] = met.t_s;
  json["x_m"] = met.x_m;
  json["y_m"] = met.y_m;
  json["way_m"] = met.way_m;
  for (const auto& [key, value] : met.size) json["size"][key] = value;
  for (const ApproachColumn& column : kApproach)
    json["met"][std::string(column.name)] = met.at.*column.member;
  return json;
}

}  // namespace

std::vector<std::string> PredictionLines(const Prediction& prediction) {
  std::vector<std::string> lines;
  const Probability any = AnyFailure(prediction);
  const bool knows_its_end = prediction.left_out.empty() || any.upper == 1;
  lines.push_back(fmt::format(
      "predicted: {}{} of drives fail, 95 % interval{} {} to {}; {} of conditions",
      prediction.far_beyond   ? "perhaps "
      : prediction.complete() ? ""
                              : "at least ",
      PercentText(any.value), knows_its_end ? "" : " of what is in it", PercentText(any.lower),
      PercentText(any.upper), CountText(prediction.conditions, "draw")));
  for (int m = 0; m < kNumFailureModes; ++m) {
    const Probability& p = prediction.survival.first[static_cast<std::size_t>(m)];
    constexpr double kWorthALine = 5e-4;
    if (p.upper >= kWorthALine)
      lines.push_back(fmt::format("  {}: {}", Name(static_cast<FailureMode>(m)), WithInterval(p)));
  }
  constexpr std::size_t kListed = 5;
  constexpr double kWorthAPlace = 1e-4;
  std::size_t listed = 0, more = 0;
  double of_more = 0;
  for (const PredictedMeeting* meeting : Ranked(prediction)) {
    if (meeting->probability < kWorthAPlace) break;
    if (listed < kListed) {
      lines.push_back(
          fmt::format("  {}: {}", Where(meeting->expected), PercentText(meeting->probability)));
      ++listed;
    } else {
      ++more;
      of_more += meeting->probability;
    }
  }
  if (more > 0)
    lines.push_back(
        fmt::format("  {} more: {} together", CountText(more, "place"), PercentText(of_more)));
  for (const Prediction::Unmeasured& kind : prediction.unmeasured)
    lines.push_back(fmt::format("warning: nothing is known of {} {}, met {}: {}", kind.type,
                                Name(kind.passage), CountText(kind.meetings, "time"), kind.why));
  if (prediction.floors_differ)
    lines.push_back(
        "warning: hazards lie elsewhere in other draws: places and sizes are those of the first");
  for (const std::string& left_out : prediction.left_out)
    lines.push_back("warning: not in it: " + left_out);
  for (const Prediction::Beyond& beyond : prediction.beyond)
    lines.push_back(fmt::format(
        "warning: {} lies beyond what was measured of {}, by {} of that range, most at {}: there "
        "the probability is a guess",
        beyond.axis, beyond.type, PercentText(beyond.share, 2),
        Where(prediction.meetings[beyond.meeting].expected)));
  if (const auto& far = prediction.far_beyond)
    lines.push_back(
        fmt::format("warning: {} = {:.4g} is far beyond what was measured of {}, {:.4g} to {:.4g}, "
                    "at {}: nothing is known of such an encounter",
                    far->axis, far->value, far->type, far->lower, far->upper,
                    Where(prediction.meetings[far->meeting].expected)));
  constexpr int kFewPlans = 40;
  if (prediction.held_against_plans < kFewPlans)
    lines.push_back(
        fmt::format("warning: these rates were held against {} that were driven (measure --floors)",
                    prediction.held_against_plans == 0
                        ? "no plans"
                        : "no more than " + CountText(prediction.held_against_plans, "plan")));
  return lines;
}

Json PredictionJson(const Scenario& s, const Prediction& prediction, const Json& plan) {
  Json json = {{"predict", 1},
               {"scenario", s.spec.name},
               {"robot", s.spec.robot_name},
               {"planner", s.spec.planner_name},
               {"model", Sha256(s.files.Read(s.spec.risk_model_file, 256u << 20))},
               {"length_m", plan.at("length_m")},
               {"coverage", plan.at("coverage")},
               {"conditions", prediction.conditions},
               {"complete", prediction.complete()},
               {"no_failure", ProbabilityJson(prediction.survival.no_failure)},
               {"any_failure", ProbabilityJson(AnyFailure(prediction))}};
  for (int m = 0; m < kNumFailureModes; ++m)
    json["modes"][std::string(Name(static_cast<FailureMode>(m)))] =
        ProbabilityJson(prediction.survival.first[static_cast<std::size_t>(m)]);
  std::map<std::string, double> hazards;
  for (const PredictedMeeting& meeting : prediction.meetings)
    hazards[meeting.expected.hazard.empty() ? meeting.expected.type : meeting.expected.hazard] +=
        meeting.probability;
  json["hazards"] = Json::object();
  for (const auto& [hazard, probability] : hazards) json["hazards"][hazard] = probability;
  json["meetings"] = Json::array();
  for (const PredictedMeeting& meeting : prediction.meetings)
    json["meetings"].push_back(MeetingJson(meeting));
  json["unmeasured"] = Json::array();
  for (const Prediction::Unmeasured& kind : prediction.unmeasured)
    json["unmeasured"].push_back({{"type", kind.type},
                                  {"passage", Name(kind.passage)},
                                  {"meetings", kind.meetings},
                                  {"why", kind.why}});
  json["extrapolated"] = Json::array();
  for (const Prediction::Beyond& beyond : prediction.beyond)
    json["extrapolated"].push_back({{"type", beyond.type},
                                    {"of", beyond.axis},
                                    {"beyond", beyond.share},
                                    {"meeting", beyond.meeting}});
  json["far_beyond"] = prediction.far_beyond.has_value();
  json["floors_differ"] = prediction.floors_differ;
  json["left_out"] = prediction.left_out;
  json["held_against_plans"] = prediction.held_against_plans;
  return json;
}

}  // namespace floorproof

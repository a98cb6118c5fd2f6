// SPDX-License-Identifier: Apache-2.0
#include "run/rare/rare_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/quantity.h"
#include "base/shell_word.h"
#include "run/episode/records.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

std::string_view Name(RareAnswer answer) {
  switch (answer) {
    case RareAnswer::kEstimate:
      return "estimate";
    case RareAnswer::kNothingFound:
      return "nothing_found";
    case RareAnswer::kNoEstimate:
      break;
  }
  return "no_estimate";
}

Json FailureJson(const LikelyFailure& failure) {
  return {{"outcome", failure.row.outcome},
          {"events", Json::parse(failure.row.events)},
          {"set", Sets(failure.set)},
          {"command", RunCommand(failure, "")}};
}

Json RegionJson(const FailureRegion& region) {
  return {{"share", region.share},
          {"draws", region.draws},
          {"pilots", region.pilots},
          {"distance", region.distance}};
}

Json PilotJson(const PilotReport& pilot) {
  return {{"end", Name(pilot.end)},
          {"levels", pilot.levels},
          {"failures", pilot.failures},
          {"probability", pilot.probability}};
}

std::string Happening(const LikelyFailure& failure) {
  std::string text;
  for (const Event& event : EventsOf(failure.row))
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", Name(event.mode),
                        event.hazard.empty() ? "" : " at " + event.hazard);
  return text.empty() ? failure.row.outcome : text;
}

std::vector<std::string> EstimateLines(const RareOutcome& outcome) {
  const RareEstimate& e = outcome.estimate;
  return {fmt::format("{}: {} drives ({}, 95 % interval {} to {}), with a coefficient of variation "
                      "of {}{}",
                      outcome.mode, OneIn(e.probability), PercentText(e.probability),
                      PercentText(e.interval.lower), PercentText(e.interval.upper),
                      NumberText(e.cov, 2),
                      e.reached_target ? ""
                                       : fmt::format(", more than the {} asked for: a larger "
                                                     "--max-n would lower it",
                                                     NumberText(outcome.settings.target_cov))),
          "  that rests on the sampler: it counts the ways to fail that it found"};
}

}  // namespace

std::string OneIn(double probability) { return "1 in " + NumberText(1 / probability); }

std::vector<std::string> Sets(const Drawn& set) {
  std::vector<std::string> sets;
  for (const auto& [key, value] : set) sets.push_back(key + "=" + WriteYamlLine(value));
  return sets;
}

Json RareJson(const RareOutcome& outcome) {
  const RareEstimate& e = outcome.estimate;
  const bool estimated = e.answer == RareAnswer::kEstimate;
  const auto where_estimated = [&](double value) { return estimated ? Json(value) : Json(); };
  Json json = {{"rare", 1},
               {"name", outcome.name},
               {"mode", outcome.mode},
               {"answer", Name(e.answer)},
               {"why", e.why},
               {"probability", where_estimated(e.probability)},
               {"lower", where_estimated(e.interval.lower)},
               {"upper", where_estimated(e.interval.upper)},
               {"confidence", outcome.settings.confidence},
               {"cov", where_estimated(e.cov)},
               {"target_cov", outcome.settings.target_cov},
               {"reached_target", e.reached_target},
               {"trials", e.trials},
               {"errors", outcome.errors},
               {"coordinates", outcome.coordinates},
               {"noise", outcome.noisy}};
  json["without_sampler"] = {{"lower", e.lower_bound},
                             {"upper", e.upper_bound},
                             {"nominal_draws", e.nominal_draws},
                             {"nominal_failures", e.nominal_failures}};
  json["clean_drives_needed"] =
      where_estimated(estimated ? CleanDrawsNeeded(e.probability, outcome.settings.confidence) : 0);
  json["diagnostics"] = {{"fresh_draws", e.fresh_draws},
                         {"fresh_failures", e.fresh_failures},
                         {"effective_failures", e.effective_failures},
                         {"largest_share", e.largest_share}};
  json["pilots"] = Json::array();
  for (const PilotReport& pilot : e.pilots) json["pilots"].push_back(PilotJson(pilot));
  json["regions"] = Json::array();
  for (std::size_t i = 0; i < e.regions.size(); ++i) {
    Json region = RegionJson(e.regions[i]);
    const LikelyFailure* failure = FailureOf(outcome, i);
    region["likeliest"] = failure == nullptr ? Json(nullptr) : FailureJson(*failure);
    json["regions"].push_back(std::move(region));
  }
  json["gate"] = nullptr;
  if (outcome.verdict)
    json["gate"] = {{"verdict", GateVerdictName(outcome.verdict->verdict)},
                    {"rests_on_sampler", outcome.verdict->rests_on_sampler},
                    {"text", outcome.verdict->text}};
  json["versions"] = VersionsJson();
  return json;
}

std::string RunCommand(const LikelyFailure& failure, const std::filesystem::path& folder) {
  std::string command =
      "floorproof run " + ShellWord((folder / "scenario.resolved.yaml").string()) + " --video";
  for (const std::string& set : Sets(failure.set)) command += " --set " + ShellWord(set);
  return command;
}

std::vector<std::string> RareLines(const RareOutcome& outcome,
                                   const std::filesystem::path& folder) {
  const RareEstimate& e = outcome.estimate;
  std::vector<std::string> lines;
  if (outcome.errors > 0)
    lines.push_back(
        fmt::format("warning: {} of {} are errors or have no plan, and count as no "
                    "failure; the first: {}",
                    outcome.errors, CountText(e.trials, "drive"), outcome.first_error));
  if (e.answer == RareAnswer::kEstimate)
    std::ranges::move(EstimateLines(outcome), std::back_inserter(lines));
  else if (e.answer == RareAnswer::kNothingFound)
    lines.push_back(
        fmt::format("{}: none of {} failed", outcome.mode, CountText(e.trials, "drive")));
  else
    lines.push_back(fmt::format("{}: no estimate: {}", outcome.mode, e.why));
  if (e.answer == RareAnswer::kNoEstimate) {
    std::string spread;
    for (const PilotReport& pilot : e.pilots)
      spread += (spread.empty() ? "" : ", ") +
                (pilot.probability > 0 ? PercentText(pilot.probability) : std::string("none"));
    lines.push_back("  its pilots said: " + spread);
  }
  lines.push_back(
      fmt::format("  whatever the sampler did: at least {}, and, by {} as they come of which {} "
                  "failed, at most "
                  "{}",
                  PercentText(e.lower_bound), CountText(e.nominal_draws, "drive"),
                  e.nominal_failures, PercentText(e.upper_bound)));
  if (e.answer == RareAnswer::kEstimate)
    lines.push_back(fmt::format(
        "  to show without a sampler that it is no likelier takes {} without a failure",
        CountText(
            static_cast<std::int64_t>(CleanDrawsNeeded(e.probability, outcome.settings.confidence)),
            "drive")));
  for (std::size_t i = 0; i < e.regions.size(); ++i) {
    const FailureRegion& region = e.regions[i];
    const LikelyFailure* failure = FailureOf(outcome, i);
    lines.push_back(fmt::format(
        "  {}. {} of it ({} among the draws, seen by {} of {} pilots); the likeliest, {} standard "
        "deviations out: {}",
        i + 1, PercentText(region.share, 2), CountText(region.draws, "failure"), region.pilots,
        kPilots, FixedText(region.distance, 2),
        failure == nullptr ? std::string("not looked for")
                           : Happening(*failure) + " with " + DrawnText(failure->set)));
    if (failure != nullptr) lines.push_back("     " + RunCommand(*failure, folder));
  }
  if (outcome.verdict) lines.push_back("gate: " + outcome.verdict->text);
  return lines;
}

}  // namespace floorproof

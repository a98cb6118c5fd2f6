// SPDX-License-Identifier: Apache-2.0
#include "report/run_record.h"

#include <fmt/format.h>

#include <utility>

#include "base/error.h"
#include "base/input_file.h"
#include "base/words.h"
#include "report/replay.h"
#include "report/verdict.h"
#include "run/episode/visits_file.h"
#include "run/scenario/plan_file.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kLargestTrace = 512u << 20;
constexpr std::uintmax_t kLargestReplay = 16u << 20;

}  // namespace

RunRecord::RunRecord(const fs::path& folder)
    : folder_(folder),
      result_(ReadResult(folder / "result.json")),
      events_(result_.at("events").elements()) {
  const fs::path settings = folder / "scenario.resolved.yaml";
  result_.at("outcome").get<std::string>();
  result_.at("metrics").items();
  settings_ = ReadPlainFile(settings, kMaxResultBytes);
  try {
    const Scenario scenario = ReadScenario(settings, {});
    map_ = scenario.world.site.map;
    subject_ = SubjectOf(scenario, {});
    estimates_ = scenario.spec.estimator.name != "truth";
    if (scenario.spec.safety) mission_ = scenario.spec.safety->mission.nodes[0].name;
  } catch (const InputError& e) {
    why_no_map_ = e.what();
  }
}

std::optional<double> RunRecord::Metric(const std::string& name) const {
  const auto metric = result_.at("metrics").Find(name);
  if (!metric || metric->is_null()) return std::nullopt;
  return metric->get<double>();
}

std::string RunRecord::WhatOf(const JsonValue& event) {
  const std::string kind = event.value("kind", std::string());
  return Words(event.at("mode").get<std::string>()) +
         (kind.empty() ? "" : " (" + Words(kind) + ")");
}

PageJson RunRecord::Failures(std::size_t number) const {
  Json failures = Json::array();
  for (const JsonValue& event : Events())
    failures.push_back({{"t_s", event.at("t_s").get<double>()},
                        {"x", event.at("x_m").get<double>()},
                        {"y", event.at("y_m").get<double>()},
                        {"label", std::to_string(failures.size() + 1)},
                        {"what", WhatOf(event)},
                        {"text", event.value("text", std::string())},
                        {"drive", number}});
  return failures;
}

RunRecord::Shown RunRecord::Show(std::size_t number, const std::string& command, bool filmed,
                                 HtmlPage& page) const {
  Shown shown;
  Json ways = Json::array(), plan = Json::array();
  if (const fs::path file = folder_ / "plan.csv";
      map_ && !ReadPlainFile(file, kMaxResultBytes).empty()) {
    try {
      plan = WayData(ReadPlan(file, map_->frame));
    } catch (const InputError& e) {
      shown.note = fmt::format("The plan is not shown: {}", e.what());
    }
  }
  const std::string rows = ReadPlainFile(folder_ / "trace.csv", kLargestTrace);
  const TraceData trace = ReadTraceData(rows);
  if (!rows.empty() && !trace.columns.is_object())
    shown.note = "What was driven is not shown: trace.csv is damaged.";
  if (!plan.empty()) ways.push_back({{"name", "plan"}, {"points", plan}});
  if (trace.way.is_array()) ways.push_back({{"name", "driven"}, {"points", trace.way}});
  shown.drive = {{"events", Failures(number)},
                 {"plan", plan},
                 {"end_s", Metric("duration_s").value_or(0)},
                 {"command", command}};
  if (trace.columns.is_object()) shown.drive["trace"] = trace.columns;
  if (mission_)
    shown.drive["safety"] =
        SafetyData(ReadPlainFile(folder_ / "safety.csv", kLargestTrace), *mission_);
  if (std::string replay = ReadPlainFile(folder_ / "replay.bin", kLargestReplay); !replay.empty()) {
    const std::string id = fmt::format("replay-{}", number);
    page.blobs.emplace_back(id, std::move(replay));
    shown.drive["replay"] = id;
    page.shows_replay = true;
  }
  if (filmed) {
    shown.drive["film"] = fmt::format("film-{}", number);
    AddFilmTimes(folder_, shown.drive);
  }
  if (!map_) return shown;
  shown.map = {{"name", map_->name},
               {"map", MapData(*map_)},
               {"ways", std::move(ways)},
               {"failures", Failures(number)}};
  if (const auto visits = ReadVisits(ReadPlainFile(folder_ / "visits.pgm", kLargestTrace)))
    shown.map["visits"] = VisitsData(*visits);
  return shown;
}

}  // namespace floorproof

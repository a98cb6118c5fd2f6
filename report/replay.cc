// SPDX-License-Identifier: Apache-2.0
#include "report/replay.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "base/input_file.h"
#include "base/input_files.h"
#include "base/result_folder.h"
#include "run/campaign/episode_maker.h"
#include "run/campaign/replay_shelf.h"
#include "run/episode/records.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// `what` of the replay is not what was recorded.
[[noreturn]] void RefuseReplay(const fs::path& where, std::string_view what) {
  throw InternalError(
      fmt::format("{}: the replay differs from the record in '{}' (recorded with "
                  "another version or on another machine type?)",
                  where.string(), what));
}

// Metrics as this version names them.
void RenameMetrics(nlohmann::ordered_json& result) {
  const auto metrics = result.find("metrics");
  if (metrics == result.end() || !metrics->is_object()) return;
  nlohmann::ordered_json renamed = nlohmann::ordered_json::object();
  for (const auto& [name, value] : metrics->items()) {
    const MetricColumn* column = FindMetric(name);
    renamed[column == nullptr ? name : std::string(column->name)] = value;
  }
  *metrics = std::move(renamed);
}

}  // namespace

JsonValue ReadResult(const fs::path& file) {
  RequirePlainResults(file.parent_path());
  return ReadJsonFile(file, "a result", kMaxResultBytes, RenameMetrics);
}

nlohmann::ordered_json ReplayRun(const fs::path& folder, const std::vector<Override>& overrides,
                                 Trust trust, bool video, const Console& console) {
  RequirePlainResults(folder);
  Scenario scenario = ReadScenario(folder / "scenario.resolved.yaml", overrides, trust);
  RefuseProgram(scenario);
  const fs::path result_file = folder / "result.json";
  std::optional<JsonValue> recorded;  // none: another drive than this one's
  constexpr const char* kJudged[] = {"outcome", "events", "metrics"};
  if (overrides.empty()) {
    recorded = ReadResult(result_file);
    for (const char* key : kJudged) recorded->at(key);  // before anything is driven
  }
  const DriveResult result =
      DriveAndFilm(scenario, folder, {.video = video, .write_records = false}, console);
  if (result.not_written) std::rethrow_exception(result.not_written);
  auto json = ResultJson(scenario, result.record);
  for (const char* key : kJudged)
    if (recorded && recorded->at(key).json() != json[key]) RefuseReplay(result_file, key);
  return json;
}

void AddMadePlan(const EpisodeRow& row, const fs::path& folder, const InputFiles& files,
                 Drawn& set) {
  const std::string made = MadePlan(row);
  if (made.empty()) return;
  const fs::path copy = fs::absolute(FindCopy(folder, made));
  files.Allow(copy);
  set.emplace_back("plan.made", ConfigNode::Scalar(copy.string(), true));
}

DriveResult ReplayEpisode(const ScenarioFile& file, const Variant& variant, const EpisodeRow& row,
                          const fs::path& folder, const DriveOptions& options,
                          const Console& console) {
  Variant planned = variant;
  AddMadePlan(row, folder, file.files(), planned.overrides);
  const fs::path into = EpisodeFolder(folder, variant.name, row.episode);
  RefuseLinks(folder, into);
  return ReplayRow(file.Read(row.episode, planned), row, into, options, console);
}

DriveResult ReplayRow(Scenario scenario, const EpisodeRow& row, const fs::path& into,
                      const DriveOptions& options, const Console& console) {
  RefuseProgram(scenario);
  if (row.outcome == "error") console.Say("recorded as an error: " + row.message);
  DriveResult result = DriveAndFilm(scenario, into, options, console);
  if (result.not_written) std::rethrow_exception(result.not_written);
  const EpisodeRow now = MakeRow(row.variant, scenario.spec, row.plan, result.record);
  if (row.outcome == "error" && now.outcome != "error")
    throw InternalError(
        fmt::format("{}: recorded as an error ({}), which did not come again; `campaign --resume "
                    "--retry-errors` drives it anew",
                    into.string(), row.message));
  for (const auto& [what, same] : {std::pair("outcome", now.outcome == row.outcome),
                                   {"events", now.events == row.events},
                                   {"metrics", now.metrics == row.metrics}})
    if (!same) RefuseReplay(into, what);
  return result;
}

}  // namespace floorproof

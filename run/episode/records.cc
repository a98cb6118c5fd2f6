// SPDX-License-Identifier: Apache-2.0
#include "run/episode/records.h"

#include <floorproof/version.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <sys/utsname.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/input_file.h"
#include "base/printable.h"
#include "env/core/failure_text.h"
#include "planners/risk/risk_meter.h"
#include "run/episode/encounter_table.h"
#include "run/episode/visits_file.h"
#include "run/scenario/floors.h"
#include "run/scenario/plan_file.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

Json OrNull(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json EventJson(const Event& e) {
  Json json = {{"mode", Name(e.mode)}, {"kind", e.kind},   {"t_s", e.t_s},
               {"x_m", e.x_m},         {"y_m", e.y_m},     {"yaw_rad", e.yaw_rad},
               {"hazard", e.hazard},   {"value", e.value}, {"threshold", e.threshold},
               {"effect", e.effect}};
  Json evidence = Json::object();
  for (const auto& [name, value] : e.evidence) evidence[name] = value;
  json["evidence"] = std::move(evidence);
  return json;
}

Json InterventionsJson(const std::vector<Intervention>& interventions) {
  Json json = Json::array();
  for (const Intervention& a : interventions)
    json.push_back({{"t_s", a.t_s},
                    {"x_m", a.from_W.x()},
                    {"y_m", a.from_W.y()},
                    {"to_x_m", a.to_W.x()},
                    {"to_y_m", a.to_W.y()},
                    {"to_yaw_rad", a.yaw_rad}});
  return json;
}

// A number or a truth value as such, a list by its entries, else text.
Json ValueJson(const ConfigNode& node) {
  if (node.IsList()) {
    Json list = Json::array();
    for (const ConfigNode& item : node.items) list.push_back(ValueJson(item));
    return list;
  }
  if (node.IsMap()) {
    Json map = Json::object();
    for (const auto& [key, value] : node.entries) map[key] = ValueJson(value);
    return map;
  }
  if (node.IsNull()) return nullptr;
  if (!node.quoted && (node.scalar == "true" || node.scalar == "false"))
    return node.scalar == "true";
  double number = 0;
  const char* end = node.scalar.data() + node.scalar.size();
  const auto [rest, error] = std::from_chars(node.scalar.data(), end, number);
  if (!node.quoted && error == std::errc() && rest == end && std::isfinite(number)) return number;
  return node.scalar;
}

// To a hundredth of a millimetre, and without the sign of a zero.
double Coordinate(double value_m) {
  constexpr double kUnit = 1e5;
  return std::round(value_m * kUnit) / kUnit + 0.0;
}

Json PlaceJson(const SamplePlace& sample) {
  return {{"x_m", Coordinate(sample.p_W.x())},
          {"y_m", Coordinate(sample.p_W.y())},
          {"kinds", Names(sample.kinds)},
          {"reachable", sample.reachable},
          {"visit", sample.visit > 0 ? Json(sample.visit) : Json(nullptr)},
          {"status", sample.visit > 0   ? "planned"
                     : sample.reachable ? "not_planned"
                                        : "out_of_reach"},
          {"dirt_count", nullptr},
          {"score", nullptr}};
}

// What was read from its tape, or why nothing was.
void AddReadings(const AuditSample& sample, Json& json) {
  if (sample.read()) {
    json["dirt_count"] = sample.counted.count;
    json["score"] = sample.score.score;
  } else {
    json["status"] = Name(sample.status());
    json["message"] = sample.message();
  }
  json["tape"]["particles"] = sample.lifted.size();
}

// `driven`: nullptr before the drive.
Json SamplesJson(const World& world, const PlanResult& plan, const EpisodeRecord* driven) {
  Json json = Json::array();
  for (const SamplePlace& sample : plan.samples) {
    json.push_back(PlaceJson(sample));
    if (driven != nullptr && sample.visit > 0) json.back()["status"] = "not_taken";
  }
  if (driven == nullptr) return json;
  for (std::size_t i = 0; i < driven->sample_stops.size(); ++i) {
    const SampleStop& stop = driven->sample_stops[i];
    const Pose2 X_WT = TapePose(world.robot.spec, stop);
    Json& taken = json[static_cast<std::size_t>(stop.place)];
    taken["status"] = "taken";
    taken["tape"] = {{"t_s", stop.t_s},
                     {"x_m", Coordinate(X_WT.x_m)},
                     {"y_m", Coordinate(X_WT.y_m)},
                     {"yaw_rad", X_WT.yaw_rad},
                     {"off_m", OffPlace(world.robot.spec, plan, stop)}};
    if (driven->audit) AddReadings(driven->audit->samples[i].sample, taken);
  }
  return json;
}

Json RegionJson(const RegionScore& region) {
  const SpaceScore& score = region.score;
  Json json = {{"samples", score.samples},
               {"score", OrNull(score.mean)},
               {"lower", nullptr},
               {"upper", nullptr},
               {"confidence", kReportedConfidence}};
  if (region.interval) {
    json["lower"] = region.interval->lower;
    json["upper"] = region.interval->upper;
  }
  return json;
}

Json AuditJson(const FloorAudit& audit) {
  Json json = RegionJson(audit.region);
  json["represents"] = audit.region.score.represented;
  if (audit.near_walls) json["near_walls"] = RegionJson(*audit.near_walls);
  if (audit.elsewhere) json["elsewhere"] = RegionJson(*audit.elsewhere);
  json["dirty"] = audit.gathering.dirty;
  json["clean"] = audit.gathering.clean;
  json["unreadable"] = audit.unreadable;
  json["true_dirt_per_m2"] = audit.mean_dirt_per_m2;
  return json;
}

// The paper's measures of the path (planners/risk/risk_meter.h).
void AddRisk(const PlanResult& plan, Json& json) {
  const RiskOfPath risk = MeasureRisk(*plan.risk, plan.path);
  json["cumulative_risk"] = risk.cumulative_risk;
  json["risk_of_cells_once"] = risk.each_cell_once;
  json["risk_over_once"] =
      risk.each_cell_once > 0 ? risk.cumulative_risk / risk.each_cell_once - 1 : 0;
  json["cells_visited"] = risk.cells;
  json["cell_visits"] = risk.visits;
  json["hazard_free_coverage"] = risk.coverage;
  json["terrain_crossings"] = risk.terrain_crossings;
  Json ranges = Json::array();
  for (const auto& range : risk.ranges)
    ranges.push_back({{"rf_from", range.low},
                      {"rf_to", range.high},
                      {"cells", range.cells},
                      {"visits", range.visits}});
  json["visits_by_risk"] = std::move(ranges);
}

bool IsPlanFile(std::string_view name) {
  return name == "scenario.resolved.yaml" || name == "plan.csv" || name == "plan.json" ||
         name == "risk.csv";
}

bool IsFilm(std::string_view name) {
  return name == "video.mp4" || name == "video.json" ||
         (name.starts_with("frame_") && name.ends_with(".png"));
}

void Remove(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::remove(file, error);
  if (error)
    throw InputError({file.string(), 0}, "", "",
                     "of an earlier run, cannot be removed: " + error.message());
}

}  // namespace

std::string JsonText(const Json& json) {
  return json.dump(2, ' ', true, Json::error_handler_t::replace);
}

Json VersionsJson() {
  utsname system{};
  uname(&system);
  return {{"floorproof", FLOORPROOF_VERSION},
          {"mujoco", mj_versionString()},
          {"compiler", FLOORPROOF_COMPILER},
          {"machine", std::string(system.sysname) + " " + system.machine}};
}

Json EventsJson(const std::vector<Event>& events) {
  Json json = Json::array();
  for (const Event& event : events) json.push_back(EventJson(event));
  return json;
}

Json AlarmsJson(const std::vector<RaisedAlarm>& alarms) {
  Json json = Json::array();
  for (const RaisedAlarm& alarm : alarms)
    json.push_back({{"t_s", alarm.t_s},
                    {"monitor", alarm.monitor},
                    {"wheel", alarm.wheel.empty() ? Json(nullptr) : Json(alarm.wheel)},
                    {"value", alarm.value},
                    {"limit", alarm.limit},
                    {"until_s", alarm.until_s ? Json(*alarm.until_s) : Json(nullptr)}});
  return json;
}

Json TimeoutJson(const std::optional<Timeout>& timeout) {
  if (!timeout) return nullptr;
  return {{"t_s", timeout->t_s},
          {"x_m", timeout->X_WB.x_m},
          {"y_m", timeout->X_WB.y_m},
          {"yaw_rad", timeout->X_WB.yaw_rad},
          {"hazard", timeout->hazard}};
}

namespace {

Json ArrivalJson(const Arrival& how) {
  return {{"believed", how.believed},
          {"end_off_m", OrNull(how.off_m)},
          {"end_off_allowed_m", how.most_off_m},
          {"at_rest", how.at_rest},
          {"speed_mps", how.speed_mps},
          {"turn_radps", how.turn_radps},
          {"plan_left_m", OrNull(how.left_m)},
          {"tasks_missed", how.tasks_missed}};
}

}  // namespace

Json DrawnJson(const Drawn& drawn) {
  Json json = Json::object();
  for (const auto& [key, value] : drawn) json[key] = ValueJson(value);
  return json;
}

Json MetricsJson(const Metrics& metrics) {
  Json json = Json::object();
  for (const MetricColumn& column : kMetrics)
    json[std::string(column.name)] = std::visit(
        [&](auto member) -> Json {
          if constexpr (std::is_same_v<decltype(member), std::optional<double> Metrics::*>)
            return OrNull(metrics.*member);
          else
            return metrics.*member;
        },
        column.member);
  return json;
}

Json PlanJson(const Scenario& s, const PlanResult& plan, const EpisodeRecord* driven) {
  if (plan.status == PlanStatus::kOnline)  // there is nothing to measure yet
    return {
        {"status", Name(plan.status)}, {"message", plan.message}, {"planner", s.spec.planner_name}};
  const bool circle = plan.clear.kind == Shape2::Kind::kCircle;
  PathCoverage covered;
  double area_m2 = 0;
  if (!plan.path.empty()) {
    const SweepArea area = ComputeSweepArea(KnownFloor(s.world), s.world.robot.spec, plan.clear,
                                            plan.tool, s.world.start);
    covered = MeasureCoverage(area, plan.tool, plan.path);
    area_m2 = area.area_m2();
  }
  Json json = {{"status", Name(plan.status)},
               {"message", plan.message},
               {"planner", s.spec.planner_name.empty() ? "file" : s.spec.planner_name},
               {"length_m", Length(plan.path)},
               {"turns", CountTurns(plan.path)},
               {"waypoints", plan.path.size()},
               {"coverage", covered.coverage},
               {"overlap", covered.overlap},
               {"sweepable_m2", area_m2},
               {"tool_width_m", plan.tool_width_m},
               {"keeps_clear", circle ? "circle" : "footprint"},
               {"radius_m", circle ? plan.clear.radius_m : s.world.robot.spec.inscribed_radius_m}};
  if (AsksForRisk(s.spec)) AddRisk(plan, json);
  for (const auto& [name, value] : plan.figures) json[name] = value;
  if (!plan.samples.empty()) json["sample_places"] = SamplesJson(s.world, plan, driven);
  if (!plan.convergence_m.empty()) json["convergence_m"] = plan.convergence_m;
  return json;
}

Json ResultJson(const Scenario& s, const EpisodeRecord& record) {
  Json margins = Json::object();
  for (const auto& margin : record.margins) margins[margin.detector] = margin.value;
  Json figures = Json::object();
  for (const auto& [name, value] : record.figures) figures[name] = value;
  Json events = EventsJson(record.events);
  for (std::size_t i = 0; i < events.size(); ++i)
    events[i]["text"] = FailureSentence(record.events[i], s.world.site.map);
  Json json = {{"schema", 1},
               {"scenario", s.spec.name},
               {"robot", s.spec.robot_name},
               {"site", s.world.site.map.name},
               {"outcome", Name(record.outcome)},
               {"message", record.message}};
  if (record.timeout) json["timeout"] = TimeoutJson(record.timeout);
  if (record.arrival) json["arrival"] = ArrivalJson(*record.arrival);
  if (!record.figures.empty()) json["planner"] = std::move(figures);
  if (record.audit) json["audit"] = AuditJson(*record.audit);
  if (s.spec.safety) json["alarms"] = AlarmsJson(record.alarms);
  json.update({{"events", std::move(events)},
               {"assists", InterventionsJson(record.interventions)},
               {"metrics", MetricsJson(record.metrics)},
               {"margins", std::move(margins)},
               {"steps", record.steps},
               {"seed", s.spec.episode.seed},
               {"drawn", DrawnJson(s.spec.drawn)},
               {"versions", VersionsJson()}});
  return json;
}

std::string TraceCsv(const EpisodeRecord& record, const RobotSpec& robot) {
  fmt::memory_buffer out;
  const auto into = std::back_inserter(out);
  const auto end_of = [](const TraceColumn& column) {
    return &column == &kTraceColumns.back() ? '\n' : ',';
  };
  for (const TraceColumn& column : kTraceColumns)
    fmt::format_to(into, "{}{}", column.name, end_of(column));
  for (const TraceRow& row : record.trace)
    for (const TraceColumn& column : kTraceColumns) {
      if (const auto* time = std::get_if<TraceColumn::Time>(&column.member))
        fmt::format_to(into, "{:.3f}", row.*(time->value));
      else if (const auto* place = std::get_if<TraceColumn::Place>(&column.member))
        fmt::format_to(into, "{:.5f}", Coordinate(row.*(place->value)));
      else if (const auto* number = std::get_if<float TraceRow::*>(&column.member))
        fmt::format_to(into, "{}", row.**number);
      else
        fmt::format_to(into, "{}", std::get<TraceColumn::Text>(column.member)(row, robot));
      out.push_back(end_of(column));
    }
  return fmt::to_string(out);
}

std::string SafetyCsv(const EpisodeRecord& record) {
  std::string csv = "t_s,node,safety_state,level,machine_state,reason\n";
  for (const SafetyRow& row : record.safety)
    csv += fmt::format("{:.2f},{},{:g},{},{},{}\n", row.t_s, CsvField(row.node), row.safety_state,
                       Name(row.level), Name(row.machine), CsvField(row.reason));
  return csv;
}

std::string RiskCsv(const RiskMap& risk) {
  fmt::memory_buffer out;
  for (int iy = risk.rf.height - 1; iy >= 0; --iy)
    for (int ix = 0; ix < risk.rf.width; ++ix)
      fmt::format_to(std::back_inserter(out), "{}{}", risk.rf(ix, iy),
                     ix + 1 < risk.rf.width ? ',' : '\n');
  return fmt::to_string(out);
}

namespace {

// Where the plan is that a program has made, for the settings; empty: none has.
std::filesystem::path KeepMadePlan(const Scenario& s, const PlanResult& plan,
                                   const std::filesystem::path& folder) {
  if (ProgramToAsk(s.spec) == nullptr || plan.status != PlanStatus::kSuccess) return {};
  const std::string text = PlanCsv(plan.path);
  std::filesystem::path copy = KeepText(text, folder);
  s.files.Hold(copy, text);
  return copy;
}

}  // namespace

ResultNames EpisodeResults() {
  return {"episode", [](std::string_view name) {
            return IsPlanFile(name) || IsFilm(name) || name == "result.json" ||
                   name == "predict.json" || name == "trace.csv" || name == "encounters.csv" ||
                   name == "safety.csv" || name == "visits.pgm" || name == "replay.bin" ||
                   name == "report.html" ||
                   (name.ends_with(".png") &&
                    (name.starts_with("heatmap_") || name.starts_with("plot_")));
          }};
}

ResultNames FilmResults() { return {"episode", IsFilm, false}; }

Json WritePlanFiles(const Scenario& s, const PlanResult& plan,
                    const std::filesystem::path& folder) {
  const std::filesystem::path made = KeepMadePlan(s, plan, folder);
  if (made.empty())
    WriteResolvedScenario(s, folder);
  else
    WriteResolvedScenario(s, folder, {made}, made);
  if (plan.status == PlanStatus::kOnline)
    Remove(folder / "plan.csv");
  else
    WriteFileWhole(folder / "plan.csv", PlanCsv(plan.path));
  Json json = PlanJson(s, plan);
  WriteFileWhole(folder / "plan.json", JsonText(json) + "\n");
  if (AsksForRisk(s.spec)) {
    WriteFileWhole(folder / "risk.csv", RiskCsv(*plan.risk));
  } else {
    for (const char* name :
         {"risk.csv", "heatmap_risk.png", "heatmap_plan_visits.png", "plot_risk.png"})
      Remove(folder / name);
  }
  return json;
}

void RemoveEpisodeFiles(const ResultFolder& folder) {
  Remove(folder.path() / "result.json");
  for (const std::string& name : folder.Results())
    if (!IsPlanFile(name)) Remove(folder.path() / name);
}

void WriteEpisodeFiles(const Scenario& s, const PlanResult& plan, const EpisodeRecord& record,
                       const std::filesystem::path& folder) {
  WriteFileWhole(folder / "trace.csv", TraceCsv(record, s.world.robot.spec));
  if (!record.passes.cells.empty()) WriteFileWhole(folder / "visits.pgm", VisitsPgm(record));
  if (s.spec.episode.drive == "physics")
    WriteFileWhole(folder / "encounters.csv", EncountersCsv(record.encounters));
  if (s.spec.safety) WriteFileWhole(folder / "safety.csv", SafetyCsv(record));
  if (!plan.samples.empty() && record.steps > 0)
    WriteFileWhole(folder / "plan.json", JsonText(PlanJson(s, plan, &record)) + "\n");
  if (record.outcome != Outcome::kInterrupted)
    WriteFileWhole(folder / "result.json", JsonText(ResultJson(s, record)) + "\n");
}

}  // namespace floorproof

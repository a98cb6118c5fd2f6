// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "controllers/drive.h"
#include "controllers/estimator.h"
#include "controllers/supervision/robot_primitive.h"
#include "controllers/tracker.h"
#include "env/failures/detector.h"
#include "env/faults/schedule.h"
#include "env/hazards/hazard_type.h"
#include "env/sensors/sensor.h"
#include "planners/online/online_planner.h"
#include "planners/orders/visit_order.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

void AddParams(Configurable& source, Json& params) {
  for (const auto& doc : DocumentParams(source))
    params.push_back({{"name", doc.name},
                      {"default", doc.default_text},
                      {"rule", doc.rule},
                      {"help", doc.help}});
}

// When it is there.
struct ScheduleKeys final : Configurable {
  void Visit(ParamVisitor& v) override { timing.Visit(v); }
  FaultTiming timing;
};

// `shared`: the keys that every one of the kind takes beside its own.
template <class T>
void AddEntries(std::span<const PluginEntry<T>> table, Json& out, Configurable* shared = nullptr) {
  for (const auto& entry : table) {
    Json params = Json::array();
    if constexpr (std::is_base_of_v<Configurable, T>) AddParams(*entry.make(), params);
    if (shared != nullptr) AddParams(*shared, params);
    out.push_back({{"name", entry.name}, {"help", entry.help}, {"params", std::move(params)}});
    if constexpr (std::is_same_v<T, HazardType>) {
      const bool line = entry.make()->placement() == HazardType::Placement::kLine;
      out.back()["place"] = line ? "line_m" : "polygon_m";
    }
  }
}

Json Entries(const std::string& kind) {
  Json out = Json::array();
  if (kind == "planners") {
    AddEntries(Planners(), out);
    AddEntries(OnlinePlanners(), out);
  }
  if (kind == "orders") AddEntries(VisitOrders(), out);
  if (kind == "controllers") AddEntries(Trackers(), out);
  if (kind == "estimators") AddEntries(Estimators(), out);
  if (kind == "sensors") AddEntries(Sensors(), out);
  if (kind == "hazards") AddEntries(HazardTypes(), out);
  ScheduleKeys schedule;
  if (kind == "faults") AddEntries(Faults(), out, &schedule);
  if (kind == "monitors") AddEntries(Monitors(), out);
  if (kind == "primitives") AddEntries(RobotPrimitives(), out);
  if (kind == "failures") AddEntries(Detectors(), out);
  if (kind == "robots")
    for (const auto& robot : Robots())
      out.push_back({{"name", robot.name}, {"help", robot.help}, {"params", Json::array()}});
  return out;
}

std::string Text(const Json& of, const char* key) { return of[key].get<std::string>(); }

void SayNames(const Json& entries, const Globals& globals) {
  FactTable table;
  for (const Json& entry : entries) table.Add({Text(entry, "name"), Text(entry, "help")});
  globals.Say(table);
}

// Each with the keys that it takes, and what they are unless written.
void SayKeys(const Json& entries, const Globals& globals) {
  for (const Json& entry : entries) {
    TextTable table({{.least = 26}, {.least = 10}, {.wraps = true}});
    table.SetTitle(Text(entry, "name") + ": " + Text(entry, "help"));
    if (entry.contains("place"))
      table.Add({Text(entry, "place"), "",
                 entry["place"] == "line_m" ? "where it lies: the points of a line"
                                            : "where it lies: a polygon's corners"});
    for (const Json& p : entry["params"])
      table.Add(
          {Text(p, "name"), Text(p, "default"), Text(p, "help") + " (" + Text(p, "rule") + ")"});
    globals.Say(table);
  }
}

}  // namespace

void AddList(CommandLine& line, const Globals& globals, int&) {
  static const std::vector<std::string> kKinds = {
      "planners", "orders", "controllers", "estimators", "sensors",   "hazards",
      "robots",   "faults", "failures",    "monitors",   "primitives"};
  auto kind = std::make_shared<std::string>();
  Subcommand command =
      line.Add("list", "List what a scenario may name; with a kind, the keys of each as well");
  command.OneOf("KIND", *kind, "One of the kinds; none: all", kKinds);
  command.OnRun([kind, &globals] {
    Json all = Json::object();
    for (const auto& k : kKinds) {
      if (!kind->empty() && k != *kind) continue;
      all[k] = Entries(k);
      if (globals.json) continue;
      globals.Say(k + (all[k].empty() ? ": none in this version" : ""));
      kind->empty() ? SayNames(all[k], globals) : SayKeys(all[k], globals);
    }
    globals.Result(all);
  });
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/episode_row.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/error.h"
#include "base/file_output.h"
#include "base/params.h"
#include "run/episode/bounded_json.h"
#include "run/episode/encounter_table.h"
#include "run/episode/episode_record.h"
#include "run/episode/records.h"
#include "run/scenario/scenario_spec.h"

namespace floorproof {

using Json = nlohmann::ordered_json;

bool EpisodeRow::any_failure() const {
  return outcome == "failure" || std::ranges::any_of(events_of, [](int n) { return n > 0; });
}

std::string EpisodeRow::ResultHash() const {
  std::string text;
  for (const std::string* part : {&outcome, &message, &plan, &events}) text += *part + '\n';
  for (const int n : events_of) text += std::to_string(n) + ' ';
  for (const auto& value : metrics) text += (value ? FormatDouble(*value) : "none") + ' ';
  return Sha256(text);
}

EpisodeRow MakeRow(const std::string& variant, const ScenarioSpec& spec, const std::string& plan,
                   const EpisodeRecord& record) {
  EpisodeRow row;
  row.variant = variant;
  row.episode = spec.episode_id;
  row.outcome = Name(record.outcome);
  row.message = record.message;
  for (const Event& event : record.events) ++row.events_of[static_cast<std::size_t>(event.mode)];
  if (record.steps > 0)
    for (std::size_t i = 0; i < kMetrics.size(); ++i)
      row.metrics[i] = kMetrics[i].Of(record.metrics);
  row.drawn = DrawnJson(spec.drawn).dump();
  row.plan = plan;
  row.events = EventsJson(record.events).dump();
  row.timeout = TimeoutJson(record.timeout).dump();
  row.encounters = record.encounters;
  return row;
}

std::vector<Event> EventsOf(const EpisodeRow& row) {
  try {
    std::vector<Event> events;
    for (const Json& json : Json::parse(row.events)) {
      Event event;
      event.kind = json.at("kind");
      event.hazard = json.at("hazard");
      event.t_s = json.at("t_s");
      event.x_m = json.at("x_m");
      event.y_m = json.at("y_m");
      const std::string mode = json.at("mode");
      for (int m = 0; m < kNumFailureModes; ++m)
        if (mode == Name(static_cast<FailureMode>(m))) event.mode = static_cast<FailureMode>(m);
      events.push_back(std::move(event));
    }
    return events;
  } catch (const Json::exception& e) {
    throw InternalError(e.what());
  }
}

std::optional<Timeout> TimeoutOf(const EpisodeRow& row) {
  try {
    const Json json = Json::parse(row.timeout);
    if (json.is_null()) return std::nullopt;
    return Timeout{
        json.at("t_s"), {json.at("x_m"), json.at("y_m"), json.at("yaw_rad")}, json.at("hazard")};
  } catch (const Json::exception& e) {
    throw InternalError(e.what());
  }
}

std::string MadePlan(const EpisodeRow& row) {
  try {
    return Json::parse(row.plan).value("made", "");
  } catch (const Json::exception& e) {
    throw InternalError(e.what());
  }
}

std::string WhyUnreadableRow(const EpisodeRow& row) {
  for (const std::string* text : {&row.drawn, &row.plan, &row.events, &row.timeout})
    if (std::string why = WhyUnboundedJson(*text); !why.empty()) return why;
  for (const std::string* text : {&row.drawn, &row.plan}) {
    const Json json = Json::parse(*text);
    if (!json.is_object()) return "is no JSON object";
    if (json.contains("made") && !json["made"].is_string()) return "holds a `made` that is no text";
  }
  if (!Json::parse(row.events).is_array()) return "is no JSON list";
  try {
    EventsOf(row);
  } catch (const InternalError&) {
    return "holds an event without its keys";
  }
  try {
    TimeoutOf(row);
  } catch (const InternalError&) {
    return "holds a timeout without its keys";
  }
  constexpr Outcome kAll[] = {Outcome::kSuccess,    Outcome::kFailure,    Outcome::kTimeout,
                              Outcome::kAborted,    Outcome::kNotPlanned, Outcome::kError,
                              Outcome::kInterrupted};
  if (std::ranges::none_of(kAll, [&](Outcome o) { return Name(o) == row.outcome; }))
    return "names an outcome that is none";
  return "";
}

std::string ToLine(const EpisodeRow& row) {
  Json metrics = Json::array();
  for (const auto& value : row.metrics) metrics.push_back(value ? Json(*value) : Json(nullptr));
  Json encounters = Json::array();
  for (const Encounter& encounter : row.encounters) {
    Json values = Json::array();
    for (const EncounterValue& value : EncounterValues(encounter))
      std::visit([&](const auto& v) { values.push_back(v); }, value);
    encounters.push_back(std::move(values));
  }
  return Json({row.variant, row.episode, row.outcome, row.message, row.events_of, metrics,
               row.drawn, row.plan, row.events, row.timeout, row.wall_s, row.made, encounters,
               Base64(row.replay)})
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

EpisodeRow FromLine(std::string_view line) {
  try {
    const Json json = Json::parse(line);
    EpisodeRow row;
    row.variant = json.at(0).get<std::string>();
    row.episode = json.at(1).get<std::uint64_t>();
    row.outcome = json.at(2).get<std::string>();
    row.message = json.at(3).get<std::string>();
    row.events_of = json.at(4).get<std::array<int, kNumFailureModes>>();
    for (std::size_t i = 0; i < row.metrics.size(); ++i)
      if (const Json& value = json.at(5).at(i); !value.is_null())
        row.metrics[i] = value.get<double>();
    row.drawn = json.at(6).get<std::string>();
    row.plan = json.at(7).get<std::string>();
    row.events = json.at(8).get<std::string>();
    row.timeout = json.at(9).get<std::string>();
    row.wall_s = json.at(10).get<double>();
    row.made = json.at(11).get<std::string>();
    for (const Json& encounter : json.at(12)) {
      std::vector<EncounterValue> values;
      for (const Json& value : encounter)
        if (value.is_string())
          values.emplace_back(value.get<std::string>());
        else
          values.emplace_back(value.get<double>());
      row.encounters.push_back(EncounterOf(values));
    }
    row.replay = FromBase64(json.at(13).get<std::string>());
    return row;
  } catch (const Json::exception& e) {
    throw InternalError(std::string("a worker's answer cannot be read: ") + e.what());
  }
}

}  // namespace floorproof

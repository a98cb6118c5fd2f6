// SPDX-License-Identifier: Apache-2.0
// The files that a plan or an episode leaves in its output folder.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "base/result_folder.h"
#include "run/episode/episode.h"
#include "run/scenario/draws.h"

namespace floorproof {

struct Scenario;

// As files and stdout have it: characters beyond ASCII are escaped, bytes that are no UTF-8
// replaced.
std::string JsonText(const nlohmann::ordered_json& json);

// plan.json's content: status, planner, length_m, turns, coverage, overlap, ... `driven`: of an
// audit that was, so that the plan says what its samples held; nullptr: only planned.
nlohmann::ordered_json PlanJson(const Scenario& scenario, const PlanResult& plan,
                                const EpisodeRecord* driven = nullptr);
// result.json's content: schema, outcome, timeout (where that is the outcome), events, metrics,
// margins, seed, versions. No wall times.
nlohmann::ordered_json ResultJson(const Scenario& scenario, const EpisodeRecord& record);
// Its parts: what a campaign keeps of each episode.
nlohmann::ordered_json MetricsJson(const Metrics& metrics);
nlohmann::ordered_json EventsJson(const std::vector<Event>& events);
nlohmann::ordered_json TimeoutJson(const std::optional<Timeout>& timeout);  // null: there was none
nlohmann::ordered_json DrawnJson(const Drawn& drawn);
nlohmann::ordered_json VersionsJson();
std::string TraceCsv(const EpisodeRecord& record, const RobotSpec& robot);

// safety.csv: a row at each change.
std::string SafetyCsv(const EpisodeRecord& record);
// RF per cell, the top row first.
std::string RiskCsv(const RiskMap& risk);

// What a plan and an episode leave, pictures and film included; and the film with its stills alone.
ResultNames EpisodeResults();
ResultNames FilmResults();

// scenario.resolved.yaml, plan.csv, plan.json and risk.csv. A plan that a program made is kept in
// `inputs` and named by the settings: who reads them drives it, and runs no program. Returns
// plan.json's content.
nlohmann::ordered_json WritePlanFiles(const Scenario& scenario, const PlanResult& plan,
                                      const std::filesystem::path& folder);
// Removes what an earlier episode left beside its plan: result.json first, which says that the rest
// is whole.
void RemoveEpisodeFiles(const ResultFolder& folder);
// trace.csv, visits.pgm, encounters.csv, of an audit plan.json anew, and, unless the episode was
// interrupted, result.json (last: it says the rest is whole).
void WriteEpisodeFiles(const Scenario& scenario, const PlanResult& plan,
                       const EpisodeRecord& record, const std::filesystem::path& folder);

}  // namespace floorproof

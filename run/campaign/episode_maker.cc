// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/episode_maker.h"

#include <chrono>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "run/campaign/replay_shelf.h"
#include "run/episode/ask_program.h"
#include "run/episode/execute.h"
#include "run/episode/plan_inputs.h"
#include "run/episode/records.h"
#include "run/episode/replay_track.h"
#include "run/scenario/plan_file.h"
#include "run/scenario/scenario.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

// The plan's JSON with what an online planner has to say after the drive.
std::string WithFigures(const std::string& plan, const EpisodeRecord& record) {
  if (record.figures.empty()) return plan;
  auto json = nlohmann::ordered_json::parse(plan);
  for (const auto& [name, value] : record.figures) json[name] = value;
  return json.dump();
}

// Paths within the scenario's folder are told from there, so that a shard driven elsewhere says the
// same.
std::string FromFolder(const std::string& message, const std::filesystem::path& folder) {
  const std::string prefix = folder.empty() ? "" : (folder / "").string();
  return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

}  // namespace

const EpisodeMaker::Planned& EpisodeMaker::Plan(const Variant& variant, const Scenario& s) {
  const std::string inputs = PlanInputs(s);
  Planned& last = plans_[variant.name];
  if (last.json.empty() || inputs != last.inputs) {
    last.inputs.clear();  // a planner that throws leaves no plan behind
    last.plan = MakePlan(s);
    auto json = PlanJson(s, last.plan);
    for (const char* list : {"visits_by_risk", "sample_places", "convergence_m"})
      json.erase(list);  // a row holds numbers
    last.made.clear();
    if (ProgramToAsk(s.spec) != nullptr && last.plan.status == PlanStatus::kSuccess) {
      last.made = PlanCsv(last.plan.path);
      json["made"] = Sha256(last.made);
    }
    last.json = json.dump();
    last.inputs = inputs;
  }
  return last;
}

EpisodeMaker::Numbered EpisodeMaker::Of(Job job) const {
  const auto& variants = file_.variants();
  return {variants[job % variants.size()], job / variants.size()};
}

std::string EpisodeMaker::Answer(Job job) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto [variant, episode] = Of(job);
  EpisodeRow row = Run(variant, episode);
  row.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  return ToLine(row);
}

EpisodeRow EpisodeMaker::Drive(const Variant& variant, const Scenario& s) {
  const Planned& planned = Plan(variant, s);
  std::optional<Scene> scene;
  ReplayObserver replay(s.spec.episode.control_hz, nullptr);
  const EpisodeRecord record = ExecutePlan(s, planned.plan, scene, replays_ ? &replay : nullptr);
  EpisodeRow row = MakeRow(variant.name, s.spec, WithFigures(planned.json, record), record);
  row.made = planned.made;
  if (replays_ && IsListed(row)) row.replay = replay.Bytes(scene, record);
  return row;
}

EpisodeRow EpisodeMaker::Run(const Variant& variant, std::uint64_t episode) try {
  Scenario s = file_.Read(episode, variant);
  return Drive(variant, s);
} catch (const InputError& e) {
  return Refused(variant, episode, e.what());
} catch (const InternalError& e) {
  return Refused(variant, episode, e.what());
}

EpisodeRow EpisodeMaker::RunDrawn(const Variant& variant, std::uint64_t episode,
                                  const Drawn& drawn) try {
  Scenario s = file_.ReadDrawn(episode, drawn);
  return Drive(variant, s);
} catch (const InputError& e) {
  return Refused(variant, episode, drawn, e.what());
} catch (const InternalError& e) {
  return Refused(variant, episode, drawn, e.what());
}

const PlanResult& EpisodeMaker::PlanDrawn(const Variant& variant, std::uint64_t episode,
                                          const Drawn& drawn) {
  return Plan(variant, file_.ReadDrawn(episode, drawn)).plan;
}

EpisodeRow EpisodeMaker::Refused(const Variant& variant, std::uint64_t episode,
                                 const std::string& why) const {
  return Refused(variant, episode, file_.DrawnOf(episode), why);
}

EpisodeRow EpisodeMaker::Refused(const Variant& variant, std::uint64_t episode, const Drawn& drawn,
                                 const std::string& why) const {
  EpisodeRow row;
  row.variant = variant.name;
  row.episode = episode;
  row.outcome = Name(Outcome::kError);
  row.message = FromFolder(why, file_.file().parent_path());
  row.drawn = DrawnJson(drawn).dump();
  return row;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/suite_drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/params.h"
#include "run/episode/execute.h"
#include "run/scenario/plan_file.h"
#include "run/scenario/scenario_file.h"
#include "validate/parallel.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// A film of such a run is short, and one of fourteen.
constexpr const char* kVideo = "video: {width: 640, height: 360, fps: 15, max_frames: 180}\n";

// As a scenario names it, wherever that stands.
std::string NameAnywhere(const std::string& robot) {
  return FindRobotFile(robot, {}) == robot ? fs::absolute(robot).string() : robot;
}

// The scenario with what was set for every run; its comments are kept only where nothing was.
std::string WithOverrides(const std::string& text, const std::vector<Override>& overrides) {
  if (overrides.empty()) return text;
  ConfigNode root = ParseYaml(text, "suite");
  for (const Override& o : overrides)
    root.SetPath(o.key_path, ParseYaml(o.value, "--set " + o.key_path));
  return WriteYaml(root);
}

// Ends a drive when the suite is interrupted.
class UntilInterrupted final : public EpisodeObserver {
 public:
  bool OnControl(const EpisodeView&) override { return !Interrupted(); }
};

}  // namespace

SuiteDrive::SuiteDrive(const PluginEntry<Method>& entry, const std::string& robot_name,
                       const RobotModel& robot, const SuiteOptions& options)
    : name_(entry.name),
      robot_name_(NameAnywhere(robot_name)),
      method_(entry.make()),
      robot_(robot),
      options_(options) {}

SuiteRun SuiteDrive::Draw(int run, double size) const {
  return {.run = run, .size = size, .draw = DrawRun(options_.seed, name_, run)};
}

MethodDrive SuiteDrive::LayOut(const SuiteRun& run) const {
  return method_->LayOut({name_, robot_, run.draw, run.size});
}

std::string SuiteDrive::Text(const SuiteRun& run, const MethodDrive& drive, bool with_plan) const {
  // A path may hold what means something to YAML.
  std::string robot;
  for (const char c : robot_name_) robot += c == '\'' ? std::string("''") : std::string(1, c);
  const std::string plan =
      with_plan && !drive.plan.empty() ? fmt::format("plan: {{file: {}}}\n", kPlanFile) : "";
  return fmt::format(
      "# Run {} of the suite's method {}.\nscenario: 1\nname: {}\nrobot: {{name: '{}', mass_kg: "
      "{}}}\nseed: {}\nepisode: {}\n{}{}{}",
      run.run, name_, name_, robot, FormatDouble(run.draw.mass_share * robot_.spec.mass_kg),
      options_.seed, run.run, kVideo, drive.keys, plan);
}

Scenario SuiteDrive::Read(const SuiteRun& run) const {
  MethodDrive drive = LayOut(run);
  const ScenarioFile file = ScenarioFile::FromText(
      Text(run, drive, false), fs::absolute(name_ + ".yaml"), options_.overrides);
  Scenario scenario = file.Read(file.episode());
  if (drive.plan.empty()) return scenario;
  scenario.spec.plan_by = PlanBy::kFile;
  scenario.spec.promises = {};
  scenario.spec.planner_name.clear();
  scenario.spec.user_plan = std::move(drive.plan);
  scenario.spec.plan_file = kPlanFile;
  return scenario;
}

void SuiteDrive::Judge(const Scenario& scenario, SuiteRun& run) const {
  UntilInterrupted observer;
  const EpisodeRecord record = Execute(scenario, &observer).record;
  if (record.outcome == Outcome::kError)
    throw InternalError(
        fmt::format("{}: method {}, run {}, size {}", record.message, name_, run.run, run.size));
  if (record.outcome == Outcome::kInterrupted) return;
  run.verdict = method_->Judge({name_, robot_, run.draw, run.size}, record);
  run.duration_s = record.metrics.duration_s;
  run.friction = scenario.world.site.map.floor_friction;
  run.mass_kg = scenario.spec.robot_changes.mass_kg.value_or(scenario.world.robot.spec.mass_kg);
}

std::vector<SuiteRun> SuiteDrive::Drive(std::vector<SuiteRun> runs, bool all,
                                        const std::function<void(int driven)>& on_driven) const {
  // A robot of a user's own is read in a child process, which must find no other thread at work: a
  // few scenarios are read, then driven.
  const int chunk = 4 * options_.jobs;
  const int n = static_cast<int>(runs.size());
  std::mutex telling;
  int driven = 0;
  for (int from = 0; from < n; from += chunk) {
    const int count = std::min(chunk, n - from);
    std::vector<Scenario> scenarios;
    for (int i = 0; i < count; ++i)
      scenarios.push_back(Read(runs[static_cast<std::size_t>(from + i)]));
    std::atomic<int> first_failure = count;
    RunParallel(count, options_.jobs, [&](int i) {
      if (!all && i > first_failure) return;
      SuiteRun& run = runs[static_cast<std::size_t>(from + i)];
      Judge(scenarios[static_cast<std::size_t>(i)], run);
      {
        const std::lock_guard lock(telling);
        on_driven(++driven);
      }
      if (run.verdict.passed) return;
      for (int first = first_failure; i < first && !first_failure.compare_exchange_weak(first, i);)
        ;
    });
    if (Interrupted()) return {};
    if (!all && first_failure < count) {
      runs.resize(static_cast<std::size_t>(from + first_failure + 1));
      return runs;
    }
  }
  return runs;
}

void WriteRun(const PluginEntry<Method>& entry, const RobotModel& robot, const std::string& name,
              const SuiteRun& run, const SuiteOptions& options, const fs::path& folder) {
  const SuiteDrive drive(entry, name, robot, options);
  const MethodDrive laid_out = drive.LayOut(run);
  MakeFolder(folder);
  WriteFileWhole(folder / kRunFile,
                 WithOverrides(drive.Text(run, laid_out, true), options.overrides));
  if (!laid_out.plan.empty()) WriteFileWhole(folder / kPlanFile, PlanCsv(laid_out.plan));
}

}  // namespace floorproof

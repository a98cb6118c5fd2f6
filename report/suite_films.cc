// SPDX-License-Identifier: Apache-2.0
#include "report/suite_films.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/drive_and_film.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

ResultNames RunFiles() {
  return {"suite's run",
          [](std::string_view name) { return name == kRunFile || name == kPlanFile; }};
}

}  // namespace

void FilmMethod(const RobotSuite& robot, const RobotModel& model, const MethodResult& result,
                const SuiteOptions& options, const fs::path& folder) {
  if (result.runs.empty()) return;
  const SuiteRun& run = result.runs[result.shown];
  const fs::path into = folder / FilmFolder(robot, result.method);
  RefuseLinks(folder, into);
  const auto entry = std::ranges::find(Methods(), result.method, &PluginEntry<Method>::name);
  {
    ResultFolder files(into, RunFiles(), {});
    files.Begin();
    WriteRun(*entry, model, robot.robot, run, options, into);
  }
  Scenario scenario = ReadScenario(into / kRunFile, options.overrides, Trust::kFull);
  const Console silent{.quiet = true};
  const DriveResult drive = DriveAndFilm(scenario, into, {.video = true}, silent);
  if (drive.not_written) std::rethrow_exception(drive.not_written);
  const MethodVerdict now =
      entry->make()->Judge({result.method, model, run.draw, run.size}, drive.record);
  if (now.passed != run.verdict.passed || now.why != run.verdict.why ||
      now.figure != run.verdict.figure)
    throw InternalError(fmt::format("{}: the film's run does not end as it did: '{}', not '{}'",
                                    into.string(), now.why, run.verdict.why));
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "report/drive_and_film.h"
#include "report/run_page.h"
#include "run/episode/records.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {

void AddRun(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string scenario, out;
    int seed = -1;
    bool video = false;
  };
  auto options = std::make_shared<Options>();
  Subcommand command =
      line.Add("run", "Plan, drive the plan through physics once, and judge it (one episode)");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.NonNegative("--seed", options->seed, "Overrides the scenario's seed");
  command.Text("--out", options->out, kOutputHelp);
  command.Flag("--video", options->video, "Film it: video.mp4 and frame_*.png");
  command.OnRun([options, &globals, &status] {
    auto overrides = globals.Overrides();
    if (options->seed >= 0) overrides.push_back({"seed", std::to_string(options->seed)});
    Scenario scenario = ReadScenario(options->scenario, overrides, globals.trust());
    const std::filesystem::path folder =
        OutputFolder(options->out, scenario.spec.file, scenario.spec.name);
    SayDrawn(scenario.spec, globals);
    if (!scenario.text.matrix.IsNull())
      globals.Say("this is the scenario itself: `campaign` drives the variants of its matrix");
    const DriveResult result = DriveAndFilm(scenario, folder, {.video = options->video}, globals);
    globals.Result(ResultJson(scenario, result.record));
    if (result.not_written) std::rethrow_exception(result.not_written);
    if (result.record.steps > 0)
      globals.SayFact("Page", WriteRunReport(folder, folder.string()).page.string());
    globals.SayFact("Results", folder.string());
    status = ExitStatus(result.record.outcome);
  });
}

}  // namespace floorproof

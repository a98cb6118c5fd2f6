// SPDX-License-Identifier: Apache-2.0
#include "apps/drive_and_film.h"
#include "env/run/records.h"

namespace floorproof {

void AddRun(CLI::App& app, const Globals& globals, int& status) {
  struct Options {
    std::string scenario, out;
    int seed = -1;
    bool video = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "run", "Plan, drive the plan through physics once, and judge it (one episode)");
  command->add_option("SCENARIO", options->scenario, "Scenario file (YAML)")->required();
  command->add_option("--seed", options->seed, "Overrides the scenario's seed")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", options->out, "Output folder (default: out/<scenario's stem>)");
  command->add_flag("--video", options->video, "Film it: video.mp4 and frame_*.png");
  command->callback([options, &globals, &status] {
    auto overrides = globals.Overrides();
    if (options->seed >= 0) overrides.push_back({"seed", std::to_string(options->seed)});
    Scenario scenario = ReadScenario(options->scenario, overrides);
    const auto folder = OutputFolder(options->out, scenario);
    if (!scenario.matrix.IsNull())
      globals.Say("this is the scenario itself: `campaign` drives the variants of its matrix");
    const DriveResult result = DriveAndFilm(scenario, folder, {.video = options->video}, globals);
    globals.Result(ResultJson(scenario, result.record));
    if (result.not_written) std::rethrow_exception(result.not_written);
    globals.Say("results are in " + folder.string());
    status = ExitStatus(result);
  });
}

}  // namespace floorproof

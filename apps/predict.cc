// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/progress_line.h"
#include "base/quantity.h"
#include "base/result_folder.h"
#include "report/predict_picture.h"
#include "report/save_plan.h"
#include "run/episode/records.h"
#include "run/plan_check/plan_check.h"
#include "run/plan_check/prediction.h"
#include "run/scenario/scenario_file.h"
#include "run/scenario/warnings.h"

namespace floorproof {

void AddPredict(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string scenario, model, out;
    int draws = 256;
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add(
      "predict", "How often a plan will fail, by a robot's measured rates: predict.json, a map");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.Text("--model", options->model,
               "The robot's risk_model.json (floorproof measure); instead of the key risk.model");
  command.Integer("--draws", options->draws, "Conditions drawn by `randomise`", 1, 100'000);
  command.Text("--out", options->out, kOutputHelp);
  command.OnRun([options, &globals, &status] {
    std::vector<Override> overrides = globals.Overrides();
    if (!options->model.empty())
      overrides.push_back({"risk.model", std::filesystem::absolute(options->model).string()});
    const ScenarioFile file(options->scenario, overrides, globals.trust());
    const Scenario scenario = file.Read(file.episode());
    for (const std::string& warning : Warnings(scenario)) globals.Say(warning);
    if (!scenario.text.matrix.IsNull())
      globals.Say(
          "warning: `matrix` is passed over: this is the scenario itself (--set names what a "
          "variant changes)");
    const std::filesystem::path folder =
        OutputFolder(options->out, scenario.spec.file, scenario.spec.name);
    ResultFolder out(folder, EpisodeResults(), InputsOf(scenario));
    ProgressLine progress(globals);
    const Prediction prediction = Predict(file, {}, options->draws, [&](int done) {
      if (progress.IsDue())
        progress.Show("  " + std::to_string(done) + " of " +
                      CountText(options->draws, "condition"));
    });
    progress.Clear();
    const nlohmann::ordered_json plan = SavePlan(scenario, prediction.plan, out, {});
    const nlohmann::ordered_json json = PredictionJson(scenario, prediction, plan);
    WriteFileWhole(folder / "predict.json", JsonText(json) + "\n");
    WritePredictPicture(scenario.world, prediction, folder / "heatmap_predict.png");
    globals.Say(SweptText(prediction.plan, plan));
    for (const std::string& said : PredictionLines(prediction)) globals.Say(said);
    globals.SayFact("Results", folder.string());
    globals.Result(json);
    status = kExitDone;
  });
}

}  // namespace floorproof

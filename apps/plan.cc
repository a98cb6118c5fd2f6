// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/interrupt.h"
#include "base/quantity.h"
#include "base/result_folder.h"
#include "report/save_plan.h"
#include "run/episode/floor_audit.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/plan_check/plan_check.h"
#include "run/scenario/warnings.h"

namespace floorproof {

void AddPlan(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string scenario, out;
    std::vector<std::string> beside;
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add(
      "plan", "Plan only: plan.csv, plan.json and pictures; risk.csv where risk is asked for");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.Text("--out", options->out, kOutputHelp);
  command.Texts("--beside", options->beside,
                "Scenarios of the same floor and robot, whose plans plot_risk.png shows too");
  command.OnRun([options, &globals, &status] {
    Scenario scenario = ReadScenario(options->scenario, globals.Overrides());
    for (const std::string& warning : Warnings(scenario)) globals.Say(warning);
    if (const PlanCommand* program = ProgramToAsk(scenario)) globals.Say(ProgramLine(*program));
    SayDrawn(scenario, globals);
    const std::filesystem::path folder = OutputFolder(options->out, scenario.file, scenario.name);
    ResultFolder out(folder, EpisodeResults(), InputsOf(scenario));
    const PlanResult plan = MakePlan(scenario);
    if (scenario.dirt && scenario.dirt->cleaning.rounds > 0 && !plan.samples.empty() &&
        plan.status == PlanStatus::kSuccess)
      CleanerPlan(scenario, *plan.risk);  // else its drive would be the first to try
    const std::vector<RiskOfPlan> beside =
        PlansBeside(options->beside, globals.Overrides(), MeasurePlan(scenario, plan), globals);
    nlohmann::ordered_json json = SavePlan(scenario, plan, out, beside);
    const bool found = plan.status == PlanStatus::kSuccess;
    if (found) {
      if (plan.samples.empty()) {
        globals.Say(SweptText(plan, json));
        if (!plan.message.empty()) globals.Say(plan.message);
        if (json["coverage"].get<double>() < scenario.episode.min_coverage)
          globals.Say(
              fmt::format("warning: success.min_coverage asks for {:g} %: a drive of this "
                          "plan can hardly be a success",
                          100 * scenario.episode.min_coverage));
      } else {  // of samples out of reach the check's lines say more than the message
        globals.Say(PlannedText(plan) + ", " + CountText(plan.samples.size(), "sample"));
      }
      const PlanCheck check = CheckPlan(scenario, plan);
      for (const std::string& said : PlanLines(scenario, plan, check)) globals.Say(said);
      json["check"] = PlanCheckJson(scenario, check);
    } else {
      globals.Say(fmt::format("no plan ({}): {}", Name(plan.status), plan.message));
    }
    globals.SayFact("Results", folder.string());
    globals.Result(json);
    status = found ? kExitDone : kExitNotSuccess;
  });
}

}  // namespace floorproof

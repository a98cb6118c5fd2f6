// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/command.h"
#include "apps/pictures.h"
#include "env/core/interrupt.h"
#include "env/run/file_output.h"
#include "env/run/records.h"

namespace floorproof {

void AddPlan(CLI::App& app, const Globals& globals, int& status) {
  struct Options {
    std::string scenario, out;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plan", "Plan only: plan.csv, plan.json and a picture");
  command->add_option("SCENARIO", options->scenario, "Scenario file (YAML)")->required();
  command->add_option("--out", options->out, "Output folder (default: out/<scenario's stem>)");
  command->callback([options, &globals, &status] {
    const Scenario scenario = ReadScenario(options->scenario, globals.Overrides());
    SayWarnings(scenario, globals);
    const auto folder = OutputFolder(options->out, scenario);
    const PlanResult plan = MakePlan(scenario);
    const auto json = PlanJson(scenario, plan);
    MakeFolder(folder);
    SayWhenInterrupted(folder.string() + " may lack some of the plan's files");
    WritePlanFiles(scenario, plan, folder);
    SayWhenInterrupted(folder.string() + " holds the plan; its picture may be missing");
    WritePlanPicture(scenario, plan, folder);
    SayWhenInterrupted(folder.string() + " holds the plan");
    const bool found = plan.status == PlanStatus::kSuccess;
    if (found)
      globals.Say(fmt::format("planned: {} waypoints, {:.1f} m, {} turns, covers {:.1f} %",
                              plan.path.size(), Length(plan.path), CountTurns(plan.path),
                              100 * json["coverage"].get<double>()));
    else
      globals.Say(fmt::format("no plan ({}): {}", Name(plan.status), plan.message));
    globals.Say("results are in " + folder.string());
    globals.Result(json);
    status = found ? kDone : kNotSuccess;
  });
}

}  // namespace floorproof

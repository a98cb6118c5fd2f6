// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/interrupt.h"
#include "report/risk_pictures.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/scenario/warnings.h"

namespace floorproof {
namespace {

bool SameFloor(const RiskOfPath& a, const RiskOfPath& b) {
  return std::ranges::equal(a.ranges, b.ranges, [](const auto& x, const auto& y) {
    return x.low == y.low && x.high == y.high && x.cells == y.cells;
  });
}

std::vector<RiskOfPlan> PlansBeside(const std::vector<std::string>& files, const RiskOfPlan& first,
                                    const Globals& globals) {
  std::vector<RiskOfPlan> plans;
  for (const std::string& file : files) {
    const Scenario scenario = ReadScenario(file, globals.Overrides());
    const PlanResult plan = MakePlan(scenario);
    if (plan.status != PlanStatus::kSuccess)
      throw InputError({file, 0}, "", "", "has no plan: " + plan.message);
    plans.push_back(MeasurePlan(scenario, plan));
    if (plans.back().label == first.label) plans.back().label += " of " + scenario.name;
    if (!SameFloor(first.risk, plans.back().risk))
      throw InputError(
          {file, 0}, "", "",
          "has another floor, robot or risk: its plan cannot stand beside the first's");
  }
  return plans;
}

}  // namespace

void AddPlan(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string scenario, out;
    std::vector<std::string> beside;
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add("plan", "Plan only: plan.csv, plan.json, risk.csv and pictures");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.Text("--out", options->out, "Output folder (default: out/<scenario's stem>)");
  command.Texts("--beside", options->beside,
                "Scenarios of the same floor and robot, whose plans plot_risk.png shows too");
  command.OnRun([options, &globals, &status] {
    const Scenario scenario = ReadScenario(options->scenario, globals.Overrides());
    for (const std::string& warning : Warnings(scenario)) globals.Say(warning);
    const auto folder = OutputFolder(options->out, scenario.file);
    const PlanResult plan = MakePlan(scenario);
    const auto json = PlanJson(scenario, plan);
    const std::vector<RiskOfPlan> beside =
        PlansBeside(options->beside, MeasurePlan(scenario, plan), globals);
    MakeFolder(folder);
    SayWhenInterrupted(folder.string() + " may lack some of the plan's files");
    WritePlanFiles(scenario, plan, folder);
    SayWhenInterrupted(folder.string() + " holds the plan; pictures may be missing");
    WritePlanPictures(scenario, plan, folder, beside);
    SayWhenInterrupted(folder.string() + " holds the plan");
    const bool found = plan.status == PlanStatus::kSuccess;
    if (found) {
      globals.Say(fmt::format("planned: {} waypoints, {:.1f} m, {} turns, covers {:.1f} %",
                              plan.path.size(), Length(plan.path), CountTurns(plan.path),
                              100 * json["coverage"].get<double>()));
      if (!plan.message.empty()) globals.Say(plan.message);
    } else {
      globals.Say(fmt::format("no plan ({}): {}", Name(plan.status), plan.message));
    }
    globals.Say("results are in " + folder.string());
    globals.Result(json);
    status = found ? kDone : kNotSuccess;
  });
}

}  // namespace floorproof

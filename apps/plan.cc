// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/comma_list.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/quantity.h"
#include "base/result_folder.h"
#include "report/save_plan.h"
#include "run/episode/floor_audit.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/plan_check/plan_check.h"
#include "run/scenario/scenario_file.h"
#include "run/scenario/warnings.h"

namespace floorproof {
namespace {

// The faults of a list with commas between.
std::vector<std::string> ReadFaults(const std::string& list) {
  const std::vector<std::string> known(kPlanFaults.begin(), kPlanFaults.end());
  std::vector<std::string> faults = SplitAtCommas(list);
  for (const std::string& fault : faults)
    if (std::ranges::find(known, fault) == known.end())
      throw InputError({"--allow", 0}, "", fault, "unknown fault" + DidYouMeanOneOf(fault, known));
  return faults;
}

}  // namespace

void AddPlan(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string scenario, out, allow;
    std::vector<std::string> beside;
    bool strict = false;
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add(
      "plan", "Plan only: plan.csv, plan.json and pictures; risk.csv where risk is asked for");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.Text("--out", options->out, kOutputHelp);
  command.Texts("--beside", options->beside,
                "Scenarios of the same floor and robot, whose plans plot_risk.png shows too");
  command.Flag("--strict", options->strict,
               "Exit status 1 if the plan overlaps an obstacle, has a coverage gap or an "
               "unreachable sample, or has a warning");
  command.Text("--allow", options->allow,
               "With --strict: faults to accept, with commas between (overlap,gap,warning)");
  command.OnRun([options, &globals, &status] {
    const std::vector<std::string> allowed = ReadFaults(options->allow);
    if (!allowed.empty() && !options->strict)
      throw InputError({"--allow", 0}, "", options->allow, "accepts faults of --strict alone");
    Scenario scenario = ReadScenario(options->scenario, globals.Overrides(), globals.trust());
    std::vector<std::string> lines = Warnings(scenario);
    for (const std::string& warning : lines) globals.Say(warning);
    if (const std::string runs = ProgramAnnounced(scenario); !runs.empty()) globals.Say(runs);
    SayDrawn(scenario.spec, globals);
    const std::filesystem::path folder =
        OutputFolder(options->out, scenario.spec.file, scenario.spec.name);
    ResultFolder out(folder, EpisodeResults(), InputsOf(scenario));
    const PlanResult plan = MakePlan(scenario);
    if (scenario.world.dirt && scenario.world.dirt->cleaning.rounds > 0 && !plan.samples.empty() &&
        plan.status == PlanStatus::kSuccess)
      CleanerPlan(scenario, *plan.risk);  // else its drive would be the first to try
    const std::vector<RiskOfPlan> beside =
        PlansBeside(options->beside, globals.Overrides(), MeasurePlan(scenario.spec, plan),
                    globals.trust(), globals);
    nlohmann::ordered_json json = SavePlan(scenario, plan, out, beside);
    const bool found = plan.status == PlanStatus::kSuccess;
    std::vector<std::string> faults;
    if (found) {
      if (plan.samples.empty()) {
        globals.Say(SweptText(plan, json));
        if (!plan.message.empty()) globals.Say(plan.message);
        constexpr double kDriveLoss = 0.02;  // of coverage, against the plan (docs/plan.md)
        if (const double asked = scenario.spec.episode.min_coverage;
            asked > 0 && json["coverage"].get<double>() < asked + kDriveLoss) {
          lines.push_back(
              fmt::format("warning: success.min_coverage asks for {:g} %, but a drive "
                          "covers about 2 percentage points less than its plan",
                          100 * asked));
          globals.Say(lines.back());
        }
      } else {  // of samples out of reach the check's lines say more than the message
        globals.Say(PlannedText(plan) + ", " + CountText(plan.samples.size(), "sample"));
      }
      const PlanCheck check = CheckPlan(scenario, plan);
      for (std::string& said : PlanLines(scenario, plan, check)) {
        globals.Say(said);
        lines.push_back(std::move(said));
      }
      json["check"] = PlanCheckJson(scenario.world, check);
      faults = PlanFaults(scenario, plan, check, lines);
      json["faults"] = faults;
    } else {
      globals.Say(fmt::format("no plan ({}): {}", Name(plan.status), plan.message));
    }
    globals.SayFact("Results", folder.string());
    globals.Result(json);
    std::string refused;
    for (const std::string& fault : faults)
      if (options->strict && std::ranges::find(allowed, fault) == allowed.end())
        refused += (refused.empty() ? "" : ",") + fault;
    if (!refused.empty())
      globals.Say("plan rejected by --strict: " + refused + " (--allow " + refused +
                  " accepts this)");
    status = found && refused.empty() ? kExitDone : kExitNotSuccess;
  });
}

}  // namespace floorproof

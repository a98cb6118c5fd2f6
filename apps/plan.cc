// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/command.h"
#include "base/error.h"
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
namespace {

constexpr const char* kFaults[] = {"overlap", "gap", "warning"};

std::set<std::string> FaultsAllowed(const std::vector<std::string>& allowed) {
  const std::vector<std::string> known(std::begin(kFaults), std::end(kFaults));
  for (const std::string& fault : allowed)
    if (std::ranges::find(known, fault) == known.end())
      throw InputError({"--allow", 0}, "", fault,
                       "is none of overlap, gap, warning" + DidYouMeanOneOf(fault, known));
  return {allowed.begin(), allowed.end()};
}

// Which of kFaults a plan has. `lines`: all lines printed about it.
std::set<std::string> FaultsOf(const PlanResult& plan, const PlanCheck& check,
                               const std::vector<std::string>& lines) {
  std::set<std::string> faults;
  if (!check.clearance.conflicts.empty()) faults.insert("overlap");
  const bool missed =
      plan.samples.empty()
          ? std::ranges::any_of(check.uncovered.pockets,
                                [](const UncoveredPocket& pocket) {
                                  return pocket.why == UncoveredPocket::Why::kNotVisited;
                                })
          : std::ranges::any_of(plan.samples, [](const auto& place) { return !place.reachable; });
  if (missed) faults.insert("gap");
  const std::string overlaps = ConflictsLine(check.clearance);
  for (const std::string& line : lines)
    if (line.starts_with("warning: ") && (overlaps.empty() || !line.starts_with(overlaps)))
      faults.insert("warning");
  return faults;
}

}  // namespace

void AddPlan(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string scenario, out;
    std::vector<std::string> beside, allow;
    bool strict = false;
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add(
      "plan", "Plan only: plan.csv, plan.json and pictures; risk.csv where risk is asked for");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.Text("--out", options->out, kOutputHelp);
  command.Texts("--beside", options->beside,
                "Scenarios of the same floor and robot, whose plans plot_risk.png shows too");
  command.Flag(
      "--strict", options->strict,
      "Exit status 1 for a plan that overlaps an obstacle, leaves out what it could reach, "
      "or has a warning");
  command.Texts("--allow", options->allow,
                "With --strict: what is let pass of overlap, gap, warning");
  command.OnRun([options, &globals, &status] {
    const std::set<std::string> allowed = FaultsAllowed(options->allow);
    Scenario scenario = ReadScenario(options->scenario, globals.Overrides());
    std::vector<std::string> lines = Warnings(scenario);
    for (const std::string& warning : lines) globals.Say(warning);
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
    std::set<std::string> faults;
    if (found) {
      if (plan.samples.empty()) {
        globals.Say(SweptText(plan, json));
        if (!plan.message.empty()) globals.Say(plan.message);
        constexpr double kDriveLoss = 0.02;  // docs/plan.md: what a drive covers less than its plan
        if (const double asked = scenario.episode.min_coverage;
            asked > 0 && json["coverage"].get<double>() < asked + kDriveLoss) {
          lines.push_back(
              fmt::format("warning: success.min_coverage asks for {:g} %, and a drive "
                          "covers some 2 points less than its plan",
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
      json["check"] = PlanCheckJson(scenario, check);
      faults = FaultsOf(plan, check, lines);
      for (const std::string& fault : allowed) faults.erase(fault);
      json["faults"] = faults;
    } else {
      globals.Say(fmt::format("no plan ({}): {}", Name(plan.status), plan.message));
    }
    globals.SayFact("Results", folder.string());
    globals.Result(json);
    const bool refused = options->strict && !faults.empty();
    if (refused) {
      std::string text;
      for (const std::string& fault : faults) text += (text.empty() ? "" : ", ") + fault;
      globals.Say("refused by --strict: " + text);
    }
    status = found && !refused ? kExitDone : kExitNotSuccess;
  });
}

}  // namespace floorproof

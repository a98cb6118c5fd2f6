// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/campaign_line.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/params.h"
#include "base/quantity.h"
#include "base/shell_word.h"
#include "measure/drive_encounters.h"
#include "measure/drive_plans.h"
#include "measure/risk_files.h"
#include "report/campaign_words.h"
#include "report/measure_page.h"
#include "run/campaign/summary_json.h"
#include "run/scenario/override.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// Of each variant.
std::uint64_t EnoughEpisodes(std::size_t variants) {
  constexpr std::size_t kEncounters = 20'000;
  return (kEncounters + variants - 1) / variants;
}

struct MeasureCommand : CampaignArguments {
  std::string robot;
  int floors = 80;
  std::optional<double> recoverable_mm, lasting_mm;
};

DamageLimits LimitsOf(const MeasureCommand& options) {
  DamageLimits limits;
  if (options.recoverable_mm) limits.recoverable_drop_m = *options.recoverable_mm / 1000;
  if (options.lasting_mm) limits.lasting_drop_m = *options.lasting_mm / 1000;
  if (limits.recoverable_drop_m > limits.lasting_drop_m)
    throw InputError(
        {"--recoverable-drop", 0}, "", FormatDouble(1000 * limits.recoverable_drop_m),
        "must not be more than --lasting-drop, " + FormatDouble(1000 * limits.lasting_drop_m));
  return limits;
}

// Rates are kept for the robot as its model's file has it; mass and clearance are drawn, or set.
void RefuseOtherRobots(const std::vector<Override>& overrides) {
  for (const Override& each : overrides) {
    const bool is_robot = each.key_path == "robot" || each.key_path.starts_with("robot.") ||
                          each.key_path.starts_with("battery");
    if (!is_robot || each.key_path == "robot.mass_kg" || each.key_path == "robot.clearance_m")
      continue;
    throw InputError({"--set", 0}, each.key_path, each.value,
                     "is another robot than its model's file, for which rates are kept: measure a "
                     "model of its own");
  }
}

// Drives plans over small floors, and adds to the model in the folder what they say of it. Gives
// the exit status.
int AddPlans(const MeasureCommand& options, const Globals& globals, const fs::path& folder,
             RiskModel& model) {
  constexpr std::uint64_t kDrives = 1;  // of a plan: they mostly end alike
  if (options.floors == 0) return kExitDone;
  const std::vector<Override> overrides = OverridesOf(globals, options);
  const RobotCampaign campaign = PlansOf(options.robot, options.floors, overrides);
  const fs::path plans = folder / "plans";
  CampaignLine progress(globals, campaign.file.variants());
  const CampaignOutcome outcome =
      DriveRobotCampaign(campaign,
                         {.episodes = kDrives,
                          .jobs = RequestOf(options).jobs,
                          .resume = fs::exists(plans / "campaign.sqlite")},
                         plans, &progress);
  progress.Clear();
  if (outcome.run.end == CampaignEnd::kInterrupted) throw Interruption();
  WriteRiskModel(model, plans);  // rates alone, by which the plans are predicted
  model.carry_over =
      LearnCarryOver(options.robot, options.floors, overrides, outcome.summary, plans);
  int errors = 0;
  std::string first;
  for (const VariantSummary& plan : outcome.summary.variants) {
    if (plan.errors > 0 && errors == 0) first = plan.name + ": " + plan.first_error;
    errors += plan.errors;
  }
  if (errors > 0)
    globals.Say("warning: of the plans' drives " + CountText(errors, "error") + ", the first, " +
                first);
  const auto plans_driven = static_cast<int>(outcome.summary.variants.size());
  if (model.carry_over.plans > 0 && model.carry_over.plans < plans_driven)
    globals.Say("warning: of " + CountText(plans_driven, "plan") + " " +
                std::to_string(plans_driven - model.carry_over.plans) +
                " were not driven, or meet what no rate is known of, and say nothing of the rates");
  if (model.carry_over.plans == 0)
    globals.Say(
        "warning: no plan over these floors could be driven and predicted: the rates are held "
        "against none");
  SayQuietErrors(outcome.summary, globals);
  return CampaignExitStatus(outcome);
}

int RunMeasure(const MeasureCommand& options, const Globals& globals) {
  const DamageLimits limits = LimitsOf(options);
  RefuseOtherRobots(OverridesOf(globals, options));
  const RobotCampaign campaign = EncountersOf(options.robot, OverridesOf(globals, options));
  CampaignRequest request = RequestOf(options);
  if (options.n == 0) request.episodes = EnoughEpisodes(campaign.file.variants().size());
  constexpr std::uint64_t kFewOfEach = 80;  // of which 50 and more have an outcome
  if (request.episodes < kFewOfEach && !request.shard)
    globals.Say("warning: fewer than " + std::to_string(kFewOfEach) +
                " drives of each meeting: of some kinds too few will have an outcome for rates; "
                "--resume with a larger -n goes on");
  const fs::path folder =
      options.out.empty() ? fs::path("out") / "measure" / campaign.label : fs::path(options.out);
  CampaignLine progress(globals, campaign.file.variants());
  CampaignOutcome outcome = DriveRobotCampaign(campaign, request, folder, &progress);
  progress.Clear();
  globals.Result(SummaryJson(outcome.summary));
  globals.Say(EncounterTable(outcome.summary));
  int plans_status = kExitDone;
  bool fitted = false;
  if (!request.shard && outcome.run.end == CampaignEnd::kComplete) {
    if (auto model = FitRiskModel(outcome.store, ReadRobot(FindRobotFile(options.robot, {})),
                                  limits, folder)) {
      // What is there may be held against plans already; that is kept until this one is, too.
      if (!fs::exists(folder / "risk_model.json")) WriteRiskModel(*model, folder);
      plans_status = AddPlans(options, globals, folder, *model);
      WriteRiskModel(*model, folder);
      for (const std::string& line : RiskModelLines(*model)) globals.Say(line);
      fitted = true;
    } else {
      globals.Say("warning: no kind of hazard was met often enough: no rates are fitted");
    }
  }
  globals.SayFact("Results", folder.string());
  if (outcome.run.end == CampaignEnd::kInterrupted) throw Interruption();
  SayQuietErrors(outcome.summary, globals);
  const int status = CampaignExitStatus(outcome);
  if (fitted) {
    // The page is made from what is recorded alone, which is let go of for it.
    outcome.folder.reset();
    { const CampaignStore whole = std::move(outcome.store); }
    try {
      const WrittenReport written = WriteMeasureReport(folder, folder.string());
      globals.Say(written.verdict);
      globals.SayFact("Page", written.page.string());
    } catch (const std::runtime_error& e) {  // what was measured is whole without it
      globals.Say("warning: no page: " + std::string(e.what()) + "; `floorproof report " +
                  ShellWord(folder.string()) + "` makes one");
    }
  }
  return status != kExitDone ? status : plans_status;
}

}  // namespace

void AddMeasure(CommandLine& line, const Globals& globals, int& status) {
  auto options = std::make_shared<MeasureCommand>();
  options->n = 0;
  Subcommand command = line.Add(
      "measure", "Drive a robot's single encounters with hazards of every type, as a campaign");
  command.Text("ROBOT", options->robot, "A robot's name (floorproof list robots), or its MJCF file",
               Subcommand::Need::kRequired);
  command.Integer("-n", options->n,
                  "Drives of each meeting (default: so many that there are 20,000 in all)", 1,
                  kMostEpisodes);
  command.NonNegative("--seed", options->seed, "Of the encounters' draws (default: 0)");
  command.Integer("--jobs", options->jobs, "Worker processes (default: one a core)", 1, kMostJobs);
  command.Integer("--floors", options->floors,
                  "Small floors that plans are driven over, to see what rates come to in whole "
                  "plans (default: 80; 0: none)",
                  0, 1000);
  command.Text("--episodes", options->episodes, "A:B, ids from A to before B only: a shard");
  command.Text("--out", options->out, "Output folder (default: out/measure/ROBOT)");
  command.Number("--recoverable-drop", options->recoverable_mm,
                 "Damage that can be put right: by a fall or blow as hard as when one edge of the "
                 "robot drops from so high (mm; default: 25)",
                 0, 1e4);
  command.Number("--lasting-drop", options->lasting_mm,
                 "Lasting damage, likewise (mm; default: 100)", 0, 1e4);
  command.Flag("--resume", options->resume, "Go on with what the folder holds");
  command.OnRun([options, &globals, &status] { status = RunMeasure(*options, globals); });
}

}  // namespace floorproof

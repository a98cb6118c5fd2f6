// SPDX-License-Identifier: Apache-2.0
#include "run/rare/rare_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/quantity.h"
#include "run/campaign/campaign_about.h"
#include "run/episode/records.h"
#include "run/rare/rare_json.h"
#include "run/scenario/agents.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "run/scenario/warnings.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTrials = "trials.sqlite";

// Of these trials' draws none may stand beside another search's.
CampaignAbout Describe(const ScenarioFile& file, const RareRequest& request) {
  CampaignAbout about = DescribeCampaign(file);
  ConfigNode scenario = ParseYaml(about.scenario, "scenario");
  ConfigNode rare = ConfigNode::Map();
  rare.Add("mode", ConfigNode::Scalar(request.mode));
  rare.Add("target_cov", ConfigNode::Scalar(FormatDouble(request.settings.target_cov)));
  rare.Add("max_n", ConfigNode::Scalar(std::to_string(request.settings.max_trials)));
  scenario.Add("rare", std::move(rare));
  about.scenario = WriteYaml(scenario);
  about.id = Sha256(about.scenario + about.versions).substr(0, 16);
  return about;
}

void CheckRequest(const RareRequest& request) {
  const std::uint64_t fewest = FewestTrials(request.settings.target_cov);
  if (request.settings.max_trials < fewest)
    throw InputError(
        {"--max-n", 0}, "", std::to_string(request.settings.max_trials),
        fmt::format("--target-cov {} takes {} or more", FormatDouble(request.settings.target_cov),
                    CountText(fewest, "drive")));
  CheckRareSettings(request.settings);
}

bool HoldsSearch(const fs::path& folder, bool resume) {
  return HoldsDatabase(folder, kTrials, "a search", resume);
}

// A scenario that most draws make impossible has no failure rate.
void RefuseErrors(const RareTrials& trials, std::size_t driven) {
  constexpr double kMost = 0.2;
  if (static_cast<double>(trials.errors()) <= kMost * static_cast<double>(driven)) return;
  throw InputError({}, "", "",
                   fmt::format("{} of the first {} are errors or have no plan: {}", trials.errors(),
                               CountText(driven, "drive"), trials.first_error()));
}

}  // namespace

const LikelyFailure* FailureOf(const RareOutcome& outcome, std::size_t region) {
  const auto found = std::ranges::find(outcome.failures, region, &LikelyFailure::region);
  return found == outcome.failures.end() ? nullptr : &*found;
}

ResultNames RareResults() {
  return {"rare", [](std::string_view name) {
            return name == "rare.json" || name == "rare.html" || name == "scenario.resolved.yaml";
          }};
}

RareOutcome SearchRare(const ScenarioFile& file, const RareRequest& request, const fs::path& folder,
                       RareObserver* observer) {
  CheckRequest(request);
  const Scenario base = file.Read(std::nullopt);
  SayWhenInterrupted(folder.string() + " is as before");
  const auto warn = [&](const std::string& line) {
    if (observer) observer->OnWarning(line);
  };
  for (const std::string& warning : Warnings(base)) warn(warning);
  if (!base.text.matrix.IsNull())
    warn(
        "warning: `matrix` is passed over: this is the scenario itself (--set names what a variant "
        "changes)");
  if (base.spec.episode.drive == "none")
    throw InputError({file.file().string(), 0}, "drive", "none",
                     "nothing that is not driven fails");
  const RareScore score(request.mode, MakeDetectors(base.spec));
  const RareCoordinates coordinates(file, base);
  const std::optional<RareGate> gate = RareGate::Read(base.text.gate, request.mode);
  if (!base.text.gate.IsNull() && !gate)
    warn(
        "warning: the scenario's gate is a campaign's (`mode` is not rare), and is not judged "
        "here");
  EpisodeMaker maker(file);
  const CampaignAbout about = Describe(file, request);
  if (const std::string line = ProgramAnnounced(base); !line.empty()) {
    warn(line);
  } else {
    const PlanResult& plan =
        maker.PlanDrawn(RareTrials::TrialVariant(), 0,
                        coordinates.DrawnAt(Eigen::VectorXd::Zero(coordinates.size())));
    if (plan.status != PlanStatus::kSuccess)
      throw InputError({file.file().string(), 0}, "plan", "",
                       "there is none of the scenario's middle: " + plan.message);
  }

  RareOutcome out;
  out.hold = std::make_unique<HoldInterrupts>();
  HoldsSearch(folder, request.resume);
  out.folder = std::make_unique<ResultFolder>(folder, RareResults(), file.files().All());
  out.name = file.name();
  out.mode = request.mode;
  out.settings = request.settings;
  out.settings.seed = static_cast<std::uint64_t>(file.seed());
  out.coordinates = coordinates.keys();
  out.noisy = coordinates.noisy();
  try {
    out.folder->Lock();
    CampaignStore store =
        OpenOrCreate(folder / kTrials, about, HoldsSearch(folder, request.resume));
    if (request.retry_errors) store.DropFromFirstError(RareTrials::TrialVariant().name);
    out.folder->Begin();
    SayWhenInterrupted("every drive so far is kept in " + folder.string() +
                       "; the same command with --resume goes on");
    WriteResolvedScenario(base, folder, file.files().All());

    std::string stage;
    RareTrials trials(maker, coordinates, score, store, request.jobs,
                      [&](const RareProgress& progress) {
                        if (observer) observer->OnProgress(stage, progress);
                      });
    bool first = true;
    const RareProblem problem{coordinates.size(), coordinates.noisy(),
                              [&](std::span<const Trial> batch) {
                                auto results = trials.Evaluate(batch);
                                if (std::exchange(first, false)) RefuseErrors(trials, batch.size());
                                return results;
                              }};
    out.estimate =
        EstimateRare(problem, out.settings, [&](const std::string& next) { stage = next; });
    out.errors = trials.errors();
    out.first_error = trials.first_error();
    for (std::size_t r = 0; r < out.estimate.regions.size(); ++r) {
      const FailureRegion& region = out.estimate.regions[r];
      if (!region.searched) continue;
      out.failures.push_back(
          {r, coordinates.AsSet(region.likeliest), trials.RowOf(region.likeliest)});
    }
    if (gate) out.verdict = gate->Judge(out.estimate, out.errors);
    store.Settle();
    WriteFileWhole(folder / "rare.json", JsonText(RareJson(out)) + "\n");
    store.RequireInPlace();
    out.folder->RequireInPlace({kTrials, "scenario.resolved.yaml"});
  } catch (const DiskError& e) {
    throw InternalError(std::string(e.what()) + "; missing: rare.json; --resume goes on");
  }
  return out;
}

}  // namespace floorproof

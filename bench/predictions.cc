// SPDX-License-Identifier: Apache-2.0
// Does it hold? Plans of sites that nobody has driven: how often each will fail is predicted by a
// robot's measured rates, and by predictors that know none; then all are driven, and the
// predictions judged (docs/measured-risk.md).
//   bench_predictions KEY=VALUE ...      the keys: struct Study; `robot`, `measured` must be given
// Predictions are written, with their SHA-256, before the drives that they are judged by. Called
// again with the same `out` it goes on where it was.
#include <fmt/format.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/params.h"
#include "bench/study_figures.h"
#include "bench/study_main.h"
#include "bench/study_predictors.h"
#include "bench/study_sites.h"
#include "measure/risk_files.h"
#include "measure/shared_frailty.h"
#include "run/campaign/drive_campaign.h"
#include "run/episode/records.h"
#include "run/scenario/risk_model_file.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Study : Configurable {
  std::string robot = "beluga", measured, out = "out/predictions", drives, maps;
  int training = 20, sites = 100, map_sites = 8, episodes = 50, jobs = 1;
  double minutes = 1e6;
  void Visit(ParamVisitor& v) override {
    v("robot", robot, {}, "its name, or its MJCF file");
    v("measured", measured, {}, "folder of `floorproof measure`: model, and training encounters");
    v("out", out, {}, "folder of predictions and figures");
    v("drives", drives, {}, "folder of the drives; empty: in `out`");
    v("training", training, AtLeast(1), "sites that predictors are fitted to");
    v("sites", sites, AtLeast(1), "sites that they are judged by");
    v("maps", maps, {}, "folder of real maps, for sites of its own; empty: none");
    v("map_sites", map_sites, AtLeast(1), "sites on these maps");
    v("episodes", episodes, AtLeast(1), "drives of each plan");
    v("jobs", jobs, AtLeast(1), "worker processes");
    v("minutes", minutes, Positive(), "ends then, to be gone on with");
  }
};

std::string LabelOf(const Json& plan) {
  return fmt::format("{}-{:03}-{}", plan["set"].get<std::string>(), plan["site"].get<int>(),
                     plan["planner"].get<std::string>());
}

fs::path HashOf(const fs::path& file) { return file.string() + ".sha256"; }

class Runner {
 public:
  explicit Runner(const Study& study)
      : study_(study),
        out_(study.out),
        drives_(study.drives.empty() ? out_ / "drives" : fs::path(study.drives)),
        model_(fs::absolute(fs::path(study.measured) / "risk_model.json")),
        inputs_{study.robot, model_.string(),
                ReadRobot(FindRobotFile(study.robot, {"robot", 0})).spec,
                study.maps.empty() ? fs::path() : fs::absolute(study.maps)} {
    ReadRiskModel(model_);  // or it is said at once, not of each plan
    fs::create_directories(out_);
    fs::create_directories(drives_);
  }

  int Run() {
    const Json training = Plans(StudySet::kTraining, study_.training, "training.json", nullptr);
    if (!DriveAll(training)) return NotYet();
    const FittedPredictors fitted = Fit(training);
    if (!Ask(StudySet::kTest, study_.sites, "", fitted)) return NotYet();
    if (study_.maps.empty())
      fmt::print("no maps were given: their set is left out\n");
    else if (!Ask(StudySet::kMaps, study_.map_sites, "_maps", fitted))
      return NotYet();
    return 0;
  }

 private:
  // Predicts, drives and judges what is driven so far. Whether that is all. `which`: in the files'
  // names.
  bool Ask(StudySet set, int sites, const std::string& which, const FittedPredictors& fitted) {
    const Json plans = Plans(set, sites, "predictions" + which + ".json", &fitted);
    const bool all = DriveAll(plans);
    std::vector<DrivenPlan> seen;
    for (const Json& plan : plans["plans"])
      if (Driven(plan) >= study_.episodes) seen.push_back(Seen(plan));
    const std::string text =
        fmt::format(
            "# Predictions of plans against their drives\n\n{} of {} plans "
            "are driven, {} drives each; of {} nothing could be predicted.\n",
            seen.size(), plans["plans"].size(), study_.episodes, plans["left_out"].size()) +
        StudyFigures(seen);
    WriteFileWhole(out_ / ("figures" + which + ".md"), text);
    WriteReliabilityDiagram(seen, out_ / ("reliability" + which + ".png"));
    fmt::print("{}", text);
    return all;
  }

  static int NotYet() {
    fmt::print("not all was driven: call it again to go on\n");
    return 0;
  }

  double Elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  ScenarioFile FileOf(const Json& plan, const std::vector<Override>& overrides = {}) const {
    StudySet set = StudySet::kTraining;
    for (const StudySet known : {StudySet::kTest, StudySet::kMaps})
      if (plan["set"] == Name(known)) set = known;
    return ScenarioFile::FromText(StudyScenario(inputs_, set, plan["site"], plan["planner"]),
                                  fs::absolute(drives_) / "study.yaml", overrides);
  }

  fs::path FolderOf(const Json& plan) const { return drives_ / LabelOf(plan); }

  // None: there is no plan, or nothing can be said of it; `left_out` says why.
  std::optional<Json> Described(StudySet set, int site, const std::string& planner,
                                const FittedPredictors* fitted, Json& left_out) const {
    Json plan = {{"set", Name(set)}, {"site", site}, {"planner", planner}};
    // Not the draws of the drives themselves: these are not known beforehand.
    const ScenarioFile file = FileOf(plan, {{"seed", "1"}});
    try {
      DescribePlan(file, classes_, fitted, plan);
    } catch (const InputError& error) {
      fmt::print("{} is left out: {}\n", LabelOf(plan), error.what());
      left_out.push_back({{"plan", LabelOf(plan)}, {"why", error.what()}});
      return std::nullopt;
    }
    return plan;
  }

  // Those that stand in the file, if its hash is right; else made, and written before any drive.
  Json Plans(StudySet set, int sites, const std::string& name, const FittedPredictors* fitted) {
    const fs::path file = out_ / name;
    const std::string model = Sha256OfFile(model_);
    if (fs::exists(file)) {
      const std::string text = InputFiles().Read(file, kMostBytes);
      if (InputFiles().Read(HashOf(file), kMostBytes) != Sha256(text) + "\n")
        throw InputError({file.string(), 0}, "", "", "was changed since it was written");
      Json json = Json::parse(text);
      if (json["model"] != model || json["sites"] != sites)
        throw InputError({file.string(), 0}, "", "",
                         "is of another model, or of another number of sites");
      return json;
    }
    Json json = {{"model", model}, {"sites", sites}, {"driven_before", 0}};
    json["plans"] = Json::array();
    json["left_out"] = Json::array();
    int driven = 0;
    for (int site = 0; site < sites; ++site)
      for (const std::string& planner : kStudyPlanners)
        if (auto plan = Described(set, site, planner, fitted, json["left_out"])) {
          driven += Driven(*plan);
          json["plans"].push_back(std::move(*plan));
        }
    if (json["plans"].empty())
      throw InputError({model_.string(), 0}, "", "", "predicts none of the plans");
    json["driven_before"] = driven;
    const std::string text = JsonText(json) + "\n";
    WriteFileWhole(HashOf(file), Sha256(text) + "\n");
    WriteFileWhole(file, text);
    fmt::print("{}: {} plans, {} drives of them before it was written, SHA-256 {}\n", file.string(),
               json["plans"].size(), driven, Sha256(text));
    return json;
  }

  int Driven(const Json& plan) const {
    const fs::path file = FolderOf(plan) / "campaign.sqlite";
    if (!fs::exists(file)) return 0;
    const CampaignStore store = CampaignStore::Open(file, false);
    int driven = 0;
    for (const std::string& variant : store.Variants())
      driven += static_cast<int>(store.Episodes(variant).size());
    return driven;
  }

  // Whether all were driven.
  bool DriveAll(const Json& plans) {
    for (const Json& plan : plans["plans"]) {
      const int driven = Driven(plan);
      if (driven >= study_.episodes) continue;
      const double left_s = 60 * study_.minutes - Elapsed();
      if (left_s <= 0) return false;
      const CampaignRequest request{.episodes = static_cast<std::uint64_t>(study_.episodes),
                                    .jobs = study_.jobs,
                                    .resume = fs::exists(FolderOf(plan) / "campaign.sqlite"),
                                    .time_limit_s = left_s};
      const CampaignOutcome outcome = DriveCampaign(FileOf(plan), request, FolderOf(plan));
      if (outcome.run.end != CampaignEnd::kComplete) return false;
      const VariantSummary& of = outcome.summary.variants.front();
      fmt::print("{}: predicted {:.3f}, {} of {} failed\n", LabelOf(plan),
                 plan["predicted"][kModelPredictor].get<double>(), of.failures.front().k, of.n);
      std::fflush(stdout);
    }
    return true;
  }

  // What its drives showed.
  DrivenPlan Seen(const Json& plan) const {
    DrivenPlan seen;
    seen.site = plan["site"];
    seen.planner = plan["planner"];
    seen.predicted = plan["predicted"].get<std::map<std::string, double>>();
    seen.predicted_modes = plan["modes"].get<std::map<std::string, double>>();
    seen.predicted_kinds = plan["kinds"].get<std::map<std::string, double>>();
    const CampaignStore store = CampaignStore::Open(FolderOf(plan) / "campaign.sqlite", false);
    for (const std::string& variant : store.Variants()) {
      store.ForEach(variant, [&](const EpisodeRow& row) {
        if (!row.counts()) return;
        ++seen.n;
        const std::vector<Event> events = EventsOf(row);
        if (events.empty()) return;
        ++seen.k;
        ++seen.modes[std::string(Name(events.front().mode))];
      });
      store.ForEachEncounter(variant, [&](std::uint64_t, const Encounter& e) {
        if (e.outcome == Encounter::Outcome::kFailed) ++seen.kinds[KindOf(e)];
      });
    }
    return seen;
  }

  FittedPredictors Fit(const Json& training) const {
    std::vector<TrainingPlan> by_crf, by_classes;
    for (const Json& plan : training["plans"]) {
      const DrivenPlan seen = Seen(plan);
      by_crf.push_back({{plan["crf"].get<double>()}, seen.k, seen.n});
      by_classes.push_back({plan["meetings"].get<std::vector<double>>(), seen.k, seen.n});
    }
    const CampaignStore measured =
        CampaignStore::Open(fs::path(study_.measured) / "campaign.sqlite", false);
    return {FitConstant(by_crf), FitRatesOfExposures(by_crf), FitRatesOfExposures(by_classes),
            OccurrenceOfClasses(FirstMeetings(AllEncounters(measured).encounters), classes_)};
  }

  static constexpr std::uintmax_t kMostBytes = 256u << 20;

  Study study_;
  fs::path out_, drives_, model_;
  StudyInputs inputs_;
  std::map<std::string, HazardClass> classes_ = ClassOfType();
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) {
  using floorproof::Study;
  return floorproof::StudyMain<Study>("bench_predictions", argc, argv, [](const Study& study) {
    return floorproof::Runner(study).Run();
  });
}

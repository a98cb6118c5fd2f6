// SPDX-License-Identifier: Apache-2.0
// What is planning by measured rates worth? The test sites of the study of predictions
// (bench/study_sites.h), planned by `risk_coverage` and by `survival_coverage`, each driven with
// the same draws, and compared in pairs (docs/risk.md).
//   bench_safer_plans KEY=VALUE ...      the keys: struct Study; `robot`, `measured` must be given
// Called again with the same `out` it goes on where it was.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "base/file_output.h"
#include "base/params.h"
#include "bench/study_main.h"
#include "bench/study_sites.h"
#include "run/campaign/campaign_comparison.h"
#include "run/campaign/drive_campaign.h"
#include "run/scenario/risk_model_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

struct Study : Configurable {
  std::string robot = "htetro", measured, out = "out/safer_plans";
  int sites = 50, episodes = 20, jobs = 1;
  double minutes = 1e6;
  void Visit(ParamVisitor& v) override {
    v("robot", robot, {}, "its name, or its MJCF file");
    v("measured", measured, {}, "folder of `floorproof measure`");
    v("out", out, {}, "folder of drives and figures");
    v("sites", sites, AtLeast(1), "sites");
    v("episodes", episodes, AtLeast(1), "drives of each plan");
    v("jobs", jobs, AtLeast(1), "worker processes");
    v("minutes", minutes, Positive(), "ends then, to be gone on with");
  }
};

const std::string kBefore = "planner=risk_coverage", kAfter = "planner=survival_coverage";

struct ComparedSite {
  int site;
  ComparedFailure any;
  std::vector<double> coverage;  // difference of the pairs in which neither failed
  int n() const { return any.both + any.only_a + any.only_b + any.neither; }
  int before() const { return any.both + any.only_a; }
  int after() const { return any.both + any.only_b; }
};

ComparedSite Compared(int site, const fs::path& folder) {
  const CampaignStore store = CampaignStore::Open(folder / "campaign.sqlite", false);
  const Comparison comparison = CompareVariants(store, kBefore, store, kAfter);
  ComparedSite of{site, {}, {}};
  for (const ComparedFailure& failure : comparison.failures)
    if (failure.mode == "any_failure") of.any = failure;
  const auto covered = [&](const std::string& planner) {
    constexpr auto kCoverage =
        std::ranges::find(kMetrics, "coverage", &MetricColumn::name) - kMetrics.begin();
    std::map<std::uint64_t, double> coverages;
    store.ForEach(planner, [&](const EpisodeRow& row) {
      const std::optional<double> coverage = row.metrics[kCoverage];
      if (row.counts() && !row.any_failure() && coverage) coverages[row.episode] = *coverage;
    });
    return coverages;
  };
  const std::map<std::uint64_t, double> before = covered(kBefore), after = covered(kAfter);
  for (const auto& [episode, coverage] : before)
    if (const auto found = after.find(episode); found != after.end())
      of.coverage.push_back(found->second - coverage);
  return of;
}

std::string Figures(const std::vector<ComparedSite>& sites) {
  constexpr double kFailsOften = 0.1, kByChance = 0.05;
  std::string text =
      "| site | drives | risk_coverage failed | survival_coverage failed | p "
      "|\n|---|---|---|---|---|\n";
  int before = 0, after = 0, n = 0, often = 0, often_before = 0, often_after = 0;
  std::vector<double> worse;  // p where it failed more often
  double lost = 0;
  std::size_t covered = 0;
  for (const ComparedSite& of : sites) {
    if (of.n() == 0) continue;
    if (of.before() + of.after() > 0)
      text += fmt::format("| {} | {} | {} | {} | {:.2g} |\n", of.site, of.n(), of.before(),
                          of.after(), of.any.p);
    n += of.n();
    before += of.before();
    after += of.after();
    if (of.before() >= kFailsOften * of.n()) {
      ++often;
      often_before += of.before();
      often_after += of.after();
    }
    if (of.after() > of.before()) worse.push_back(of.any.p);
    for (const double difference : of.coverage) lost += difference;
    covered += of.coverage.size();
  }
  // Of so many sites one comes out so by chance: each is held against its share (Bonferroni).
  const double limit = kByChance / std::max<double>(1, static_cast<double>(sites.size()));
  const auto beyond = std::ranges::count_if(worse, [&](double p) { return p <= limit; });
  text += fmt::format(
      "\n{} drives each: {} failed by risk_coverage, {} by survival_coverage.\n"
      "{} sites where risk_coverage failed in {:.0f} % or more: {} and {}.\n"
      "{} sites where survival_coverage failed more often, {} of them beyond chance.\n"
      "Coverage where neither failed: {:+.4f} on average over {} pairs of drives.\n",
      n, before, after, often, 100 * kFailsOften, often_before, often_after, worse.size(), beyond,
      covered == 0 ? 0.0 : lost / static_cast<double>(covered), covered);
  return text;
}

int Run(const Study& study) {
  const fs::path out = study.out;
  fs::create_directories(out);
  const StudyInputs inputs{study.robot,
                           fs::absolute(fs::path(study.measured) / "risk_model.json").string(),
                           ReadRobot(FindRobotFile(study.robot, {"robot", 0})).spec,
                           {}};
  ReadRiskModel(inputs.model);  // or it is said at once, not of each site
  const auto begin = std::chrono::steady_clock::now();
  std::vector<ComparedSite> sites;
  bool all = true;
  for (int site = 0; site < study.sites && all; ++site) {
    const std::string text = StudyScenario(inputs, StudySet::kTest, site, "risk_coverage") +
                             "matrix: {plan.planner: [risk_coverage, survival_coverage]}\n";
    const fs::path folder = out / fmt::format("site-{:03}", site);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    const double left_s = 60 * study.minutes - elapsed.count();
    all = left_s > 0 &&
          DriveCampaign(ScenarioFile::FromText(text, fs::absolute(out) / "study.yaml", {}),
                        {.episodes = static_cast<std::uint64_t>(study.episodes),
                         .jobs = study.jobs,
                         .resume = fs::exists(folder / "campaign.sqlite"),
                         .time_limit_s = left_s},
                        folder)
                  .run.end == CampaignEnd::kComplete;
    if (!all) break;
    sites.push_back(Compared(site, folder));
    fmt::print("site {}: {} and {} of {} failed\n", site, sites.back().before(),
               sites.back().after(), sites.back().n());
    std::fflush(stdout);
  }
  const std::string figures = fmt::format("{} of {} sites, {} drives of each plan\n\n",
                                          sites.size(), study.sites, study.episodes) +
                              Figures(sites);
  WriteFileWhole(out / "figures.md", figures);
  fmt::print("{}{}", figures, all ? "" : "not all was driven: call it again to go on\n");
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) {
  return floorproof::StudyMain<floorproof::Study>("bench_safer_plans", argc, argv, floorproof::Run);
}

// SPDX-License-Identifier: Apache-2.0
// What is planning by measured rates worth? The test sites of the study of predictions, or harder
// ones (bench/study_sites.h), planned by `risk_coverage` and by `survival_coverage`, each driven
// with the same draws, and compared in pairs (docs/risk.md).
//   bench_safer_plans KEY=VALUE ...      the keys: struct Study; `robot`, `measured` must be given
// Called again with the same `out` it goes on where it was.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/params.h"
#include "bench/study_main.h"
#include "bench/study_sites.h"
#include "run/campaign/campaign_comparison.h"
#include "run/campaign/drive_campaign.h"
#include "run/scenario/risk_model_file.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

struct Study : Configurable {
  std::string robot = "htetro", measured, out = "out/safer_plans";
  int sites = 50, episodes = 20, jobs = 1;
  bool hard = false;
  double minutes = 1e6;
  void Visit(ParamVisitor& v) override {
    v("robot", robot, {}, "its name, or its MJCF file");
    v("measured", measured, {}, "folder of `floorproof measure`");
    v("out", out, {}, "folder of drives and figures");
    v("sites", sites, AtLeast(1), "sites");
    v("episodes", episodes, AtLeast(1), "drives of each plan");
    v("hard", hard, "sites with strips across the floor that may be too much for the robot");
    v("jobs", jobs, AtLeast(1), "worker processes");
    v("minutes", minutes, Positive(), "ends then, to be gone on with");
  }
};

const std::string kBefore = "planner=risk_coverage", kAfter = "planner=survival_coverage";

struct ComparedSite {
  int site;
  ComparedFailure any;
  // Sites are picked by the first half of the drives and judged by the second: who is picked by how
  // often it failed would else be less unlucky the next time, whoever plans.
  int picked_by = 0, picked_before = 0;
  int later = 0, later_before = 0, later_after = 0;
  double predicted = 0;  // by survival_coverage, before any drive: that its plan fails
  double covered = 0;    // sum of the differences of coverage, of pairs in which neither failed
  int pairs = 0;
  int n() const { return any.both + any.only_a + any.only_b + any.neither; }
  int before() const { return any.both + any.only_a; }
  int after() const { return any.both + any.only_b; }
};

std::map<std::uint64_t, EpisodeRow> Rows(const CampaignStore& store, const std::string& variant) {
  std::map<std::uint64_t, EpisodeRow> rows;
  store.ForEach(variant, [&](const EpisodeRow& row) {
    if (row.counts()) rows[row.episode] = row;
  });
  return rows;
}

ComparedSite Compared(int site, int episodes, const fs::path& folder) {
  constexpr auto kCoverage =
      std::ranges::find(kMetrics, "coverage", &MetricColumn::name) - kMetrics.begin();
  const CampaignStore store = CampaignStore::Open(folder / "campaign.sqlite", false);
  const Comparison comparison = CompareVariants(store, kBefore, store, kAfter);
  ComparedSite of{.site = site, .any = {}};
  for (const ComparedFailure& failure : comparison.failures)
    if (failure.mode == "any_failure") of.any = failure;
  const std::map<std::uint64_t, EpisodeRow> before = Rows(store, kBefore),
                                            after = Rows(store, kAfter);
  for (const auto& [episode, a] : before) {
    const auto found = after.find(episode);
    if (found == after.end()) continue;
    const EpisodeRow& b = found->second;
    of.predicted += nlohmann::json::parse(b.plan).value("p_failure", 0.0);
    if (2 * episode < static_cast<std::uint64_t>(episodes)) {
      ++of.picked_by;
      of.picked_before += a.any_failure();
    } else {
      ++of.later;
      of.later_before += a.any_failure();
      of.later_after += b.any_failure();
    }
    const auto &x = a.metrics[kCoverage], &y = b.metrics[kCoverage];
    if (!a.any_failure() && !b.any_failure() && x && y) {
      of.covered += *y - *x;
      ++of.pairs;
    }
  }
  of.predicted /= std::max(1, of.picked_by + of.later);
  return of;
}

std::string Figures(const std::vector<ComparedSite>& sites) {
  constexpr double kFailsOften = 0.1, kByChance = 0.05, kHopeless = 0.5;
  std::string text =
      "| site | drives | risk_coverage failed | survival_coverage failed, predicted | seen | p "
      "|\n|---|---|---|---|---|---|\n";
  int n = 0, before = 0, after = 0, pairs = 0;
  double covered = 0;
  struct Often {
    int sites = 0, n = 0, before = 0, after = 0;
  } can, cannot;  // be covered, as survival_coverage sees it
  int worse = 0, beyond = 0;
  // Of so many sites one comes out so by chance: each is held against its share (Bonferroni).
  const double limit = kByChance / std::max<double>(1, static_cast<double>(sites.size()));
  for (const ComparedSite& of : sites) {
    if (of.before() + of.after() > 0)
      text += fmt::format("| {} | {} | {} | {:.1f} | {} | {:.2g} |\n", of.site, of.n(), of.before(),
                          of.predicted * of.n(), of.after(), of.any.p);
    n += of.n();
    before += of.before();
    after += of.after();
    covered += of.covered;
    pairs += of.pairs;
    if (of.picked_before > 0 && of.picked_before >= kFailsOften * of.picked_by) {
      Often& often = of.predicted > kHopeless ? cannot : can;
      ++often.sites;
      often.n += of.later;
      often.before += of.later_before;
      often.after += of.later_after;
    }
    worse += of.after() > of.before();
    beyond += of.after() > of.before() && of.any.p <= limit;
  }
  text += fmt::format("\n{} drives each: {} failed by risk_coverage, {} by survival_coverage.\n", n,
                      before, after);
  for (const auto& [often, sees] :
       {std::pair(can, "likely to be covered"), {cannot, "likely not to be covered by any plan"}})
    text += fmt::format(
        "{} sites where risk_coverage failed in {:.0f} % or more of the first half of its drives, "
        "and which survival_coverage saw as {}: of the second half, {} drives each, {} and {} "
        "failed.\n",
        often.sites, 100 * kFailsOften, sees, often.n, often.before, often.after);
  text += fmt::format(
      "{} sites where survival_coverage failed more often, {} of them beyond chance.\n"
      "Coverage where neither failed: {:+.4f} on average over {} pairs of drives.\n",
      worse, beyond, pairs == 0 ? 0.0 : covered / pairs, pairs);
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
    const std::string text = StudyScenario(inputs, study.hard ? StudySet::kHard : StudySet::kTest,
                                           site, "risk_coverage") +
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
    sites.push_back(Compared(site, study.episodes, folder));
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

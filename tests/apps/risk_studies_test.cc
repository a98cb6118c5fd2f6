// SPDX-License-Identifier: Apache-2.0
// Plans by risk over random sites, and driven: the bundled campaigns risk_study and risk_drive.
// Slow. The planners were not developed on these seeds.
#include <nlohmann/json.hpp>

#include "tests/apps/campaign_program.h"
#include "tests/own_folder.h"
#include "tests/places.h"

namespace floorproof {
namespace {

const std::string kPrefix = "models/scenarios/";

class Study : public OwnFolderTest {
 protected:
  // In parts, as a program of a test may run for minutes only.
  void Run(const std::string& scenario, const std::vector<int>& parts, const std::string& seed) {
    for (const int n : parts) {
      Program campaign(std::vector<std::string>{"campaign", SourceFile(kPrefix + scenario).string(),
                                                "--no-films", "--quiet", "--resume", "--out", "c",
                                                "--seed", seed, "-n", std::to_string(n)},
                       folder_);
      ASSERT_EQ(campaign.Wait(), 0) << campaign.Said();
    }
  }
  nlohmann::json Compare(const std::string& a, const std::string& b) {
    Program compare("compare c:" + a + " c:" + b + " --json", folder_);
    EXPECT_EQ(compare.Wait(), 0) << compare.Said();
    return nlohmann::json::parse(compare.Out());
  }
  static double Change(const nlohmann::json& found, const char* figure) {
    return found["plans"][figure]["change"]["median"].get<double>();
  }
};

// More of them than the study asks for: the median of 300 sites strays by 2 % to either side.
TEST_F(Study, PlansOfRandomSites) {
  constexpr int kSites = 1500;
  Run("risk_study.yaml", {500, 1000, kSites}, "2023");
  if (HasFatalFailure()) return;
  const double percent = 0.01;
  const auto share = [](const nlohmann::json& found, const char* key) {
    const auto& both = found["risk_and_length"];
    return both[key].get<double>() / both["n"].get<double>();
  };

  const nlohmann::json paper = Compare("plan=conventional", "plan=fmea");
  EXPECT_EQ(paper["n"], kSites);
  EXPECT_GE(Change(paper, "cumulative_risk"), -17 * percent);
  EXPECT_LE(Change(paper, "cumulative_risk"), -8 * percent);
  // It is bought with coverage: on the same cells the conventional order has no more risk.
  EXPECT_LT(paper["plans"]["hazard_free_coverage"]["b"]["median"].get<double>(), 0.97);
  const nlohmann::json same = Compare("plan=conventional_same_cells", "plan=fmea");
  EXPECT_NEAR(Change(same, "cumulative_risk"), 0, 2 * percent);

  const nlohmann::json on_its_cells = Compare("plan=fmea", "plan=ours_same_cells");
  EXPECT_EQ(on_its_cells["plans"]["hazard_free_coverage"]["same"], kSites);
  EXPECT_GE(share(on_its_cells, "none_higher"), 0.95);
  EXPECT_GE(share(on_its_cells, "both_lower"), 0.70);
  EXPECT_LE(Change(on_its_cells, "cumulative_risk"), -4 * percent);

  const nlohmann::json on_all = Compare("plan=conventional", "plan=ours");
  EXPECT_EQ(on_all["plans"]["hazard_free_coverage"]["same"], kSites);
  EXPECT_GE(share(on_all, "none_higher"), 0.95);
  EXPECT_GE(share(on_all, "both_lower"), 0.80);
  EXPECT_LE(Change(on_all, "cumulative_risk"), -8 * percent);
}

// The paper's observation of its third site, and ours of all three.
TEST_F(Study, PlansDrivenOnThePapersThreeSites) {
  std::vector<int> parts;
  for (int n = 4; n <= 100; n += 4) parts.push_back(n);
  Run("risk_drive.yaml", parts, "2023");
  if (HasFatalFailure()) return;
  const auto failures = [](const nlohmann::json& found, const char* side) {
    return found["failures"]["any_failure"][side].get<int>();
  };
  const auto helped = [](const nlohmann::json& found) {
    return found["metrics"]["interventions"]["mean"]["estimate"].get<double>();
  };
  const std::string cable = "site=cable,plan=";
  const nlohmann::json paper = Compare(cable + "conventional", cable + "fmea");
  EXPECT_EQ(paper["n"], 100);
  EXPECT_LT(paper["failures"]["any_failure"]["upper"].get<double>(), 0);
  EXPECT_LT(helped(paper), 0);
  for (const char* other : {"conventional", "fmea"}) {
    int theirs = 0, ours = 0;
    double more_help = 0;
    for (const char* site : {"staircase", "auditorium", "cable"}) {
      const std::string prefix = std::string("site=") + site + ",plan=";
      const nlohmann::json found = Compare(prefix + other, prefix + "ours");
      theirs += failures(found, "a");
      ours += failures(found, "b");
      more_help += helped(found);
    }
    EXPECT_LT(ours, theirs) << other;
    EXPECT_LT(more_help, 0) << other;
  }
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What glass, a bare corridor and slipping wheels do to a robot that finds its way by lidar: the
// bundled campaigns, 100 paired episodes each. Slow.
#include <nlohmann/json.hpp>

#include "tests/apps/campaign_program.h"

namespace floorproof {
namespace {

struct Study {
  const char *scenario, *plain, *hard;
  double least_m;  // that the mean error of the estimate grows by, at 95 %
};
void PrintTo(const Study& study, std::ostream* os) { *os << study.scenario; }

class LocalisationStudy : public testing::TestWithParam<Study> {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / (std::string("study_") + GetParam().scenario);
};

TEST_P(LocalisationStudy, WorsensWhatTheRobotKnowsOfItsPlace) {
  const Study& study = GetParam();
  const std::string scenario =
      std::string(FP_SOURCE_DIR) + "/models/scenarios/" + study.scenario + ".yaml";
  // In parts, as a program of a test may run for minutes only.
  for (const char* n : {"30", "60", "100"}) {
    Program campaign("campaign " + scenario + " --no-films --quiet --resume --out c -n " + n,
                     folder_);
    ASSERT_EQ(campaign.Wait(), 0) << campaign.Said();
  }
  Program compare(std::string("compare c:") + study.plain + " c:" + study.hard + " --json",
                  folder_);
  ASSERT_EQ(compare.Wait(), 0) << compare.Said();
  const nlohmann::json found = nlohmann::json::parse(compare.Out());
  EXPECT_EQ(found["n"], 100);
  for (const char* metric : {"mean_estimate_error_m", "max_estimate_error_m"}) {
    const nlohmann::json& mean = found["metrics"][metric]["mean"];
    EXPECT_GT(mean["lower"].get<double>(), study.least_m) << metric << ": " << mean.dump();
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, LocalisationStudy,
    testing::Values(Study{"localisation_glass", "walls=board", "walls=glass", 0.005},
                    Study{"localisation_corridor", "corridor=niches", "corridor=bare", 0.1},
                    Study{"localisation_slip", "covers=none", "covers=covers", 0}));

}  // namespace
}  // namespace floorproof

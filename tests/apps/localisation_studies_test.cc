// SPDX-License-Identifier: Apache-2.0
// What glass, a bare corridor and slipping wheels do to a robot that finds its way by lidar: the
// bundled campaigns, 100 paired episodes each. Slow.
#include <nlohmann/json.hpp>

#include "tests/apps/campaign_program.h"
#include "tests/own_folder.h"
#include "tests/places.h"

namespace floorproof {
namespace {

struct Study {
  const char *scenario, *plain, *hard;
  std::vector<const char*> worse;  // metrics that grow, at 95 %
};
void PrintTo(const Study& study, std::ostream* os) { *os << study.scenario; }

class LocalisationStudy : public OwnFolderTest, public testing::WithParamInterface<Study> {};

TEST_P(LocalisationStudy, WorsensWhatTheRobotKnowsOfItsPlace) {
  const Study& study = GetParam();
  const std::string scenario =
      SourceFile("models/scenarios/" + std::string(study.scenario) + ".yaml").string();
  // In parts, as a program of a test may run for minutes only.
  for (const char* n : {"30", "60", "100"}) {
    Program campaign(std::vector<std::string>{"campaign", scenario, "--no-films", "--quiet",
                                              "--resume", "--out", "c", "-n", n},
                     folder_);
    ASSERT_EQ(campaign.Wait(), 0) << campaign.Said();
  }
  Program compare(std::string("compare c:") + study.plain + " c:" + study.hard + " --json",
                  folder_);
  ASSERT_EQ(compare.Wait(), 0) << compare.Said();
  const nlohmann::json found = nlohmann::json::parse(compare.Out());
  EXPECT_EQ(found["n"], 100);
  for (const char* metric : study.worse) {
    const nlohmann::json& mean = found["metrics"][metric]["mean"];
    EXPECT_GT(mean["lower"].get<double>(), 0) << metric << ": " << mean.dump();
  }
}

const std::vector<const char*> kAll = {"mean_estimate_error_m", "max_estimate_error_m",
                                       "mean_estimate_position_std_m", "mean_cross_track_m"};
// Slip of a second or two is made good by the next scans.
const std::vector<const char*> kErrors = {"mean_estimate_error_m", "max_estimate_error_m",
                                          "mean_estimate_position_std_m"};

INSTANTIATE_TEST_SUITE_P(
    All, LocalisationStudy,
    testing::Values(Study{"localisation_glass", "walls=board", "walls=glass", kAll},
                    Study{"localisation_corridor", "corridor=niches", "corridor=bare", kAll},
                    Study{"localisation_slip", "covers=none", "covers=covers", kErrors}));

}  // namespace
}  // namespace floorproof

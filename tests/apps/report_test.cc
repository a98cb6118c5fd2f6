// SPDX-License-Identifier: Apache-2.0
// `floorproof report` on a recorded campaign: the page says what the summary says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/sanitizer.h"
#include "run/campaign/campaign_about.h"
#include "run/campaign/campaign_files.h"
#include "run/campaign/campaign_store.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "stats/outward.h"
#include "tests/own_folder.h"
#include "tests/places.h"
#include "tests/report/html_page.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kScenario = R"(scenario: 1
name: '<script>"floor" & co'
site:
  site: 1
  grid:
    cell_m: 0.5
    rows: |
      ######
      #....#
      #....#
      ######
  start: {x_m: 0.9, y_m: 0.9, yaw_deg: 0}
robot: beluga
plan: {planner: boustrophedon}
matrix:
  robot: [beluga, htetro]
)";

// Four of ten of the second variant's episodes stuck, at a hazard with a hostile name; one timeout.
EpisodeRow Row(const std::string& variant, std::uint64_t id) {
  EpisodeRow row;
  row.variant = variant;
  row.episode = id;
  row.outcome = "success";
  for (auto& metric : row.metrics) metric = 1.0 + 0.01 * static_cast<double>(id);
  if (variant == "robot=beluga") return row;
  if (id < 4) {
    row.outcome = "failure";
    row.events_of[static_cast<std::size_t>(FailureMode::kStuck)] = 1;
    row.events =
        R"([{"mode":"stuck","kind":"held","t_s":12.34,"x_m":1.5,"y_m":0.75,"hazard":"<b>'sill'&"}])";
  } else if (id == 4) {
    row.outcome = "timeout";
    row.message = "out of time";
    row.timeout =
        R"({"t_s": 98.76, "x_m": 3.25, "y_m": 1.5, "yaw_rad": 0, "hazard": "the last <sill>"})";
  }
  return row;
}

class ReportCommand : public OwnFolderTest {
 protected:
  ReportCommand() {
    fs::create_directories(folder_ / "out");
    std::ofstream(folder_ / "s.yaml") << kScenario;
    const ScenarioFile file(folder_ / "s.yaml");
    const Scenario base = file.Read(std::nullopt);
    CampaignStore store =
        CampaignStore::Create(folder_ / "out/campaign.sqlite", DescribeCampaign(file));
    for (const Variant& variant : file.variants()) {
      std::vector<EpisodeRow> rows;
      for (std::uint64_t id = 0; id < 10; ++id) rows.push_back(Row(variant.name, id));
      store.Add(rows);
    }
    WriteFileWhole(folder_ / "out/scenario.resolved.yaml", ResolvedScenario(base, folder_ / "out"));
    WriteSummaryFiles(store, file, {}, folder_ / "out");
  }

  int Run() const {
    const std::string command =
        "cd '" + folder_.string() + "' && '" + ProgramFile().string() + "' report out >said 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  // Without its scripts, which stand at its end.
  std::string Page() const {
    std::string page = Slurp(folder_ / "out/report.html");
    const auto begin = page.find("<script type=\"application/json\""), end = page.rfind("</body>");
    EXPECT_LT(begin, end);
    return page.erase(begin, end - begin);
  }
  std::string Said() const { return Slurp(folder_ / "said"); }
};

TEST_F(ReportCommand, PageSaysWhatTheSummarySays) {
  ASSERT_EQ(Run(), 0) << Said();
  const std::string page = Page();
  EXPECT_EQ(WhyUnbalanced(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("<b>'sill'")));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;&#39;sill&#39;&amp;"));
  const auto summary = nlohmann::json::parse(Slurp(folder_ / "out/summary.json"));
  for (const auto& variant : summary["variants"])
    for (const auto& [mode, rate] : variant["failures"].items()) {
      const Interval told =
          RoundedOutward({100 * rate["lower"].get<double>(), 100 * rate["upper"].get<double>()});
      char text[80];
      std::snprintf(text, sizeof text, "%.3g to %.3g %%", told.lower, told.upper);
      EXPECT_THAT(page, HasSubstr(text)) << mode;
    }
  EXPECT_THAT(page, HasSubstr("4 of 10"));
  EXPECT_THAT(page, HasSubstr(summary["campaign"].get<std::string>()));
}

TEST_F(ReportCommand, ListsEachFailingEpisodeWithItsCommand) {
  ASSERT_EQ(Run(), 0) << Said();
  const std::string page = Page();
  for (int id = 0; id <= 4; ++id)
    EXPECT_THAT(page, HasSubstr("floorproof replay out --episode " + std::to_string(id) +
                                " --variant robot=htetro --video"));
  EXPECT_THAT(page, Not(HasSubstr("--variant robot=beluga")));
  EXPECT_THAT(page, HasSubstr("stuck (held)"));
  EXPECT_THAT(page, HasSubstr("x 1.50, y 0.75 m"));
  EXPECT_THAT(page, HasSubstr("the last &lt;sill&gt;")) << "what was near when time ran out";
  EXPECT_THAT(page, HasSubstr("98.8 s"));
  EXPECT_THAT(page, HasSubstr("x 3.25, y 1.50 m"));
}

TEST_F(ReportCommand, ComparesWithTheFirstVariantOverSharedEpisodes) {
  ASSERT_EQ(Run(), 0) << Said();
  // 4 of 10 against 0 of 10: all four discordant pairs on one side, p = 2 / 2^4.
  EXPECT_THAT(Page(), HasSubstr("rates +40 percentage points"));
  EXPECT_THAT(Page(), HasSubstr("McNemar p = 0.125"));
  EXPECT_THAT(Page(), HasSubstr("5 where both succeed"));
}

TEST_F(ReportCommand, SamePageAgainAndNothingElseChanged) {
  ASSERT_EQ(Run(), 0) << Said();
  const std::string page = Page(), database = Slurp(folder_ / "out/campaign.sqlite");
  EXPECT_TRUE(fs::exists(folder_ / "out/heatmap_failures_robot=htetro.png"));
  ASSERT_EQ(Run(), 0);
  EXPECT_TRUE(Page() == page);
  EXPECT_TRUE(Slurp(folder_ / "out/campaign.sqlite") == database);
}

// Beyond what the page lists, 10,000 episodes of all variants and 2,000 places on a map, neither
// the page nor the memory that making it takes grows with the failures. The page says what it
// lists.
TEST_F(ReportCommand, APageOfManyFailuresIsBounded) {
  const auto megabytes = [] {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_maxrss) / 1024;
  };
  const auto page_of = [&](std::uint64_t begin, std::uint64_t end) {
    const ScenarioFile file(folder_ / "s.yaml");
    CampaignStore store = CampaignStore::Open(folder_ / "out/campaign.sqlite", true);
    std::vector<EpisodeRow> rows;
    for (std::uint64_t id = begin; id < end; ++id) {
      rows.push_back(Row("robot=htetro", 0));
      rows.back().episode = id;
    }
    store.Add(rows);
    WriteSummaryFiles(store, file, {}, folder_ / "out");
    store.Settle();
  };
  page_of(10, 6'000);
  ASSERT_EQ(Run(), 0) << Said();
  const std::string page = Slurp(folder_ / "out/report.html");
  [[maybe_unused]] const double few_mb = megabytes();
  EXPECT_THAT(page, HasSubstr("\"of\":5995}"));
  EXPECT_THAT(page, HasSubstr("the first 2,000 of 5,994 failures"));
  page_of(6'000, 14'000);
  ASSERT_EQ(Run(), 0) << Said();
  const std::string larger = Slurp(folder_ / "out/report.html");
  EXPECT_THAT(larger, HasSubstr("\"of\":13995}"));
  EXPECT_LT(larger.size(), page.size() + 10'000);
#ifndef FP_ADDRESS_SANITIZER  // which keeps freed memory
  EXPECT_LT(megabytes(), few_mb + 8) << "8,000 failures more, 1 kB each";
#endif
}

TEST_F(ReportCommand, RefusesWhatDoesNotBelongTogether) {
  const fs::path file = folder_ / "out/summary.json";
  const std::string good = Slurp(file);
  auto json = nlohmann::ordered_json::parse(good);
  json["variants"]["robot=beluga"]["n"] = 9;
  std::ofstream(file) << json.dump();
  EXPECT_EQ(Run(), 2);
  EXPECT_THAT(Said(), HasSubstr("--resume"));
  for (const char* bad : {"", "{", "[]", "{\"campaign\": 3}"}) {
    std::ofstream(file) << bad;
    EXPECT_EQ(Run(), 2) << bad;
    EXPECT_THAT(Said(), HasSubstr("summary.json"));
  }
  fs::remove(file);
  EXPECT_EQ(Run(), 2);
  std::ofstream(file) << good;
  fs::remove(folder_ / "out/campaign.sqlite");
  EXPECT_EQ(Run(), 2);
  EXPECT_FALSE(fs::exists(folder_ / "out/report.html"));
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Whole searches through physics, against a truth that bisection finds.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cmath>

#include "run/rare/rare_search.h"
#include "run/scenario/scenario_file.h"
#include "tests/places.h"
#include "tests/run/rare_scenario.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

class SlowRareSearch : public RareScenarioTest {
 protected:
  RareOutcome Search(const ScenarioFile& file, const char* out, int jobs, bool resume = false) {
    return SearchRare(file, {.mode = "veer_off", .jobs = jobs, .resume = resume}, folder_ / out);
  }
  // The error beyond which it veers off, at this friction, to a micrometre.
  double Boundary(const ScenarioFile& file, double friction) {
    EpisodeMaker maker(file);
    double low = 0, high = 0.2;
    while (high - low > 1e-6) {
      const double middle = (low + high) / 2;
      Drawn drawn = Believing(middle);
      drawn[1].second = ConfigNode::Scalar(std::to_string(friction));
      const bool fails = maker.RunDrawn(RareTrials::TrialVariant(), 0, drawn).events_of[0] > 0;
      (fails ? high : low) = middle;
    }
    return high;
  }
};

// At 3 in 100, 1 in 1,000 and 1 in 100,000, by the error's deviation alone.
TEST_F(SlowRareSearch, TellsHowRareItIsThroughPhysics) {
  for (const double deviation : {0.025, 0.0165, 0.0124}) {
    SaveScenario("{estimator.start_error_y_m: {normal: [0, " + std::to_string(deviation) +
                 "]}, site.floor.friction: {uniform: [0.6, 0.9]}}");
    const ScenarioFile file = File();
    // Where it turns at its end, a little friction more or less decides a millimetre of its way: so
    // many frictions, and what they differ by.
    constexpr int kFrictions = 48;
    double truth = 0, squares = 0, nearest = 1;
    for (int i = 0; i < kFrictions; ++i) {
      const double boundary = Boundary(file, 0.6 + 0.3 * (i + 0.5) / kFrictions);
      const double fails = std::erfc(boundary / deviation / std::sqrt(2.0));
      truth += fails / kFrictions;
      squares += fails * fails / kFrictions;
      nearest = std::min(nearest, boundary);
    }
    const double of_truth = std::sqrt((squares / truth / truth - 1) / kFrictions);
    const std::string out = "o" + std::to_string(deviation);
    const RareOutcome dut = Search(file, out.c_str(), 2);
    std::printf("truth %.3g (+- %.1f %%): %.3g, coefficient of variation %.3f, %llu drives\n",
                truth, 100 * of_truth, dut.estimate.probability, dut.estimate.cov,
                static_cast<unsigned long long>(dut.estimate.trials));
    ASSERT_EQ(dut.estimate.answer, RareAnswer::kEstimate) << dut.estimate.why;
    EXPECT_NEAR(dut.estimate.probability / truth, 1, 4 * std::hypot(dut.estimate.cov, of_truth));
    EXPECT_LE(dut.estimate.cov, 0.1);
    // To the left and to the right; a side may be found in two parts, as friction decides it too.
    EXPECT_GE(dut.failures.size(), 2u);
    EXPECT_LE(dut.failures.size(), 4u);
    for (const LikelyFailure& failure : dut.failures) {
      EXPECT_EQ(failure.row.outcome, "failure");
      EXPECT_NEAR(dut.estimate.regions[failure.region].distance * deviation, nearest,
                  0.15 * nearest);
    }
  }
}

TEST_F(SlowRareSearch, GivesTheSameBytesForAnyWorkersBrokenOffOrNot) {
  const ScenarioFile file = File();
  Search(file, "one", 1);
  Search(file, "three", 3);
  const std::string whole = Slurp(folder_ / "one/rare.json");
  EXPECT_EQ(Slurp(folder_ / "three/rare.json"), whole);
  // Broken off at some drive: the rows up to there, and perhaps some after it.
  fs::create_directories(folder_ / "cut");
  fs::copy(folder_ / "one/trials.sqlite", folder_ / "cut/trials.sqlite");
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open((folder_ / "cut/trials.sqlite").c_str(), &db), SQLITE_OK);
  for (const char* table : {"episode", "encounter"}) {
    const std::string sql =
        std::string("DELETE FROM ") + table + " WHERE episode > 1700 AND episode % 7 > 0";
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  }
  sqlite3_close(db);
  Search(file, "cut", 2, true);
  EXPECT_EQ(Slurp(folder_ / "cut/rare.json"), whole);
  EXPECT_THROW(Search(File({{"seed", "6"}}), "one", 1, true), InputError) << "another search";
  EXPECT_THROW(Search(file, "one", 1), InputError) << "it is there";
}

}  // namespace
}  // namespace floorproof

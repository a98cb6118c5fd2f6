// SPDX-License-Identifier: Apache-2.0
// Samples of a dirty floor, taken by a drive: the key `dirt` from the file to plan.json.
#include "run/episode/floor_audit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "env/core/standing.h"
#include "run/campaign/episode_row.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/scenario/override.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario.h"
#include "run/scenario/warnings.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

using Json = nlohmann::ordered_json;

const std::string kGiven =
    "{planner: audit, samples: {file: points.csv}, dwell_s: 1, speed_mps: 0.2}";
const std::string kFound =
    "{planner: audit, samples: {du_m: 0.5, boundary_m: 0.3, random_share: 0.5}, dwell_s: 0.5, "
    "speed_mps: 0.2}";

class FloorAuditTest : public ScenarioTest {
 protected:
  FloorAuditTest() { Save("points.csv", "x_m,y_m\n1,2\n2,1\n2.5,2\n1.75,1.5\n"); }

  // A room of 2.5 m x 2 m, from (0.5, 0.5) to (3, 2.5).
  static std::string Room(const std::string& plan, const std::string& more) {
    return "scenario: 1\nsite:\n  site: 1\n  name: room\n  grid:\n    cell_m: 0.5\n    rows: |\n"
           "      #######\n      #.....#\n      #.....#\n      #.....#\n      #.....#\n"
           "      #######\nrobot: beluga\nstart: {x_m: 1, y_m: 1}\nplan: " +
           plan + "\n" + more + "\n";
  }
  struct Audited {
    Scenario scenario;
    Execution execution;
    const EpisodeRecord& record() const { return execution.record; }
    const FloorAudit& audit() const { return *execution.record.audit; }
    Json plan() const { return PlanJson(scenario, execution.plan, &execution.record); }
  };
  Audited Run(const std::string& plan, const std::string& more,
              const std::vector<Override>& overrides = {}) const {
    Audited run{Read(Room(plan, more), overrides), {}};
    run.execution = Execute(run.scenario);
    EXPECT_EQ(run.execution.plan.status, PlanStatus::kSuccess) << run.execution.plan.message;
    return run;
  }
  static double MeanCount(const FloorAudit& audit) {
    double mean = 0;
    for (const AuditedSample& taken : audit.samples)
      mean += static_cast<double>(taken.sample.lifted.size()) /
              static_cast<double>(audit.samples.size());
    return mean;
  }
  static double DirtAt(const FloorAudit& audit, const Vec2& p_W) {
    return static_cast<double>(audit.dirt_per_m2(audit.dirt_frame.ToCell(p_W)));
  }
};

TEST_F(FloorAuditTest, TapesArePressedWhereThePlanSaysInItsOrder) {
  const Audited dut = Run(kGiven, "dirt: {}");
  EXPECT_EQ(dut.record().outcome, Outcome::kSuccess) << dut.record().message;
  ASSERT_THAT(dut.audit().samples, SizeIs(4));
  EXPECT_EQ(dut.record().metrics.samples_taken, 4);
  int visit = 0;
  double last_s = 0;
  for (const AuditedSample& taken : dut.audit().samples) {
    const SamplePlace& place =
        dut.execution.plan.samples[static_cast<std::size_t>(taken.stop.place)];
    EXPECT_EQ(place.visit, ++visit);
    EXPECT_LT((taken.X_WT.p() - place.p_W).norm(), 0.02) << visit;
    EXPECT_GT(taken.stop.t_s, last_s + 1);
    last_s = taken.stop.t_s;
  }
  EXPECT_LT(*dut.record().metrics.max_sample_off_m, 0.02);
}

// 80,000 particles a square metre are 32 on a tape of 4 cm2.
TEST_F(FloorAuditTest, WhatIsCountedIsWhatLay) {
  const Audited dut = Run(kFound, "dirt: {}");
  const FloorAudit& audit = dut.audit();
  ASSERT_GT(audit.samples.size(), 8u);
  EXPECT_NEAR(audit.mean_dirt_per_m2, 80e3, 1);
  const double tapes = static_cast<double>(audit.samples.size());
  EXPECT_NEAR(MeanCount(audit), 32, 4 * std::sqrt(32 / tapes));
  for (const AuditedSample& taken : audit.samples)
    EXPECT_NEAR(taken.sample.counted.count, static_cast<double>(taken.sample.lifted.size()), 10);
  EXPECT_EQ(*dut.record().metrics.dirt_gathering, *audit.gathering.Efficiency());
  EXPECT_EQ(audit.gathering.dirty, static_cast<int>(audit.samples.size()));
  const Audited strict = Run(kFound, "dirt: {dirty_above: 100}");
  EXPECT_EQ(*strict.record().metrics.dirt_gathering, 0);
}

TEST_F(FloorAuditTest, ACleanFloorIsClean) {
  const Audited dut = Run(kGiven, "dirt: {density_per_m2: 0}");
  for (const AuditedSample& taken : dut.audit().samples) {
    EXPECT_EQ(taken.sample.counted.count, 0);
    EXPECT_GT(taken.sample.score.score, 0.9);
  }
  EXPECT_EQ(*dut.record().metrics.dirt_gathering, 0);
  EXPECT_EQ(dut.audit().mean_dirt_per_m2, 0);
}

// A robot that thinks it is elsewhere presses its tapes where it truly is.
TEST_F(FloorAuditTest, ARobotThatIsWrongAboutItsPlaceSamplesAnotherOne) {
  const Audited dut =
      Run(kGiven, "dirt: {}\nestimator: odometry\nsensors: {encoders: {bias: 0.05}}");
  ASSERT_THAT(dut.audit().samples, SizeIs(4));
  EXPECT_GT(*dut.record().metrics.max_sample_off_m, 0.03);
  for (const AuditedSample& taken : dut.audit().samples) {
    const auto row = std::ranges::min_element(dut.record().trace, {}, [&](const TraceRow& r) {
      return std::abs(r.t_s - taken.stop.t_s);
    });
    EXPECT_NEAR(row->x_m, taken.stop.X_WB.x_m, 0.001);
    EXPECT_NEAR((taken.X_WT.p() - taken.stop.X_WB.p()).norm(),
                dut.scenario.world.robot.spec.audit_sensor_x_m, 1e-9);
  }
}

TEST_F(FloorAuditTest, RoundsOfCleaningTakeDirtUpWhereTheBrushGets) {
  const std::string cleaning =
      "dirt: {cleaning: {rounds: 5, plan: {planner: boustrophedon, tool_width_m: 0.17, "
      "radius_m: 0.22}}}";
  const Audited dirty = Run(kGiven, "dirt: {}"), dut = Run(kGiven, cleaning);
  EXPECT_LT(dut.audit().mean_dirt_per_m2, 0.8 * dirty.audit().mean_dirt_per_m2);
  EXPECT_LT(DirtAt(dut.audit(), {1.75, 1.5}), 0.7 * 80e3);
  EXPECT_GT(DirtAt(dut.audit(), {0.52, 1.5}), 0.95 * 80e3);  // along a wall
  EXPECT_LT(MeanCount(dut.audit()), 0.8 * MeanCount(dirty.audit()));
  EXPECT_GT(dut.audit().region.score.mean, dirty.audit().region.score.mean);
  const Audited strong =
      Run(kGiven, cleaning, {{"dirt.cleaning.pick_up", "1"}, {"dirt.cleaning.push_aside", "0"}});
  EXPECT_LT(DirtAt(strong.audit(), {1.75, 1.5}), 0.02 * 80e3);
}

TEST_F(FloorAuditTest, DirtIsTheEpisodesAndTheSameEachTime) {
  const auto particles = [&](const char* episode) {
    const Audited dut = Run(kGiven, "dirt: {}", {{"episode", episode}});
    std::vector<std::size_t> lifted;
    for (const AuditedSample& taken : dut.audit().samples)
      lifted.push_back(taken.sample.lifted.size());
    return lifted;
  };
  EXPECT_EQ(particles("0"), particles("0"));
  EXPECT_NE(particles("0"), particles("1"));
}

TEST_F(FloorAuditTest, TheRegionIsScoredByPartsWhereThePlacesWereFound) {
  const std::string gathers = "dirt: {wall_density_per_m2: 200000}";
  const Audited found = Run(kFound, gathers, {{"plan.samples.jitter", "true"}});
  const FloorAudit& audit = found.audit();
  ASSERT_TRUE(audit.near_walls && audit.elsewhere);
  EXPECT_LT(*audit.near_walls->score.mean, *audit.elsewhere->score.mean - 0.03);
  const SampledParts parts = *found.execution.plan.sampled_parts;
  // Of 2.5 m x 2 m, what lies within 0.3 m of the wall; the nose gets to all but some 4 cm of it.
  EXPECT_NEAR(parts.elsewhere, 1.9 * 1.4 / 5, 0.08);
  EXPECT_NEAR(parts.near_walls + parts.elsewhere, 2.41 * 1.91 / 5, 0.05);
  EXPECT_NEAR(audit.region.score.represented, parts.near_walls + parts.elsewhere, 1e-9);
  EXPECT_NEAR(*audit.region.score.mean,
              (parts.near_walls * *audit.near_walls->score.mean +
               parts.elsewhere * *audit.elsewhere->score.mean) /
                  audit.region.score.represented,
              1e-9);
  EXPECT_TRUE(audit.region.interval->Contains(*audit.region.score.mean));
  EXPECT_LE(audit.region.interval->upper, 1);
  // Along a wall a lattice sees one or two distances, so it cannot say how the rest may differ.
  const Audited lattice = Run(kFound, gathers);
  EXPECT_TRUE(lattice.audit().region.score.mean);
  EXPECT_FALSE(lattice.audit().region.interval || lattice.audit().near_walls->interval ||
               lattice.audit().elsewhere->interval);
  const Audited given = Run(kGiven, "dirt: {}");
  EXPECT_FALSE(given.audit().near_walls || given.audit().elsewhere);
  EXPECT_EQ(given.audit().region.score.samples, 4);
}

TEST_F(FloorAuditTest, PlanJsonListsWhatEachSampleHeld) {
  Save("points.csv", "x_m,y_m\n1,2\n2,1\n0.25,0.25\n");  // the last lies in a wall
  const Audited dut = Run(kGiven, "dirt: {}");
  const Json before = PlanJson(dut.scenario, dut.execution.plan)["sample_places"];
  EXPECT_EQ(before[0]["status"], "planned");
  EXPECT_TRUE(before[0]["dirt_count"].is_null() && before[0]["score"].is_null());
  const Json after = dut.plan()["sample_places"];
  EXPECT_EQ(after[2]["status"], "out_of_reach");
  EXPECT_TRUE(after[2]["dirt_count"].is_null());
  for (const AuditedSample& taken : dut.audit().samples) {
    const Json& place = after[static_cast<std::size_t>(taken.stop.place)];
    EXPECT_EQ(place["status"], "taken");
    EXPECT_EQ(place["dirt_count"], taken.sample.counted.count);
    EXPECT_EQ(place["score"], taken.sample.score.score);
    EXPECT_EQ(place["tape"]["particles"], taken.sample.lifted.size());
    EXPECT_NEAR(place["tape"]["x_m"], taken.X_WT.x_m, 1e-5);
  }
  const Json audit = ResultJson(dut.scenario, dut.record())["audit"];
  EXPECT_EQ(audit["samples"], 2);
  EXPECT_EQ(audit["score"], *dut.record().metrics.audit_score);
  EXPECT_LT(audit["lower"], audit["score"]);
}

// Where no dirt is laid, it is said all the same where samples were taken.
TEST_F(FloorAuditTest, WithoutDirtNothingIsCounted) {
  const Audited dut = Run(kGiven, "");
  EXPECT_FALSE(dut.record().audit);
  EXPECT_EQ(dut.record().metrics.samples_taken, 4);
  EXPECT_FALSE(dut.record().metrics.dirt_gathering || dut.record().metrics.audit_score);
  const Json place = dut.plan()["sample_places"][0];
  EXPECT_EQ(place["status"], "taken");
  EXPECT_TRUE(place["dirt_count"].is_null());
  EXPECT_FALSE(place["tape"].contains("particles"));
  EXPECT_FALSE(ResultJson(dut.scenario, dut.record()).contains("audit"));
}

TEST_F(FloorAuditTest, ADriveThatEndsEarlyTookFewer) {
  const Audited dut = Run(kGiven, "dirt: {}", {{"time_limit_s", "15"}});
  EXPECT_EQ(dut.record().outcome, Outcome::kTimeout);
  const std::size_t taken = dut.audit().samples.size();
  EXPECT_GE(taken, 1u);
  EXPECT_LT(taken, 4u);
  std::size_t not_taken = 0;
  const Json plan = dut.plan();
  for (const Json& place : plan["sample_places"]) not_taken += place["status"] == "not_taken";
  EXPECT_EQ(not_taken, 4 - taken);
}

// Whoever comes or bumps in the middle of a dwell.
class BreaksOff : public EpisodeObserver {
 public:
  BreaksOff(int place, std::function<void(mjData&)> how) : place_(place), how_(std::move(how)) {}
  bool OnControl(const EpisodeView& now) override {
    const Command& command = now.sample.command;
    if (command.tasks.empty() || command.tasks.front().id != place_) return true;
    constexpr int kPeriods = 10;  // of its second
    if (++periods_ == kPeriods) how_(*now.simulation->data());
    return true;
  }

 private:
  int place_;
  std::function<void(mjData&)> how_;
  int periods_ = 0;
};

TEST_F(FloorAuditTest, ASampleThatABumpBrokeOffIsTakenAfterAll) {
  Scenario s = Read(Room(kGiven, "dirt: {}\nreact: {}\non_failure: ignore"));
  // Carried a metre away, and pushed against a wall.
  const double x_m = 3 - s.world.robot.spec.circumscribed_radius_m - 0.02;
  BreaksOff bump(3, [x_m](mjData& d) {
    d.qpos[0] = x_m;
    d.qpos[3] = 1;
    d.qpos[4] = d.qpos[5] = d.qpos[6] = 0;
    d.qvel[0] = 1;
  });
  const Execution dut = Execute(s, &bump);
  EXPECT_EQ(dut.record.metrics.reactions, 1);
  EXPECT_EQ(dut.record.metrics.samples_taken, 4);
  EXPECT_LT(*dut.record.metrics.max_sample_off_m, 0.02);
}

TEST_F(FloorAuditTest, ASampleThatAFailureBrokeOffIsTakenOnceTheRobotIsHelped) {
  Scenario s = Read(Room(kGiven, "dirt: {}\non_failure: assist"));
  BreaksOff fall(3, [](mjData& d) {  // onto its back
    d.qpos[2] += 0.5;
    d.qpos[3] = d.qpos[5] = d.qpos[6] = 0;
    d.qpos[4] = 1;
  });
  const Execution dut = Execute(s, &fall);
  ASSERT_THAT(dut.record.interventions, SizeIs(1));
  EXPECT_EQ(dut.record.metrics.samples_taken, 4);
  EXPECT_LT(*dut.record.metrics.max_sample_off_m, 0.02);
}

TEST_F(FloorAuditTest, ABlindMicroscopeIsSaidAndCountsForNothing) {
  const Audited dut = Run(kGiven,
                          "dirt: {density_per_m2: 0, microscope: {mottle_grey: 0, light_fall: 0, "
                          "vignette: 0, noise_grey: 0}}");
  const Json place = dut.plan()["sample_places"][0];
  EXPECT_EQ(place["status"], "one_colour");
  EXPECT_TRUE(place["dirt_count"].is_null() && place["score"].is_null());
  EXPECT_THAT(std::string(place["message"]), HasSubstr("all pixels"));
  EXPECT_FALSE(dut.record().metrics.dirt_gathering || dut.record().metrics.audit_score);
  EXPECT_TRUE(ResultJson(dut.scenario, dut.record())["audit"]["score"].is_null());
}

TEST_F(FloorAuditTest, TheResolvedScenarioReadsBackAsTheSame) {
  const Scenario s = Read(Room(kGiven,
                               "dirt: {density_per_m2: 5000, tape: {side_m: 0.03}, cleaning: "
                               "{rounds: 2, plan: spiral, push_m: 0.2}}"));
  const std::string resolved = ResolvedScenario(s, folder_);
  const Scenario again = Read(resolved);
  ASSERT_TRUE(again.world.dirt);
  EXPECT_EQ(again.world.dirt->params.laid.density_per_m2, 5000);
  EXPECT_EQ(again.world.dirt->params.sampling.tape.side_m, 0.03);
  EXPECT_EQ(again.world.dirt->cleaner.name, "spiral");
  EXPECT_EQ(again.world.dirt->cleaning.rounds, 2);
  EXPECT_EQ(again.world.dirt->cleaning.brush.push_m, 0.2);
  EXPECT_EQ(ResolvedScenario(again, folder_), resolved);
  EXPECT_FALSE(Read(Room(kGiven, "dirt: null")).world.dirt);
}

// Places that lie anywhere in their cells are no reason to stop within a wall.
TEST_F(FloorAuditTest, AFootprintIsClearOfWallsWhereverItsPlacesLie) {
  int stops = 0;
  for (const char* seed : {"0", "1", "2", "3", "4", "5"}) {
    const Scenario s =
        Read(Room("{planner: audit, samples: {du_m: 0.2, jitter: true}}", ""),
             {{"robot", "htetro"}, {"seed", seed}, {"start.x_m", "1.75"}, {"start.y_m", "1.5"}});
    const PlanResult plan = MakePlan(s);
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    // Walls of a drawn grid stand back from their cells' edges.
    const Polygon clear_B =
        Offset(s.world.robot.spec.clear.footprint_B, -s.world.site.map.inset_m - 0.0005);
    for (const Waypoint& w : plan.path) {
      if (!w.task) continue;
      ++stops;
      const Pose2 X_WB{w.p_W.x(), w.p_W.y(), w.yaw_rad.value_or(0)};
      EXPECT_FALSE(TouchesWall(s.world.site.map, InWorld(X_WB, clear_B))) << seed << ": " << w.p_W;
    }
  }
  EXPECT_GT(stops, 30);
}

TEST_F(FloorAuditTest, WhatCannotBeIsRefusedWithItsKey) {
  const auto refusal = [&](const std::string& dirt) -> std::string {
    try {
      Read(Room(kGiven, "dirt: " + dirt));
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  };
  EXPECT_THAT(refusal("{densty_per_m2: 1}"), HasSubstr("density_per_m2"));
  EXPECT_THAT(refusal("{density_per_m2: -1}"),
              HasSubstr("dirt.density_per_m2 = -1: must be in [0, 1e+15]"));
  EXPECT_THAT(refusal("{density_per_m2: 3e7}"),
              HasSubstr("must be at most 20000000 on this floor"));
  EXPECT_THAT(refusal("{least_diameter_m: 0.002}"),
              HasSubstr("dirt.least_diameter_m = 0.002: must not be above most_diameter_m, 0.001"));
  EXPECT_THAT(refusal("{tape: {side_m: 0.1}, microscope: {pixels_per_mm: 50}}"),
              HasSubstr("dirt.microscope.pixels_per_mm = 50: makes an image of 5000 pixels"));
  EXPECT_THAT(refusal("{tape: {side_m: 0.1}, microscope: {pixels_per_mm: 50}}"),
              HasSubstr("scenario.yaml:"));
  EXPECT_THAT(refusal("{tape: {side_m: 0.001}, microscope: {pixels_per_mm: 5}}"),
              HasSubstr("makes an image of 5 pixels a side: it must have 11 to 2000"));
  EXPECT_THAT(refusal("{tape: {side_m: 0.1}, microscope: {blur_px: 1}}"), "taken");
  const std::string too_much = refusal("{wall_density_per_m2: 1e12}");
  EXPECT_THAT(too_much, HasSubstr("dirt.wall_density_per_m2 = 1e+12: must be at most "));
  const auto most = std::stoll(too_much.substr(too_much.find("at most ") + 8));
  EXPECT_THAT(refusal("{wall_density_per_m2: " + std::to_string(most) + "}"), "taken");
  EXPECT_THAT(refusal("{wall_density_per_m2: " + std::to_string(most + 2) + "}"),
              HasSubstr("at most"));
  EXPECT_THAT(refusal("{wall_density_per_m2: 1e308}"),
              HasSubstr("dirt.wall_density_per_m2 = 1e308: must be in"));
  EXPECT_THAT(refusal("{density_per_m2: 1e308}"), HasSubstr("dirt.density_per_m2 = 1e308: must"));
  EXPECT_THAT(refusal("{wall_density_per_m2: 1e7}"), "taken");
  EXPECT_THAT(refusal("{cleaning: {plan: audit}}"),
              HasSubstr("dirt.cleaning.plan.planner = audit: goes to places and cleans no floor"));
  EXPECT_THAT(refusal("{cleaning: {plan: rolling_window}}"), HasSubstr("unknown floor"));
  EXPECT_THAT(refusal("{cleaning: {plan: boustrofedon}}"),
              AllOf(HasSubstr("did you mean boustrophedon"), Not(HasSubstr("audit)")),
                    Not(HasSubstr("audit "))));
  EXPECT_THAT(refusal("{cleaning: {round: 3}}"), HasSubstr("rounds"));
  EXPECT_THAT(refusal("clean"), HasSubstr("dirt"));
  EXPECT_THAT(refusal("[1]"), HasSubstr("dirt"));
}

TEST_F(FloorAuditTest, ACleanerThatFindsNoPlanEndsTheEpisodeBeforeItsDrive) {
  Scenario s = Read(Room(kGiven,
                         "dirt: {cleaning: {rounds: 1, plan: {planner: boustrophedon, "
                         "radius_m: 3}}}"));
  EXPECT_THAT([&] { Execute(s); }, ThrowsMessage<InputError>(AllOf(
                                       HasSubstr("scenario.yaml:"),
                                       HasSubstr("dirt.cleaning.plan.planner = boustrophedon: "
                                                 "finds no plan"))));
}

TEST_F(FloorAuditTest, DirtThatNobodySamplesIsWarnedOf) {
  const auto warnings = [&](const std::string& plan, const std::string& dirt) {
    return Warnings(Read(Room(plan, dirt)));
  };
  EXPECT_THAT(warnings("boustrophedon", "dirt: {}"), Contains(HasSubstr("takes no samples")));
  EXPECT_THAT(warnings(kGiven, "dirt: {}"), Not(Contains(HasSubstr("takes no samples"))));
  EXPECT_THAT(warnings("boustrophedon", ""), IsEmpty());
  EXPECT_THAT(warnings(kGiven, "dirt: {}\ndrive: none"), Contains(HasSubstr("nothing is driven")));
  EXPECT_FALSE(Run("boustrophedon", "dirt: {}\ntime_limit_s: 1").record().audit);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// No seam is felt on real maps. Each robot drives its own plan on each map for some minutes, over a
// floor that pits outside the map cut into slabs, and moves up and down less than the stated bound.
// Slow.
#include <algorithm>

#include "run/episode/make_plan.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario.h"
#include "tests/physics/real_map.h"
#include "validate/vertical_motion.h"

namespace floorproof {
namespace {

// Looks on at 50 Hz: differences of 20 ms.
class Heave final : public EpisodeObserver {
 public:
  bool OnControl(const EpisodeView& now) override {
    motion.Update(now.sample);
    return true;
  }
  VerticalMotion motion{1};
};

// Pits to the left of the map, whose edges, as seams along the map's rows, cross the floor around
// the start every 0.3 m.
void CutIntoSlabs(HazardMap& map, const Pose2& start) {
  constexpr int kPits = 10;
  constexpr double kEvery_m = 0.6;
  const Vec2 start_G = map.frame.X_WG.Inverse() * start.p();
  for (int i = 0; i < kPits; ++i) {
    const double y_m = start_G.y() + (i - kPits / 2) * kEvery_m;
    Polygon outline = Rectangle({-1.9, y_m}, {-0.5, y_m + kEvery_m / 2});
    for (Vec2& corner : outline) corner = map.frame.X_WG * corner;
    Hazard pit;
    pit.id = "pit" + std::to_string(i);
    pit.known = false;
    pit.solids = {{Solid::Kind::kCut, outline, {}, -0.1, 0}};
    map.hazards.push_back(pit);
  }
}

class SeamsOnRealMaps : public RealMapTest {};

// Tyres that scrub sag less than tyres that roll: a robot heaves by that much without seams, too.
TEST_P(SeamsOnRealMaps, AreNotFelt) {
  constexpr double kMore_m = 0.0001;
  Heave whole, dut;
  for (Heave* heave : {&whole, &dut}) {
    Scenario scenario = ReadInit({{"time_limit_s", "180"}});
    if (heave == &dut) CutIntoSlabs(scenario.world.site.map, scenario.world.start);
    const PlanResult plan = MakePlan(scenario);
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    const Scene scene = BuildScene(scenario.world.site.map, scenario.world.robot,
                                   scenario.world.physics, scenario.world.start);
    if (heave == &dut) {
      ASSERT_GT(scene.num_floor_geoms, 10) << "there are seams to cross";
    }
    Agents agents = MakeAgents(scenario.spec);
    const EpisodeRecord record = RunEpisode(scenario, agents, scene, plan, heave);
    EXPECT_NE(record.outcome, Outcome::kError) << record.message;
    EXPECT_TRUE(record.events.empty());
    EXPECT_GT(record.metrics.path_length_m, 10);
  }
  EXPECT_LT(dut.motion.accel_mps2(), kMaxHeave_mps2);
  EXPECT_LT(dut.motion.height_m(), std::max(kMaxHeave_m, whole.motion.height_m() + kMore_m));
  RecordProperty("accel_mps2", std::to_string(dut.motion.accel_mps2()));
  RecordProperty("height_m", std::to_string(dut.motion.height_m()));
}

INSTANTIATE_TEST_SUITE_P(Maps, SeamsOnRealMaps,
                         ::testing::ValuesIn(EachRobotOn({"apartment", "depot", "fetch_hq_2015",
                                                          "lab_small", "office_plan", "office_scan",
                                                          "small_house", "willow_2010"})));

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a plan is said to lead over, against geometry that is known.
#include "run/plan_check/driven_over.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "run/plan_check/plan_check.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr const char* kCover = "{type: cable_cover, id: cover, line_m: [[4, 0.5], [4, 4.5]]";

class DrivenOverTest : public ScenarioTest {
 protected:
  // A plan in the room of RoomScenario, starting at (1.5, 2.5).
  Scenario Room(const std::string& hazards, const std::string& rows) {
    Save("plan.csv", "x_m,y_m\n1.5,2.5\n" + rows);
    return Read(RoomScenario(hazards));
  }
  static std::vector<DrivenOver> Find(const Scenario& scenario) {
    return FindDrivenOver(scenario.world, MakePlan(scenario));
  }
};

TEST_F(DrivenOverTest, EveryTimeThatTheWayLeadsOverItCounts) {
  for (const int times : {0, 1, 2, 5}) {
    std::string rows = "2,2.5\n";
    for (int i = 0; i < times; ++i) rows += i % 2 == 0 ? "5.5,2.5\n" : "2,2.5\n";
    const auto dut = Find(Room(std::string(kCover) + "}", rows));
    ASSERT_THAT(dut, SizeIs(times > 0)) << times;
    for (const DrivenOver& driven : dut) EXPECT_EQ(driven.times, times);
  }
}

// Turned by whatever angle, also by one degree; and beside it by a centimetre it is not met.
TEST_F(DrivenOverTest, HoweverItLies) {
  for (const double yaw_deg : {0.0, 1.0, 45.0, 90.0, 136.0})
    for (const bool over : {true, false}) {
      const Pose2 X{4, 2.5, yaw_deg * kPi / 180};
      const double x_m = over ? 0.10 : 0.19;  // BELUGA's radius is 0.18
      std::string corners;
      for (const Vec2& p : Rectangle({x_m, -0.3}, {x_m + 0.1, 0.3}))
        corners += fmt::format("{}[{}, {}]", corners.empty() ? "" : ", ", (X * p).x(), (X * p).y());
      const Vec2 from = X * Vec2(0, -1), to = X * Vec2(0, 1);
      const Scenario scenario =
          Room("{type: rough, id: mat, polygon_m: [" + corners + "]}",
               fmt::format("{},{}\n{},{}\n", from.x(), from.y(), to.x(), to.y()));
      PlanResult plan = MakePlan(scenario);
      plan.path.erase(plan.path.begin());
      const auto dut = FindDrivenOver(scenario.world, plan);
      ASSERT_THAT(dut, SizeIs(over)) << yaw_deg;
      if (!over) continue;
      EXPECT_EQ(dut.front().times, 1) << yaw_deg;
      EXPECT_NEAR(dut.front().over_m, 0.6 + 0.36, 0.5) << yaw_deg;
    }
}

// What the robot must keep off is a place of the clearance where it is known; where not, the plan
// was made without it.
TEST_F(DrivenOverTest, WhatIsNotKnownIsSaidWhateverItIs) {
  const std::string post =
      "{type: blind_object, id: post, polygon_m: [[3.9, 2.4], [4.1, 2.4], [4.1, 2.6], [3.9, 2.6]]";
  EXPECT_THAT(Find(Room(post + "}", "5.5,2.5\n")), IsEmpty());
  EXPECT_THAT(Find(Room(post + ", known: false}", "5.5,2.5\n")), SizeIs(1));
  EXPECT_THAT(Find(Room(post + ", known: false}", "3.5,2.5\n")), IsEmpty()) << "stops before it";
}

// A pit through a cover takes the cover away there, and so does a wide groove.
TEST_F(DrivenOverTest, WhatALaterFloorTookAwayIsNotMet) {
  const std::string sill =
      "{type: step, id: sill, polygon_m: [[3, 1.5], [5, 1.5], [5, 3.5], [3, 3.5]], height_m: "
      "0.004}";
  const auto ids = [&](const std::string& hazards) {
    const Scenario scenario = Room(hazards, "5.5,2.5\n");
    std::vector<std::string> found;
    for (const DrivenOver& driven : Find(scenario))
      found.push_back(TrueFloor(scenario.world).hazards[driven.hazard].id);
    return found;
  };
  using ::testing::UnorderedElementsAre;
  const std::string groove =
      "{type: groove, id: groove, line_m: [[4, 0.5], [4, 4.5]], width_m: 1, depth_m: 0.002}";
  EXPECT_THAT(ids(std::string(kCover) + "}, " + groove), UnorderedElementsAre("groove"));
  EXPECT_THAT(ids(groove + ", " + kCover + "}"), UnorderedElementsAre("groove", "cover"));
  EXPECT_THAT(ids(std::string(kCover) + "}, " + sill), UnorderedElementsAre("sill", "cover"))
      << "it lies on the sill, whichever is written first";
  EXPECT_THAT(ids(sill + ", " + kCover + "}"), UnorderedElementsAre("sill", "cover"));
}

// Whatever floor it starts on.
TEST_F(DrivenOverTest, FromARaisedFloorTheSameIsMet) {
  const std::string cover = std::string(kCover) + ", known: false}";
  for (const char* platform :
       {"",
        "{type: step, id: low, polygon_m: [[0.5, 0.5], [3, 0.5], [3, 4.5], [0.5, 4.5]], "
        "height_m: 0.005}, "}) {
    const Scenario scenario = Room(platform + cover, "5.5,2.5\n");
    const auto dut = Find(scenario);
    const HazardMap floor = TrueFloor(scenario.world);
    ASSERT_FALSE(dut.empty());
    EXPECT_EQ(floor.hazards[dut.front().hazard].id, "cover") << platform;
    EXPECT_EQ(dut.front().times, 1);
  }
}

TEST_F(DrivenOverTest, LinesAndJsonSayWhatThePlannerIsNotToldOf) {
  Scenario scenario = Room(
      std::string(kCover) +
          ", height_m: 0.020}, {type: step, id: plank, known: false, height_m: 0.040, polygon_m: "
          "[[5, 2], [5.1, 2], [5.1, 3], [5, 3]]}",
      "5.7,2.5\n3,2.5\n");
  const PlanResult plan = MakePlan(scenario);
  const PlanCheck check = CheckPlan(scenario, plan);
  std::string text;
  for (const std::string& line : PlanLines(scenario, plan, check)) text += line + "\n";
  EXPECT_THAT(text,
              HasSubstr("leads into 'plank' (step, 40 mm), which the planner is not told of, 2 "
                        "times\ndrives over 'cover' (cable cover, 20 mm) 2 times\n"));
  EXPECT_THAT(text, Not(HasSubstr("warning")));
  const auto json = PlanCheckJson(scenario.world, check);
  ASSERT_EQ(json["driven_over"].size(), 2u);
  EXPECT_EQ(json["driven_over"][0]["known"], false);
  EXPECT_EQ(json["driven_over"][1]["times"], 2);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What each robot's physics says of hazards that lie across its path: which failure occurs, where,
// and that it is named; and that what must pass does.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/streams.h"
#include "run/scenario/override.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class Hazards : public ScenarioTest, public ::testing::WithParamInterface<const char*> {
 protected:
  Hazards() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n7,2.5\n"); }

  // Something across the room from x = 4 m, of this type and keys.
  static std::string Strip(const std::string& keys) { return Strip(keys, "it", 4); }
  static std::string Strip(const std::string& keys, const std::string& id, double x_m) {
    return fmt::format(
        "{{id: {0}, known: false, {1}, polygon_m: [[{2}, 0.5], [{3}, 0.5], [{3}, 4.5], [{2}, "
        "4.5]]}}",
        id, keys, x_m, x_m + 1);
  }
  static std::string Line(const std::string& keys) { return Line(keys, "it", 4); }
  static std::string Line(const std::string& keys, const std::string& id, double x_m) {
    return fmt::format("{{id: {}, known: false, {}, line_m: [[{}, 0.5], [{}, 4.5]]}}", id, keys,
                       x_m, x_m);
  }
  EpisodeRecord Meet(const std::string& hazard, std::vector<Override> overrides = {},
                     EpisodeObserver* observer = nullptr) const {
    overrides.push_back({"robot", GetParam()});
    return Drive(Read(RoomScenario(hazard), overrides), observer);
  }
  bool IsHtetro() const { return std::string(GetParam()) == "htetro"; }
  // From the robot's centre to its front wheels' foremost point, and to its front.
  double wheel_front_m() const { return IsHtetro() ? 0.24 : 0.18; }
  double front_m() const { return IsHtetro() ? 0.25 : 0.18; }

  static void ExpectFirst(const EpisodeRecord& dut, FailureMode mode, const std::string& hazard) {
    EXPECT_EQ(dut.outcome, Outcome::kFailure);
    ASSERT_FALSE(dut.events.empty());
    EXPECT_EQ(dut.events[0].mode, mode) << dut.events[0].kind << " at x " << dut.events[0].x_m;
    EXPECT_EQ(dut.events[0].hazard, hazard);
  }
  static void ExpectNothing(const EpisodeRecord& dut) {
    EXPECT_EQ(dut.outcome, Outcome::kSuccess);
    for (const Event& e : dut.events) ADD_FAILURE() << Name(e.mode) << " " << e.kind;
    EXPECT_LT(dut.metrics.max_cross_track_m, 0.05);
  }
};

const char* const kRobots[] = {"beluga", "htetro"};
INSTANTIATE_TEST_SUITE_P(Robots, Hazards, ::testing::ValuesIn(kRobots),
                         [](const auto& robot) { return std::string(robot.param); });

TEST_P(Hazards, AStepOf40mmHoldsTheRobotAndIsNamed) {
  const EpisodeRecord dut = Meet(Strip("type: step, height_m: 0.040"));
  ExpectFirst(dut, FailureMode::kStuck, "it");
  EXPECT_NEAR(dut.events.at(0).x_m, 4 - wheel_front_m(), 0.05) << "it stands at the face";
  EXPECT_NEAR(dut.events.at(0).y_m, 2.5, 0.05);
}

TEST_P(Hazards, AGlassWallThrowsItBack) {
  const EpisodeRecord dut =
      Meet(Line("type: glass, height_m: 1, thickness_m: 0.01, restitution: 0.5"));
  ExpectFirst(dut, FailureMode::kBounceBack, "it");
  EXPECT_NEAR(dut.events.at(0).x_m, 4 - 0.005 - front_m(), 0.05);
}

TEST_P(Hazards, ADropOf150mmIsAFall) {
  const EpisodeRecord dut = Meet(Strip("type: step, height_m: -0.150"));
  ExpectFirst(dut, FailureMode::kRollOver, "it");
  EXPECT_EQ(dut.events.at(0).kind, "fell");
  EXPECT_GT(dut.events.at(0).x_m, 4 - front_m());
  EXPECT_LT(dut.events.at(0).x_m, 4.5);
}

// Wider and deeper than BELUGA's wheel is tall in it: both wheels drop in and the far face holds
// them. hTetro stands on three other rows of wheels meanwhile; nothing narrower than the distance
// of its middle rows' far sides can take it.
TEST_P(Hazards, AGrooveWiderThanTheWheelsHoldsBelugaAndIsBridgedByHtetro) {
  const EpisodeRecord dut = Meet(Line("type: groove, width_m: 0.12, depth_m: 0.050"));
  if (IsHtetro()) {
    ExpectNothing(dut);
    return;
  }
  ExpectFirst(dut, FailureMode::kStuck, "it");
  EXPECT_NEAR(dut.events.at(0).x_m, 4, 0.25);
}

// However deep and wide: whichever failure it is, the groove is named, though the robot touches
// only the floor around it. hTetro bridges grooves of 0.2 m, not of 0.25 m: its wheel rows stand
// 0.17 and 0.08 m apart, and a row over the gap must not be the last that carries its side.
// Also where it is cut through a mat: what it hits is the groove's face.
TEST_P(Hazards, AWideGrooveIsNamedWhateverItDoes) {
  const std::string mat =
      "{id: mat, known: false, type: step, height_m: 0.001, polygon_m: [[3.4, 0.5], [4.6, 0.5], "
      "[4.6, 4.5], [3.4, 4.5]]}, ";
  for (const std::string& under : {std::string(), mat})
    for (const std::string& width : under.empty()
                                        ? std::vector<std::string>{"0.12", "0.20", "0.25", "0.30"}
                                        : std::vector<std::string>{"0.20", "0.25"}) {
      const EpisodeRecord dut =
          Meet(under + Line("type: groove, depth_m: 0.06, width_m: " + width));
      const bool bridged = IsHtetro() && std::stod(width) < 0.22;
      EXPECT_EQ(dut.outcome, bridged ? Outcome::kSuccess : Outcome::kFailure) << width;
      for (const Event& e : dut.events)
        EXPECT_EQ(e.hazard, "it") << under << width << " " << Name(e.mode);
    }
}

// A person's shove, aside of the way, for two seconds.
struct Shove : EpisodeObserver {
  bool OnControl(const EpisodeView& now) override {
    const double t_s = now.sample.t_s;
    now.simulation->data()
        ->xfrc_applied[6 * mj_name2id(now.simulation->model(), mjOBJ_BODY, "base") + 1] =
        t_s > 5 && t_s < 7 ? 1.3 * 9.81 * 12 : 0;
    return true;
  }
};

TEST_P(Hazards, AShoveIsAVeer) {
  Shove shove;
  const EpisodeRecord dut = Meet("", {}, &shove);
  ExpectFirst(dut, FailureMode::kVeerOff, "");
  EXPECT_GT(dut.events.at(0).t_s, 5);
  EXPECT_LT(dut.events.at(0).t_s, 8);
  EXPECT_GT(dut.events.at(0).y_m, 2.5 + 0.4);
}

TEST_P(Hazards, WhatMustPassDoes) {
  // One after the other: each is flat floor away from the next, by more than the robot's length.
  ExpectNothing(Meet(Strip("type: step, height_m: 0.002", "up", 2.2) + ", " +
                     Strip("type: step, height_m: -0.006", "down", 3.8) + ", " +
                     Strip("type: rough, amplitude_m: 0.002, wavelength_m: 0.2", "rough", 5.4)));
  ExpectNothing(Meet(
      Line("type: groove, width_m: 0.005, depth_m: 0.05", "narrow", 2.5) + ", " +
      Line("type: groove, width_m: 0.010, depth_m: 0.01", "shallow", 3.8) + ", " +
      Line("type: cable_cover, width_m: 0.10, top_width_m: 0.04, height_m: 0.008", "cover", 5.2)));
}

TEST_P(Hazards, UpToItsStepItGoesUpAndDownAgain) {
  for (const double share : {0.5, 1.0}) {
    const double height_m = share * ReadRobot(FindRobotFile(GetParam(), {})).spec.step_m;
    const EpisodeRecord dut = Meet(Strip("type: step, height_m: " + std::to_string(height_m)));
    ExpectNothing(dut);
    float highest = 0;
    for (const auto& row : dut.trace) highest = std::max(highest, row.z_m);
    EXPECT_NEAR(highest, height_m, 0.003) << "it was on the step";
  }
}

// Planners take a robot across level changes up to its step_m, whichever way they lie: also across
// an edge at 45 degrees, slowly.
TEST_P(Hazards, UpToItsStepItCrossesAnEdgeAslant) {
  Save("plan.csv", "x_m,y_m,yaw_rad,speed_mps\n1.5,2.5,0,0.1\n7.5,2.5,0,0.1\n");
  const double step_m = ReadRobot(FindRobotFile(GetParam(), {})).spec.step_m;
  ExpectNothing(Meet("{id: it, known: false, type: step, height_m: " + std::to_string(step_m) +
                     ", polygon_m: [[3, 0.5], [8.4, 0.5], [8.4, 4.5], [7, 4.5]]}"));
}

// The planner goes round what it knows of; the same step unseen is met.
TEST_P(Hazards, WhatIsKnownIsAvoided) {
  const std::string plank =
      "{id: it, type: step, height_m: 0.04, polygon_m: [[2.5, 1.5], [2.8, 1.5], [2.8, 3], [2.5, "
      "3]]";
  const std::vector<Override> planned = {
      {"plan", "{planner: boustrophedon}"},
      {"site.grid.rows",
       "\"##########\\n#........#\\n#........#\\n#........#\\n#........#\\n#........#\\n"
       "#........#\\n##########\\n\""}};
  const EpisodeRecord known = Meet(plank + "}", planned);
  EXPECT_EQ(known.outcome, Outcome::kSuccess);
  EXPECT_TRUE(known.events.empty());
  const EpisodeRecord unseen = Meet(plank + ", known: false}", planned);
  ExpectFirst(unseen, FailureMode::kStuck, "it");
}

// Friction and restitution of a hazard's own: on ice the wheels find no way up, and from a livelier
// wall the robot comes back faster.
TEST_P(Hazards, TheirMaterialIsFelt) {
  const std::string ramp = "type: cable_cover, width_m: 1.4, top_width_m: 0.1, height_m: 0.06";
  const EpisodeRecord gripping = Meet(Line(ramp));
  const EpisodeRecord icy = Meet(Line(ramp + ", friction: 0.02"));
  EXPECT_EQ(gripping.outcome, Outcome::kSuccess);
  EXPECT_EQ(icy.outcome, Outcome::kFailure);

  const auto rebound = [&](const std::string& restitution) {
    const EpisodeRecord dut =
        Meet(Line("type: glass, height_m: 1, thickness_m: 0.01, restitution: " + restitution),
             {{"failures.bounce_back.rebound_share", "0"}});
    for (const auto& [name, value] : dut.events.at(0).evidence)
      if (name == "rebound_mps") return value;
    return -1.0;
  };
  EXPECT_GT(rebound("0.9"), 1.2 * rebound("0.3"));
}

class NullTest : public Hazards {};
INSTANTIATE_TEST_SUITE_P(Robots, NullTest, ::testing::ValuesIn(kRobots),
                         [](const auto& robot) { return std::string(robot.param); });

// On a flat, empty floor nothing fails, whatever the start, heading, friction and path. Hundreds of
// drives more, at any speed and over small edges, are in getting_on_test.cc.
TEST_P(NullTest, AFlatFloorHasNoEvents) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Stream draw(seed, 0, "null test");
    std::string plan = "x_m,y_m\n";
    for (int i = 0; i < 6; ++i)
      plan += std::to_string(draw.Uniform(1, 8)) + "," + std::to_string(draw.Uniform(1, 4)) + "\n";
    Save("plan.csv", plan);
    const std::string start = "start: {x_m: " + std::to_string(draw.Uniform(1, 8)) +
                              ", y_m: " + std::to_string(draw.Uniform(1, 4)) +
                              ", yaw_deg: " + std::to_string(draw.Uniform(-180, 180)) + "}\n";
    const EpisodeRecord dut = Drive(Read(
        RoomScenario("", start),
        {{"robot", GetParam()}, {"site.floor.friction", std::to_string(draw.Uniform(0.4, 1.0))}}));
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << "seed " << seed;
    EXPECT_TRUE(dut.events.empty()) << "seed " << seed;
    EXPECT_EQ(dut.metrics.contacts, 0) << "seed " << seed;
    for (const auto& margin : dut.margins) EXPECT_GT(margin.value, 0) << margin.detector;
  }
}

// A robot as wide as a grid's cell drives a corridor of one cell: solids are drawn back a little.
class Corridor : public ScenarioTest {};

TEST_F(Corridor, OneCellWideIsDrivenWithoutTouching) {
  const EpisodeRecord dut = Drive(Read(R"(scenario: 1
site:
  site: 1
  grid:
    cell_m: 0.5
    inset_m: 0.03
    rows: |
      ###########
      #....#....#
      #....#....#
      ####.#.####
      ####...####
      ###########
  start: {x_m: 0.75, y_m: 2.25}
robot: htetro
plan: {planner: boustrophedon}
success: {min_coverage: 0.95}
)"));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_TRUE(dut.events.empty());
  EXPECT_EQ(dut.metrics.contacts, 0);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// hTetro's blocks: seven shapes, and folding from one into another by its own motors alone.
#include <gmock/gmock.h>

#include "controllers/reconfiguration.h"
#include "run/scenario/scenario_file.h"
#include "tests/places.h"
#include "tests/run/scenario_text.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

const std::vector<std::string> kShapes = {"O", "I", "L", "J", "S", "Z", "T"};

RobotModel Hinged(const std::string& shape = "") {
  return ReadRobot(FindRobotFile("htetro", {}), {.shape = shape}, Blocks::kHinged);
}

// Squares of a quarter of a metre that the footprint covers, as rows of 0.25 m cells.
double Extent(const Polygon& footprint, int axis) {
  double low = 1e9, high = -1e9;
  for (const Vec2& p : footprint) low = std::min(low, p[axis]), high = std::max(high, p[axis]);
  return high - low;
}

TEST(Folding, AllSevenTetrominoesAreShapesOfOneChain) {
  const RobotSpec robot = Hinged().spec;
  ASSERT_EQ(robot.shapes.size(), kShapes.size());
  for (const ShapeSpec& shape : robot.shapes) {
    SCOPED_TRACE(shape.name);
    EXPECT_NEAR(SignedArea(shape.footprint_B), 4 * 0.25 * 0.25, 1e-4);
    EXPECT_TRUE(Contains(shape.footprint_B, Vec2::Zero()));
    EXPECT_GT(shape.static_tip_rad, 0.9) << "wide enough not to tip below 50 degrees";
    const double x = Extent(shape.footprint_B, 0), y = Extent(shape.footprint_B, 1);
    const double high = std::max(x, y), low = std::min(x, y);
    EXPECT_NEAR(high, shape.name == "I" ? 1.0 : (shape.name == "O" ? 0.5 : 0.75), 1e-4);
    EXPECT_NEAR(low, shape.name == "I" ? 0.25 : 0.5, 1e-4);
    EXPECT_EQ(shape.footprint_B.size(), shape.name == "I" || shape.name == "O"   ? 4u
                                        : shape.name == "L" || shape.name == "J" ? 6u
                                                                                 : 8u);
  }
  // L and J, S and Z are each other's mirror images, and not the same shape turned.
  EXPECT_NE(robot.shapes[2].footprint_B, robot.shapes[3].footprint_B);
  EXPECT_LT(robot.shapes[1].static_tip_rad, robot.shapes[0].static_tip_rad) << "I is narrower";
}

TEST(Folding, FromEveryShapeToEveryOtherNoBlocksCollide) {
  const RobotSpec robot = Hinged().spec;
  for (const ShapeSpec& from : robot.shapes)
    for (const ShapeSpec& to : robot.shapes) {
      SCOPED_TRACE(from.name + " to " + to.name);
      const HingeWay way = FoldingWay(robot, from.hinge_rad, to.hinge_rad);
      ASSERT_FALSE(way.empty());
      EXPECT_THAT(way.front(), ::testing::Pointwise(::testing::DoubleNear(1e-9), from.hinge_rad));
      EXPECT_THAT(way.back(), ::testing::Pointwise(::testing::DoubleNear(1e-9), to.hinge_rad));
      for (std::size_t leg = 0; leg + 1 < way.size(); ++leg)
        for (double share = 0; share <= 1; share += 0.05) {
          std::vector<double> rad;
          for (std::size_t h = 0; h < 3; ++h)
            rad.push_back(way[leg][h] + share * (way[leg + 1][h] - way[leg][h]));
          EXPECT_FALSE(BlocksCollide(robot, rad)) << "leg " << leg << " at " << share;
        }
    }
}

TEST(Folding, BlocksThatRunIntoEachOtherCollide) {
  const RobotSpec robot = Hinged().spec;
  EXPECT_FALSE(BlocksCollide(robot, robot.shapes[0].hinge_rad));
  EXPECT_TRUE(BlocksCollide(robot, std::vector{kPi, kPi, kPi})) << "folded onto themselves";
}

// Hinges that hold still make no difference: the square drives as the one body does.
TEST(Folding, TheHingedSquareDrivesAsTheLockedOne) {
  const BodyTwist twist{0.15, 0.1, 0.2};
  Rig locked("htetro"), hinged("htetro", {.blocks = Blocks::kHinged});
  EXPECT_EQ(locked.truth().hinges.n, 0);
  EXPECT_EQ(hinged.truth().hinges.n, 3);
  locked.Run(twist, 4);
  hinged.Run(twist, 4);
  EXPECT_NEAR(hinged.truth().p_WB.x(), locked.truth().p_WB.x(), 0.003);
  EXPECT_NEAR(hinged.truth().p_WB.y(), locked.truth().p_WB.y(), 0.003);
  EXPECT_NEAR(hinged.truth().yaw_rad, locked.truth().yaw_rad, 0.005);
  EXPECT_EQ(hinged.truth().shape, 0);
}

// Locked in any of its shapes it drives every way as its wheels turn.
class LockedShape : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shapes, LockedShape, ::testing::ValuesIn(kShapes),
                         [](const auto& shape) { return shape.param; });

TEST_P(LockedShape, DrivesEveryWay) {
  for (const BodyTwist& twist :
       {BodyTwist{0.2, 0, 0}, BodyTwist{0, 0.2, 0}, BodyTwist{0, 0, 0.4}}) {
    Rig dut("htetro", {.changes = {.shape = GetParam()}});
    EXPECT_NEAR(dut.robot().mass_kg, 11, 1e-9);
    EXPECT_EQ(dut.truth().wheel_contacts, 16);
    const BodyTwist v = dut.Run(twist, 2);
    EXPECT_NEAR(v.vx_mps, twist.vx_mps, 0.001);
    EXPECT_NEAR(v.vy_mps, twist.vy_mps, 0.001);
    EXPECT_NEAR(v.wz_radps, twist.wz_radps, 0.004);
  }
}

// Folds a hinged hTetro from the square by the controller's own way.
class Fold {
 public:
  explicit Fold(const std::string& to)
      : rig_("htetro", {.blocks = Blocks::kHinged}),
        way_(FoldingWay(
            rig_.robot(), rig_.robot().shapes[0].hinge_rad,
            rig_.robot().shapes[static_cast<std::size_t>(FindShape(rig_.robot(), to))].hinge_rad)) {
    reconfiguration_.Start(rig_.robot());
    reconfiguration_.Fold(way_);
  }
  // One physics step; false when the shape is reached and all is at rest again.
  bool Step() {
    constexpr int kStepsAControl = 5;
    constexpr double kRest_s = 0.5;
    if (step_++ % kStepsAControl == 0) {
      const HingeState hinges =
          reconfiguration_.Update(rig_.truth().hinges, 0.004 * kStepsAControl);
      rig_.Command({}, hinges);
    }
    rig_.Step();
    if (!reconfiguration_.done()) done_s_ = rig_.truth().t_s;
    return rig_.truth().t_s < done_s_ + kRest_s && rig_.truth().t_s < 60;
  }
  Rig& rig() { return rig_; }

 private:
  Rig rig_;
  HingeWay way_;
  Reconfiguration reconfiguration_;
  int step_ = 0;
  double done_s_ = 0;
};

// Hinge torque and wheel contact alone move the blocks: no force from outside, no weld, no place
// written; and the motors' work is what friction and damping took, for it begins and ends at rest.
TEST(Folding, IsTheWorkOfItsMotors) {
  Fold dut("I");
  const mjModel* m = dut.rig().sim().model();
  mjData* d = dut.rig().data();
  EXPECT_EQ(m->neq, 0);
  EXPECT_EQ(m->nmocap, 0);
  std::vector<double> q_before(static_cast<std::size_t>(m->nq)),
      v_before(static_cast<std::size_t>(m->nv)), v_by_places(static_cast<std::size_t>(m->nv));
  double motors_j = 0, passive_j = 0, constraints_j = 0, gross_j = 0;
  bool going = true;
  while (going) {
    std::copy_n(d->qpos, m->nq, q_before.begin());
    std::copy_n(d->qvel, m->nv, v_before.begin());
    going = dut.Step();
    mj_differentiatePos(m, v_by_places.data(), m->opt.timestep, q_before.data(), d->qpos);
    for (int i = 0; i < m->nv; ++i) {
      ASSERT_NEAR(v_by_places[static_cast<std::size_t>(i)], d->qvel[i], 1e-6)
          << "a place was written";
      ASSERT_EQ(d->qfrc_applied[i], 0);
      // Over the step, at the mean of its velocities.
      const double way =
          0.5 * (v_before[static_cast<std::size_t>(i)] + d->qvel[i]) * m->opt.timestep;
      motors_j += d->qfrc_actuator[i] * way;
      gross_j += std::abs(d->qfrc_actuator[i] * way);
      passive_j += d->qfrc_passive[i] * way;
      constraints_j += d->qfrc_constraint[i] * way;
    }
    for (int i = 0; i < 6 * m->nbody; ++i) ASSERT_EQ(d->xfrc_applied[i], 0);
  }
  const Truth& s = dut.rig().truth();
  EXPECT_EQ(s.shape, FindShape(dut.rig().robot(), "I"));
  EXPECT_LT(s.v_WB_W.norm(), 1e-3);
  EXPECT_LT(s.p_WB.head<2>().norm(), 0.01) << "its middle stays where it was";
  EXPECT_LT(std::abs(s.yaw_rad), 0.02);
  EXPECT_GT(motors_j, 0.5) << "folding costs work";
  EXPECT_LT(constraints_j, 0) << "friction takes it";
  EXPECT_LE(passive_j, 0);
  EXPECT_NEAR(motors_j + passive_j + constraints_j, 0, 0.03 * gross_j);
}

class Folded : public ScenarioTest {
 protected:
  EpisodeRecord DrivePlan(const std::string& plan) {
    Save("plan.csv", plan);
    return Drive(Read(RoomScenario(""), {{"robot", "htetro"}}));
  }
};

TEST_F(Folded, APlansShapesAreTakenBetweenItsWaypoints) {
  const EpisodeRecord dut = DrivePlan(
      "x_m,y_m,yaw_rad,shape\n1.5,2.5,0,\n3,2.5,0,O\n4.5,2.5,0,I\n4.5,2.5,0,T\n6,2.5,0,O\n");
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_TRUE(dut.events.empty());
  EXPECT_LT(dut.metrics.max_cross_track_m, 0.02);
  std::vector<int> shapes;
  for (const TraceRow& row : dut.trace) {
    if (row.shape < 0 || (!shapes.empty() && shapes.back() == row.shape)) continue;
    shapes.push_back(row.shape);
    if (row.shape == 1 && shapes.size() == 2) {
      EXPECT_NEAR(row.x_m, 3, 0.02) << "taken before the way that asks for it";
    }
  }
  // On the way from one to another it may pass a third.
  EXPECT_EQ(shapes.front(), 0);
  EXPECT_THAT(shapes, ::testing::Contains(1));
  EXPECT_THAT(shapes, ::testing::Contains(6));
  EXPECT_EQ(shapes.back(), 0);
}

// What the square cannot pass, the bar can; a plan that forgets to fold ends at the partition.
TEST_F(Folded, AGapNarrowerThanTheSquareIsPassedAsABar) {
  const auto file = SourceFile("models/scenarios/htetro_narrow_gap.yaml");
  const EpisodeRecord dut = Drive(ReadScenario(file));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess) << dut.message;
  EXPECT_TRUE(dut.events.empty());
  EXPECT_EQ(dut.metrics.contacts, 0);
  EXPECT_NEAR(dut.trace.back().x_m, 5.6, 0.02);

  const auto plan = Save("square.csv", "x_m,y_m,yaw_rad\n1.25,2.0,0\n5.6,2.0,0\n");
  const EpisodeRecord square = Drive(ReadScenario(file, {{"plan.file", plan.string()}}));
  EXPECT_EQ(square.outcome, Outcome::kFailure);
  EXPECT_LT(square.trace.back().x_m, 3.0);
  ASSERT_FALSE(square.events.empty());
  EXPECT_THAT(square.events[0].hazard, ::testing::StartsWith("partition"));
}

// A block that swings against a pane, lively or dead, presses on it: its hinge is too slow and too
// weak to be thrown back by more than a fraction of a millimetre.
TEST_F(Folded, WhatASwingingBlockPressesOnDoesNotThrowItBack) {
  Save("plan.csv", "x_m,y_m,yaw_rad,shape\n3,2,0,I\n3,2,0,O\n");
  for (const double restitution : {0.0, 0.8}) {
    SCOPED_TRACE(restitution);
    const EpisodeRecord dut = Drive(Read(
        RoomScenario("{type: glass, id: pane, line_m: [[1, 2.45], [5, 2.45]], height_m: 1, "
                     "thickness_m: 0.01, restitution: " +
                     std::to_string(restitution) + "}"),
        {{"robot", "{name: htetro, shape: I}"}, {"site.start", "{x_m: 3, y_m: 2, yaw_deg: 0}"}}));
    EXPECT_GT(dut.metrics.contacts, 0);
    EXPECT_THAT(dut.events, ::testing::Each(::testing::Field(&Event::mode, FailureMode::kStuck)));
  }
}

TEST_F(Folded, WhereThereIsNoRoomToFoldItGetsStuck) {
  const auto file = SourceFile("models/scenarios/htetro_narrow_gap.yaml");
  const auto plan = Save("in_the_gap.csv", "x_m,y_m,yaw_rad,shape\n3.25,2.0,0,I\n3.25,2.0,0,O\n");
  const EpisodeRecord dut = Drive(ReadScenario(file, {{"robot", "{name: htetro, shape: I}"},
                                                      {"start.x_m", "3.25"},
                                                      {"plan.file", plan.string()},
                                                      {"on_failure", "ignore"},
                                                      {"time_limit_s", "30"}}));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_THAT(dut.events,
              ::testing::Contains(::testing::AllOf(
                  ::testing::Field(&Event::mode, FailureMode::kStuck),
                  ::testing::Field(&Event::hazard, ::testing::StartsWith("partition")))));
}

TEST_F(Folded, WhatItCannotBeIsRefused) {
  Save("plan.csv", "x_m,y_m,shape\n1.5,2.5,Q\n");
  EXPECT_THAT(
      [&] {
        Read(RoomScenario(""), {{"robot", "htetro"}});
      },
      ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("O, I, L, J, S, Z, T")));
  EXPECT_THAT(
      [&] {
        Read(RoomScenario(""), {{"robot", "{name: beluga, shape: I}"}});
      },
      ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("does not change its")));
}

}  // namespace
}  // namespace floorproof

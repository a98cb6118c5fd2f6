// SPDX-License-Identifier: Apache-2.0
// Bodies that meet edges, in small MuJoCo models without a robot.
#include "env/scene/edge_contacts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "env/geometry/geometry.h"
#include "env/scene/engine.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {
namespace {

constexpr double kStep_s = 0.004;

// A model whose geom "body" is marked if `marked`.
class Bench {
 public:
  explicit Bench(const std::string& worldbody, bool marked = true) {
    InstallWheelCollider();
    InstallEdgeCollider();
    char error[500] = "";
    const std::string xml = fmt::format(
        R"(<mujoco><option timestep="{}"/><default><geom solref="0.01 3" friction="0.01"/></default>
        {}</mujoco>)",
        kStep_s, worldbody);
    SpecPtr spec(mj_parseXMLString(xml.c_str(), nullptr, error, sizeof(error)));
    EXPECT_NE(spec, nullptr) << error;
    ReserveEdgeMemory(spec.get());
    model_.reset(mj_compile(spec.get(), nullptr));
    EXPECT_NE(model_, nullptr) << mjs_getError(spec.get());
    const std::vector<int> bodies = {mj_name2id(model_.get(), mjOBJ_GEOM, "body")};
    MarkBodyGeoms(model_.get(), bodies);
    if (!marked) UnmarkBodyGeoms(model_.get());
    data_.reset(mj_makeData(model_.get()));
  }
  void Run(double t_s) {
    for (const double end_s = data_->time + t_s; data_->time < end_s;)
      mj_step(model_.get(), data_.get());
  }
  mjtNum& q(int i) { return data_->qpos[i]; }
  mjtNum& v(int i) { return data_->qvel[i]; }
  mjModel* model() { return model_.get(); }
  mjData* data() { return data_.get(); }

 private:
  ModelPtr model_;
  DataPtr data_;
};

// A box 0.2 m long whose nose is 50 mm before the face at x = 0 of a solid with its top at z = 0.
// It moves along x and z; its weight is carried by a spring at a height of its own.
std::string Hovering(double bottom_m, const std::string& solid, double stiffness = 2000) {
  return fmt::format(
      R"(<worldbody>{}<body pos="-0.15 0 {}"><joint name="x" type="slide" axis="1 0 0"/>
      <joint name="z" type="slide" axis="0 0 1" stiffness="{}" damping="20"/>
      <geom name="body" type="box" size="0.1 0.1 0.03" mass="5"/></body></worldbody>)",
      solid, bottom_m + 0.03, stiffness);
}
constexpr const char* kLedge = R"(<geom type="box" size="0.5 0.5 0.5" pos="0.5 0 -0.5"/>)";
constexpr double kFace_m = 0.05;  // along x, from where it starts
constexpr double kPush_n = 20;

void NoGravity(Bench& bench) { bench.model()->opt.gravity[2] = 0; }

TEST(EdgeContacts, HoldABodyAtAnySpeed) {
  for (const double speed_mps : {0.1, 0.5, 1.0, 2.0})
    for (const double below_m : {0.0005, 0.003, 0.01}) {
      Bench dut(Hovering(-below_m, kLedge));
      NoGravity(dut);
      dut.v(0) = speed_mps;
      dut.data()->qfrc_applied[0] = kPush_n;
      dut.Run(kFace_m / speed_mps + 0.3);
      EXPECT_LT(dut.q(0), kFace_m + 0.02) << speed_mps << " m/s, below by " << below_m;
      EXPECT_LT(std::abs(dut.q(1)), 1e-4) << speed_mps << " m/s, below by " << below_m;
    }
}

// The foremost point of a body that nods is its top, high above the edge that its bottom meets.
TEST(EdgeContacts, HoldABodyThatNodsForward) {
  Bench dut(fmt::format(
      R"(<worldbody>{}<body pos="-0.15 0 0.1021" euler="0 3 0"><joint type="slide" axis="0.99863 0 0.05234"/>
      <joint name="z" type="slide" axis="-0.05234 0 0.99863" stiffness="2000" damping="20"/>
      <geom name="body" type="box" size="0.1 0.1 0.1" mass="5"/></body></worldbody>)",
      kLedge));
  NoGravity(dut);
  dut.v(0) = 1;
  dut.data()->qfrc_applied[0] = kPush_n;
  dut.Run(0.4);
  EXPECT_NEAR(dut.q(0), 0.0554, 0.004);
  EXPECT_LT(std::abs(dut.q(1)), 1e-3);
}

// Without the collider the same body gets onto the ledge.
TEST(EdgeContacts, OfStockMuJoCoLiftIt) {
  Bench dut(Hovering(-0.003, kLedge), false);
  NoGravity(dut);
  dut.v(0) = 1;
  dut.data()->qfrc_applied[0] = kPush_n;
  dut.Run(0.4);
  EXPECT_GT(dut.q(0), 0.1);
}

TEST(EdgeContacts, LetABodyPassThatIsAboveTheEdge) {
  Bench dut(Hovering(0.0005, kLedge));
  NoGravity(dut);
  dut.v(0) = 0.5;
  dut.Run(0.5);
  EXPECT_NEAR(dut.q(0), 0.25, 0.005);
}

// It is pressed against the face and held. When it is lifted above the edge, it moves on.
TEST(EdgeContacts, LetGoOfABodyThatIsLiftedOverTheEdge) {
  Bench dut(Hovering(-0.005, kLedge));
  NoGravity(dut);
  dut.data()->qfrc_applied[0] = kPush_n;
  dut.Run(0.6);
  EXPECT_NEAR(dut.q(0), kFace_m, 0.005);
  dut.model()->qpos_spring[1] = 0.0055;
  dut.Run(1);
  EXPECT_GT(dut.q(0), 0.15);
  EXPECT_NEAR(dut.q(1), 0.0055, 2e-4);
}

// The same where only its nose is lifted: its tail hangs lower than the edge throughout.
TEST(EdgeContacts, LetGoOfANoseThatIsLiftedOverTheEdge) {
  Bench dut(fmt::format(
      R"(<worldbody>{}<body pos="-0.15 0 0.025"><joint type="slide" axis="1 0 0"/>
      <joint name="y" type="hinge" axis="0 1 0" stiffness="200" damping="5"/>
      <geom name="body" type="box" size="0.1 0.1 0.03" mass="5"/></body></worldbody>)",
      kLedge));
  NoGravity(dut);
  dut.data()->qfrc_applied[0] = kPush_n;
  dut.Run(0.6);
  EXPECT_NEAR(dut.q(0), kFace_m, 0.005);
  dut.model()->qpos_spring[1] = -0.06;  // the nose rises by 6 mm, the tail sinks by 6 mm
  dut.Run(1);
  EXPECT_GT(dut.q(0), 0.1);
}

// A slanted or rounded nose is pushed up where it meets an edge on its slant.
TEST(EdgeContacts, LiftASlantedNose) {
  Bench dut(fmt::format(
      R"(<asset><mesh name="sledge" vertex="-0.1 -0.1 0  -0.1 0.1 0  0.05 -0.1 0  0.05 0.1 0
      0.1 -0.1 0.03  0.1 0.1 0.03  0.1 -0.1 0.06  0.1 0.1 0.06  -0.1 -0.1 0.06  -0.1 0.1 0.06"/></asset>
      <worldbody>{}<geom type="plane" size="2 2 1" pos="0 0 -0.01"/><body pos="-0.15 0 -0.01"><joint type="slide" axis="1 0 0"/>
      <joint type="slide" axis="0 0 1" damping="20"/>
      <geom name="body" type="mesh" mesh="sledge" mass="5"/></body></worldbody>)",
      kLedge));
  dut.data()->qfrc_applied[0] =
      1.2 * 5 * 9.81 * 0.03 / 0.05;  // 1.2 times the force that its slant needs
  dut.Run(0.6);
  EXPECT_GT(dut.q(0), 0.2);
  EXPECT_NEAR(dut.q(1), 0.01, 0.003);
}

// A body that slides on a floor of slabs sinks into it, and meets no face where the next begins.
// One that lies higher holds it.
TEST(EdgeContacts, AreNotFeltAtTheSeamsOfAFloor) {
  for (const double higher_m : {0.0, 0.003}) {
    Bench dut(fmt::format(
        R"(<worldbody><geom type="box" size="0.5 0.5 0.1" pos="-0.5 0 -0.1"/>
        <geom type="box" size="0.5 0.5 0.1" pos="0.5 0 {}"/>
        <body pos="-0.2 0 0.03"><freejoint/><geom name="body" type="box" size="0.1 0.1 0.03"
        mass="5"/></body></worldbody>)",
        higher_m - 0.1));
    dut.Run(0.3);
    dut.v(0) = 0.5;
    dut.Run(0.6);
    if (higher_m == 0)
      EXPECT_GT(dut.v(0), 0.5 - 0.01 * 9.81 * 0.6 - 0.01);
    else
      EXPECT_LT(dut.q(0), -0.09);
  }
}

// A body that drags over the floor sinks into it, so the foot of a ramp is slightly above its
// bottom.
TEST(EdgeContacts, AreNotFeltAtTheFootOfARamp) {
  constexpr double kMass_kg = 5;
  for (const char* floor :
       {R"(<geom type="plane" size="5 5 1"/>)", R"(<geom type="box" size="5 5 1" pos="0 0 -1"/>)"})
    for (const double speed_mps : {0.2, 0.5}) {
      Bench dut(fmt::format(
          R"(<asset><mesh name="ramp" vertex="0 -1 0  0 1 0  0.3 -1 0  0.3 1 0  0.3 -1 0.03  0.3 1 0.03"/></asset>
          <worldbody>{}<geom type="mesh" mesh="ramp"/><body pos="-0.3 0 0.03"><freejoint/>
          <geom name="body" type="box" size="0.1 0.1 0.03" mass="{}"/></body></worldbody>)",
          floor, kMass_kg));
      dut.Run(0.3);
      dut.v(0) = speed_mps;
      dut.data()->qfrc_applied[0] = 0.3 * kMass_kg * 9.81;
      dut.Run(0.6);
      EXPECT_GT(dut.q(0), 0.2) << speed_mps;
    }
}

// Depending on the direction, the engine tests the next slab before the one that carries the body.
// Stock MuJoCo stops a few of these bodies; the collider must not stop more.
TEST(EdgeContacts, StopNoBodyThatLandsBeforeASeam) {
  const auto speed_after = [](int way, double speed_mps, double drop_m, double before_m,
                              bool marked) {
    const double fall_s = std::sqrt(2 * drop_m / 9.81);
    Bench dut(fmt::format(R"(<worldbody><geom type="box" size="0.5 0.5 0.1" pos="-0.5 0 -0.1"/>
                    <geom type="box" size="0.5 0.5 0.1" pos="0.5 0 -0.1"/><body pos="{} 0 {}">
                    <freejoint/><geom name="body" type="box" size="0.1 0.1 0.03" mass="5"/></body>
                    </worldbody>)",
                          -way * (0.1 + before_m + speed_mps * fall_s), 0.03 + drop_m),
              marked);
    dut.v(0) = way * speed_mps;
    dut.Run(0.15);
    return way * dut.v(0);
  };
  for (const int way : {1, -1})
    for (const double drop_m : {0.001, 0.005})
      for (const double speed_mps : {0.5, 2.0})
        for (double before_m = 0; before_m < 0.016; before_m += 0.001)
          EXPECT_EQ(speed_after(way, speed_mps, drop_m, before_m, true),
                    speed_after(way, speed_mps, drop_m, before_m, false))
              << way * speed_mps << " m/s, " << before_m << " m before it";
}

// It slides down a platform until its nose hangs over by 0.12 m. The platform under its tail
// does not help its nose over an edge below.
TEST(EdgeContacts, HoldANoseThatHangsOffAPlatform) {
  constexpr double kDown_rad = 0.07, kOver_m = 0.12, kSpeed_mps = 2;
  const double c = std::cos(kDown_rad), s = std::sin(kDown_rad), deg = kDown_rad * 180 / kPi;
  const auto on_platform = [&](double along_m, double up_m) {  // from its rim
    return fmt::format(R"(pos="{} 0 {}" euler="0 {} 0")", c * along_m + s * up_m,
                       -s * along_m + c * up_m, deg);
  };
  const auto nose_at_m = [&](double above_nose_m, bool marked) {
    Bench dut(fmt::format(R"(<worldbody><geom type="box" size="0.5 0.5 0.2" {}/>
                          <geom type="box" size="0.5 0.5 0.2" pos="{} 0 {}"/><body {}>
                          <joint type="slide" axis="{} 0 {}"/><joint type="slide" axis="{} 0 {}"/>
                          <geom name="body" type="box" size="0.2 0.1 0.03" mass="5"/></body>
                          </worldbody>)",
                          on_platform(-0.5, -0.2), c * kOver_m + 0.5,
                          -s * kOver_m + above_nose_m - 0.2, on_platform(-0.3, 0.03), c, s, -s, c),
              marked);
    dut.v(0) = kSpeed_mps * c;
    dut.v(1) = -kSpeed_mps * s;
    dut.data()->qfrc_applied[0] = kPush_n;
    dut.Run(0.6);
    return dut.q(0) - 0.1 * c;
  };
  for (const double above_nose_m : {0.002, 0.003}) {
    EXPECT_LT(nose_at_m(above_nose_m, true), c * kOver_m + 0.01) << above_nose_m;
    EXPECT_GT(nose_at_m(above_nose_m, false), c * kOver_m + 0.05) << above_nose_m;
  }
}

// It is dropped onto the rim, and its overlap at the side is smaller than its sink.
TEST(EdgeContacts, CarryWhatComesFromAbove) {
  Bench dut(fmt::format(
      R"(<worldbody>{}<body pos="-0.097 0 0.05"><joint type="slide" axis="0 0 1"/>
      <geom name="body" type="box" size="0.1 0.1 0.03" mass="5"/></body></worldbody>)",
      kLedge));
  dut.Run(1);
  EXPECT_NEAR(dut.q(0), -0.02, 0.001);
}

// The shortest way out of a thin pane is on its other side.
TEST(EdgeContacts, LetNoBodyThroughAThinPane) {
  Bench dut(Hovering(-0.2, R"(<geom type="box" size="0.003 0.5 0.5" pos="0.003 0 0"/>)"));
  NoGravity(dut);
  dut.v(0) = 1;
  dut.Run(0.5);
  EXPECT_LT(dut.q(0), kFace_m + 1e-3);
}

// The memory is a part of the state: a copy continues as the original does.
TEST(EdgeContacts, RememberAsAPartOfTheState) {
  Bench one(Hovering(-0.003, kLedge)), other(Hovering(-0.003, kLedge));
  NoGravity(one);
  NoGravity(other);
  one.v(0) = 1;
  one.Run(0.056);
  ASSERT_GT(one.data()->ncon, 0);
  std::vector<mjtNum> state(
      static_cast<std::size_t>(mj_stateSize(one.model(), mjSTATE_INTEGRATION)));
  mj_getState(one.model(), one.data(), state.data(), mjSTATE_INTEGRATION);
  mj_setState(other.model(), other.data(), state.data(), mjSTATE_INTEGRATION);
  one.Run(0.2);
  other.Run(0.2);
  EXPECT_EQ(one.q(0), other.q(0));
  EXPECT_EQ(one.q(1), other.q(1));
  EXPECT_LT(one.q(0), kFace_m + 0.02);
}

// A body that is put into the middle of a solid is lifted, as in stock MuJoCo.
TEST(EdgeContacts, ForgetWhereABodyIsPutElsewhere) {
  Bench dut(Hovering(-0.003, kLedge));
  NoGravity(dut);
  dut.v(0) = 0.5;
  dut.Run(0.15);
  dut.q(0) = -1;
  dut.v(0) = 0;
  dut.Run(0.1);
  dut.q(0) = 0.3;
  dut.Run(0.3);
  EXPECT_NEAR(dut.q(1), 0.003, 0.0015);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The simulation leaves out what is far away; that changes no bit of the drive.
#include "env/sim/live_geoms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "base/registry.h"
#include "base/streams.h"
#include "controllers/drive.h"
#include "env/sim/simulation.h"
#include "tests/controllers/allocation_guard.h"
#include "tests/robots.h"

namespace floorproof {
namespace {

// 20 m square, turned and shifted, a pillar of 1 to 3 cells in each square metre but near the
// start.
HazardMap Pillars() {
  HazardMap map;
  map.frame = {80, 80, 0.25, {-7.3, -9.1, 0.3}};
  map.occupancy = Grid<CellState>(80, 80);
  map.inset_m = 0.01;
  Stream draw(3, 0, "pillars");
  for (int y = 0; y < 80; y += 4)
    for (int x = 0; x < 80; x += 4)
      if (std::abs(x - 40) > 3 || std::abs(y - 40) > 3)
        for (int k = 0; k < 2; ++k) {
          // One after the other: compilers differ in which argument they evaluate first.
          const int dy = static_cast<int>(draw.Below(2)), dx = static_cast<int>(draw.Below(2));
          map.occupancy(x + dx, y + dy) = CellState::kOccupied;
        }
  return map;
}

Hazard Plate(int number, const Vec2& p_W) {
  Hazard hazard;
  hazard.id = "plate-" + std::to_string(number);
  hazard.type = "step";
  hazard.hazard_class = HazardClass::kLevelChange;
  hazard.height_m = 0.002;
  const Polygon square = Rectangle(p_W - Vec2(0.05, 0.05), p_W + Vec2(0.05, 0.05));
  hazard.footprint = {square};
  hazard.solids = {{Solid::Kind::kPrism, square, {}, 0, 0.002}};
  return hazard;
}

HazardMap Plates() {
  HazardMap map;
  map.frame = {40, 40, 0.25, {-5, -5, 0}};
  map.occupancy = Grid<CellState>(40, 40);
  for (int i = 0; i < 200; ++i)
    map.hazards.push_back(Plate(i, {-4.5 + 0.6 * (i % 16), -4.5 + 0.6 * (i / 16)}));
  return map;
}

// The simulation, and beside it the whole scene stepped by the engine alone from the same state.
struct Twins {
  Twins(const std::string& robot_name, HazardMap floor, const Pose2& start)
      : Twins(ReadRobot(FindRobotFile(robot_name, {})), std::move(floor), start) {}
  // The engine alone does not hold wheels that stand.
  static RobotModel NotHeld(RobotModel robot) {
    robot.spec.standstill = Standstill::kFree;
    return robot;
  }
  Twins(RobotModel with, HazardMap floor, const Pose2& start)
      : map(std::move(floor)),
        robot(NotHeld(std::move(with))),
        scene(BuildScene(map, robot, {}, start)),
        whole(BuildScene(map, robot, {}, start, WallSet::kAll)),
        sim(scene, map, robot.spec),
        data(MakeData(whole.model.get())),
        wheels(robot.spec.wheels.size()),
        drive(MakePlugin(Drives(), robot.spec.drive, "drive")) {
    drive->Configure(robot.spec);
    sim.Reset(start);
    CopyState();
  }
  void CopyState() {
    const mjModel* m = whole.model.get();
    std::vector<mjtNum> state(static_cast<std::size_t>(mj_stateSize(m, mjSTATE_INTEGRATION)));
    mj_getState(sim.model(), sim.data(), state.data(), mjSTATE_INTEGRATION);
    mj_setState(m, data.get(), state.data(), mjSTATE_INTEGRATION);
  }
  void Command(const BodyTwist& twist) {
    drive->ToWheels(twist, wheels);
    sim.SetWheelSpeeds(wheels);
    std::copy(wheels.begin(), wheels.end(), data->ctrl);
  }
  // One step of both; whether their states are the same bits.
  bool Step() {
    EXPECT_TRUE(sim.Step());
    WalkStep(whole.model.get(), data.get(), sim.parts(), [] {});
    const auto same = [](const mjtNum* a, const mjtNum* b, mjtSize n) {
      return std::memcmp(a, b, static_cast<std::size_t>(n) * sizeof(mjtNum)) == 0;
    };
    touched_walls += std::any_of(data->contact, data->contact + data->ncon, [&](const auto& c) {
      return whole.roles[static_cast<std::size_t>(c.geom[0])].kind == GeomRole::Kind::kWall ||
             whole.roles[static_cast<std::size_t>(c.geom[1])].kind == GeomRole::Kind::kWall;
    });
    return data->ncon == sim.data()->ncon && same(data->qpos, sim.data()->qpos, whole.model->nq) &&
           same(data->qvel, sim.data()->qvel, whole.model->nv);
  }

  HazardMap map;
  RobotModel robot;
  Scene scene, whole;
  Simulation sim;
  DataPtr data;
  std::vector<double> wheels;
  std::unique_ptr<Drive> drive;
  int touched_walls = 0;
};

const Pose2 kMiddle{-0.7, 3.4, 1.0};  // of Pillars()

class LiveGeomsOf : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Robots, LiveGeomsOf, ::testing::ValuesIn(RobotNames()),
                         [](const auto& robot) { return robot.param; });

TEST_P(LiveGeomsOf, BumpIntoTheSameWallsAsTheWholeScene) {
  Twins dut(GetParam(), Pillars(), kMiddle);
  ASSERT_GT(dut.whole.num_wall_geoms, 300);
  ASSERT_LT(dut.scene.num_wall_geoms, dut.whole.num_wall_geoms / 5);
  Stream draw(5, 0, "twists");
  double way_m = 0;
  Vec2 last = kMiddle.p();
  for (int i = 0; i < 4000; ++i) {
    if (i % 400 == 0)
      dut.Command({draw.Uniform(-0.4, 0.4), draw.Uniform(-0.3, 0.3), draw.Uniform(-0.6, 0.6)});
    ASSERT_TRUE(dut.Step()) << "step " << i;
    way_m += (dut.sim.truth().p_WB.head<2>() - last).norm();
    last = dut.sim.truth().p_WB.head<2>();
  }
  EXPECT_GT(way_m, 1) << "it chose anew on the way";
  EXPECT_GT(dut.touched_walls, 100);
}

TEST_P(LiveGeomsOf, CrossTheSamePlatesAsTheWholeScene) {
  Twins dut(GetParam(), Plates(), {});
  int crossed = 0;
  Stream draw(6, 0, "twists");
  for (int i = 0; i < 3000; ++i) {
    if (i % 400 == 0)
      dut.Command({draw.Uniform(0.1, 0.4), draw.Uniform(-0.2, 0.2), draw.Uniform(-0.6, 0.6)});
    ASSERT_TRUE(dut.Step()) << "step " << i;
    crossed += dut.sim.truth().near_hazard >= 0;
  }
  EXPECT_LE(dut.sim.model()->npair, dut.scene.model->npair / 10);
  EXPECT_GT(crossed, 100) << "and they were felt";
}

// A boom of 1.2 m swings about a robot that stands: its joint alone brings it to other walls.
TEST(LiveGeoms, AnArmMeetsTheWallsThatItSwingsTo) {
  RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  mjsBody* boom = mjs_addBody(mjs_findBody(robot.mjcf.get(), "base"), nullptr);
  mjs_setName(boom->element, "boom");
  mjsJoint* hinge = mjs_addJoint(boom, nullptr);
  mjs_setName(hinge->element, "boom");
  hinge->type = mjJNT_HINGE;
  mjsGeom* tip = mjs_addGeom(boom, nullptr);
  tip->type = mjGEOM_SPHERE;
  tip->size[0] = 0.05;
  tip->pos[0] = 1.2;
  tip->pos[2] = 0.2;
  tip->mass = 0.05;
  tip->conaffinity = 2;
  Twins dut(std::move(robot), Pillars(), kMiddle);
  const mjModel* m = dut.whole.model.get();
  const int joint = m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, "boom")];
  for (int i = 0; i < 1500; ++i) {
    if (i % 300 == 0) {
      dut.sim.data()->qvel[joint] = i % 600 == 0 ? 3 : -3;
      dut.CopyState();
    }
    ASSERT_TRUE(dut.Step()) << "step " << i;
  }
  EXPECT_GT(dut.touched_walls, 5);
}

// A caster's fork swings its wheel about the pivot, and slides on a spring, from plate to plate.
TEST(LiveGeoms, ASwivelCasterMeetsThePlatesThatItSwingsTo) {
  RobotModel robot = ReadRobot(FindRobotFile("rover", {}));
  mjsBody* fork = mjs_addBody(mjs_findBody(robot.mjcf.get(), "base"), nullptr);
  fork->pos[0] = -0.5;
  fork->pos[2] = 0.03;
  mjsJoint* spring = mjs_addJoint(fork, nullptr);
  spring->type = mjJNT_SLIDE;
  spring->stiffness[0] = 1000;
  spring->springref = -0.01;
  spring->damping[0] = 10;
  mjs_addJoint(fork, nullptr)->type = mjJNT_HINGE;
  mjsGeom* look = mjs_addGeom(fork, nullptr);
  look->type = mjGEOM_SPHERE;
  look->size[0] = 0.01;
  look->mass = 0.2;
  look->contype = look->conaffinity = 0;
  mjsBody* caster = mjs_addBody(fork, nullptr);
  caster->pos[0] = -0.3;
  mjsJoint* axle = mjs_addJoint(caster, nullptr);
  axle->type = mjJNT_HINGE;
  axle->axis[1] = 1;
  axle->axis[2] = 0;
  mjsGeom* wheel = mjs_addGeom(caster, nullptr);
  wheel->type = mjGEOM_SPHERE;
  wheel->size[0] = 0.03;
  wheel->mass = 0.3;
  wheel->contype = 0;
  wheel->conaffinity = 1;
  Twins dut(std::move(robot), Plates(), {});
  Stream draw(8, 0, "twists");
  double least = 1, most = -1;
  for (int i = 0; i < 3000; ++i) {
    if (i % 400 == 0) dut.Command({draw.Uniform(-0.4, 0.4), 0, draw.Uniform(-0.6, 0.6)});
    ASSERT_TRUE(dut.Step()) << "step " << i;
    const mjModel* m = dut.whole.model.get();
    const double swivelled = std::cos(dut.data->qpos[m->nq - 2]);
    least = std::min(least, swivelled);
    most = std::max(most, swivelled);
  }
  EXPECT_LT(least, 0);
  EXPECT_GT(most, 0.9);
}

// Whoever writes the state, and however far the robot goes in a step: what is near is live.
TEST_P(LiveGeomsOf, ARobotThatIsPutElsewhereMeetsWhatIsThere) {
  Twins dut(GetParam(), Pillars(), kMiddle);
  Stream draw(7, 0, "places");
  mjtNum* q = dut.sim.data()->qpos;
  for (int i = 0; i < 300; ++i) {
    const double far_m = i % 3 == 0 ? 5 : 0.12;
    q[0] = std::clamp(q[0] + draw.Uniform(-far_m, far_m), -5.0, 5.0);
    q[1] = std::clamp(q[1] + draw.Uniform(-far_m, far_m), -3.0, 9.0);
    const double yaw = draw.Uniform(-kPi, kPi);
    q[2] = 0;
    q[3] = std::cos(yaw / 2);
    q[4] = q[5] = 0;
    q[6] = std::sin(yaw / 2);
    std::fill_n(dut.sim.data()->qvel, dut.whole.model->nv, 0.0);
    dut.CopyState();
    ASSERT_TRUE(dut.Step()) << "place " << i;
  }
  EXPECT_GT(dut.touched_walls, 30);
}

TEST_P(LiveGeomsOf, LeaveTheSharedSceneAsItWas) {
  Twins dut(GetParam(), Pillars(), kMiddle);
  const mjModel* m = dut.scene.model.get();
  const auto* bytes = static_cast<const char*>(m->buffer);
  const std::vector<char> before(bytes, bytes + m->nbuffer);
  Simulation other(dut.scene, dut.map, dut.robot.spec);
  other.Reset({-4.5, 3, 0});
  dut.Command({0.3, 0, 0.2});
  for (int i = 0; i < 500; ++i) ASSERT_TRUE(dut.sim.Step() && other.Step());
  EXPECT_EQ(std::memcmp(before.data(), m->buffer, before.size()), 0);
  const auto places = [&](const Simulation& sim) {
    const mjtNum* pos = sim.model()->geom_pos + 3 * dut.scene.pool.first_geom;
    return std::vector<mjtNum>(pos, pos + 3 * dut.scene.pool.num);
  };
  EXPECT_NE(places(dut.sim), places(other)) << "each has walls of its own";
}

TEST_P(LiveGeomsOf, AllocateNothing) {
  for (HazardMap map : {Pillars(), Plates()}) {
    Twins dut(GetParam(), std::move(map), kMiddle);
    dut.Command({0.3, 0, 0.2});
    const std::int64_t before = AllocationCount();
    for (int i = 0; i < 1000; ++i) dut.sim.Step();
    EXPECT_EQ(AllocationCount(), before);
  }
}

TEST(LiveGeoms, APoolThatIsTooSmallIsAnErrorNotAMiss) {
  Twins dut("beluga", Pillars(), kMiddle);
  dut.scene.pool.num = 1;
  Simulation small(dut.scene, dut.map, dut.robot.spec);
  EXPECT_THROW(small.Reset({-4.5, 3, 0}), InternalError);
}

TEST(LiveGeoms, AreTheWholeSceneWhereItIsSmall) {
  HazardMap map;
  map.frame = {20, 20, 0.5, {}};
  map.occupancy = Grid<CellState>(20, 20);
  const Twins dut("htetro", map, {5, 5, 0});
  EXPECT_EQ(dut.scene.pool.num, 0);
  EXPECT_EQ(dut.sim.model()->npair, dut.scene.model->npair);
  const auto places = [](const mjModel* m) {
    return std::vector<mjtNum>(m->geom_pos, m->geom_pos + 3 * m->ngeom);
  };
  EXPECT_EQ(places(dut.sim.model()), places(dut.scene.model.get()));
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A robot that is taken up in the middle of an episode and set down elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/registry.h"
#include "controllers/drive.h"
#include "env/sim/simulation.h"
#include "tests/robots.h"

namespace floorproof {
namespace {

// 28 m square, a pillar of 0.5 m every 2 m: more than a scene holds at a time.
HazardMap Pillars() {
  HazardMap map;
  map.frame = {112, 112, 0.25, {}};
  map.occupancy = Grid<CellState>(112, 112);
  for (int y = 0; y < 112; ++y)
    for (int x = 0; x < 112; ++x)
      if (x % 8 < 2 && y % 8 < 2) map.occupancy(x, y) = CellState::kOccupied;
  return map;
}

const Pose2 kHere{3.25, 3.25, 0.4}, kThere{15.25, 12.25, 0};

class SetDown : public ::testing::TestWithParam<std::string> {
 protected:
  struct Rig {
    explicit Rig(const std::string& name)
        : robot(ReadRobot(FindRobotFile(name, {}))),
          map(Pillars()),
          drive(MakePlugin(Drives(), robot.spec.drive, "drive")),
          wheels(robot.spec.wheels.size()) {
      robot.spec.battery.capacity_wh = 10;
      robot.spec.battery.resistance_ohm = 0.1;
      scene = BuildScene(map, robot, {}, kHere);
      sim.emplace(scene, map, robot.spec);
      drive->Configure(robot.spec);
      sim->Reset(kHere);
    }
    void Drive(const BodyTwist& twist, double seconds) {
      drive->ToWheels(twist, wheels);
      sim->SetWheelSpeeds(wheels);
      for (int i = 0; i < 250 * seconds; ++i) ASSERT_TRUE(sim->Step());
    }
    // How far each driven wheel has turned.
    std::vector<double> Turned() {
      const mjModel* m = scene.model.get();
      std::vector<double> turned_rad;
      for (const WheelSpec& wheel : robot.spec.wheels) {
        const int joint = mj_name2id(m, mjOBJ_JOINT, wheel.name.c_str());
        turned_rad.push_back(sim->data()->qpos[m->jnt_qposadr[joint]]);
      }
      return turned_rad;
    }
    // It drives, and then lies on its back with its wheels turning.
    void Fall() {
      Drive({0.25, 0, 0.3}, 2);
      mjtNum* q = sim->data()->qpos;
      q[2] += 0.5;
      q[3] = q[5] = q[6] = 0;
      q[4] = 1;
      Drive({0.25, 0, 0}, 1);
      ASSERT_GT(sim->truth().tilt_rad, 1);
    }

    RobotModel robot;
    HazardMap map;
    Scene scene;
    std::optional<Simulation> sim;
    std::unique_ptr<floorproof::Drive> drive;
    std::vector<double> wheels;
  };
};
INSTANTIATE_TEST_SUITE_P(Robots, SetDown, ::testing::ValuesIn(RobotNames()),
                         [](const auto& robot) { return robot.param; });

TEST_P(SetDown, StandsAsAtAStart) {
  Rig dut(GetParam()), fresh(GetParam());
  dut.Fall();
  dut.sim->SetDown(kThere);
  fresh.sim->Reset(kThere);
  const Truth &is = dut.sim->truth(), &should = fresh.sim->truth();
  EXPECT_LT((is.p_WB - should.p_WB).norm(), 1e-5);
  EXPECT_NEAR(is.yaw_rad, kThere.yaw_rad, 1e-9);
  EXPECT_NEAR(is.tilt_rad, should.tilt_rad, 1e-5);
  EXPECT_EQ(is.v_WB_W.norm(), 0);
  EXPECT_EQ(is.wheel_contacts, should.wheel_contacts);
  EXPECT_NEAR(is.support_margin_m, should.support_margin_m, 1e-3);
  EXPECT_EQ(is.num_contacts, 0);
  for (int i = 0; i < dut.sim->model()->nu; ++i) EXPECT_EQ(dut.sim->data()->ctrl[i], 0);
  // And it stays there.
  dut.Drive({}, 1);
  EXPECT_LT((dut.sim->truth().p_WB - should.p_WB).norm(), 1e-3);
}

TEST_P(SetDown, TimeBatteryAndWheelsGoOn) {
  Rig dut(GetParam());
  dut.Fall();
  const double t_s = dut.sim->truth().t_s, left = *dut.sim->battery().left();
  const std::vector<double> turned_rad = dut.Turned();
  ASSERT_LT(left, 1);
  ASSERT_GT(std::abs(turned_rad[0]), 1);
  dut.sim->SetDown(kThere);
  EXPECT_EQ(dut.sim->truth().t_s, t_s);
  EXPECT_EQ(*dut.sim->battery().left(), left);
  for (std::size_t i = 0; i < turned_rad.size(); ++i)
    EXPECT_NEAR(dut.Turned()[i], turned_rad[i], 1e-3) << "wheel " << i;
  dut.Drive({}, 1);
  EXPECT_NEAR(dut.sim->truth().t_s, t_s + 1, 1e-9);
  EXPECT_LT(*dut.sim->battery().left(), left);
}

// Where it is set down, and not only where it was, walls are felt.
TEST_P(SetDown, MeetsTheWallsThatAreThere) {
  Rig dut(GetParam());
  ASSERT_GT(dut.scene.pool.num, 0);
  dut.Drive({0.25, 0, 0}, 1);
  dut.sim->SetDown(kThere);  // 0.75 m before a pillar's face
  dut.Drive({0.25, 0, 0}, 5);
  int touched = 0;  // it rocks against the face
  for (int i = 0; i < 10; ++i) {
    dut.Drive({0.25, 0, 0}, 0.1);
    touched += dut.sim->truth().num_contacts > 0;
  }
  EXPECT_GT(touched, 0);
  EXPECT_LT(dut.sim->truth().p_WB.x(), 16);
  EXPECT_GT(dut.sim->truth().p_WB.x(), kThere.x_m + 0.2);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/scene/roller_wheels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "env/scene/scene.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {
namespace {

HazardMap Room() {
  HazardMap map;
  map.frame = {12, 12, 0.5, {}};
  map.occupancy = Grid<CellState>(12, 12);
  return map;
}

// One robot on both kinds of wheels.
struct Pair {
  RobotModel ideal, rollers;
  Scene with_ideal, with_rollers;
  explicit Pair(const std::filesystem::path& file, const RobotChanges& changes = {})
      : ideal(ReadRobot(file, changes)),
        rollers(WithRollerWheels(ideal)),
        with_ideal(BuildScene(Room(), ideal, {}, {3, 3, 0})),
        with_rollers(BuildScene(Room(), rollers, {}, {3, 3, 0})) {}
};

int CountRollers(const Scene& scene) {
  int count = 0;
  for (int g = 0; g < scene.model->ngeom; ++g)
    count += scene.roles[static_cast<std::size_t>(g)].kind == GeomRole::Kind::kWheel &&
             scene.model->geom_type[g] == mjGEOM_ELLIPSOID;
  return count;
}

TEST(RollerWheelsModel, WeighAndStandAsIdealOnes) {
  const std::filesystem::path htetro = FindRobotFile("htetro", {});
  for (const RobotChanges& changes :
       {RobotChanges{}, RobotChanges{.mass_kg = 15.0},
        RobotChanges{.wheel_radius_m = 0.035, .roller_radius_m = 0.009}}) {
    const Pair dut(htetro, changes);
    const int base = dut.with_ideal.base_body;
    const mjModel *ideal = dut.with_ideal.model.get(), *rollers = dut.with_rollers.model.get();
    EXPECT_NEAR(rollers->body_subtreemass[base], ideal->body_subtreemass[base], 1e-9);
    EXPECT_EQ(CountRollers(dut.with_ideal), 0);
    EXPECT_EQ(CountRollers(dut.with_rollers), 16 * kRollers);
    const DataPtr a = MakeData(ideal), b = MakeData(rollers);
    ForwardEngine(ideal, a.get());
    ForwardEngine(rollers, b.get());
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(a->subtree_com[3 * base + i], b->subtree_com[3 * base + i], 1e-9);
    for (const WheelSpec& wheel : dut.rollers.spec.wheels) {
      const int body = mj_name2id(rollers, mjOBJ_BODY, wheel.name.c_str());
      ASSERT_GE(body, 0);
      const int ideal_body = mj_name2id(ideal, mjOBJ_BODY, wheel.name.c_str());
      EXPECT_NEAR(rollers->body_subtreemass[body], ideal->body_subtreemass[ideal_body], 1e-9);
    }
  }
}

// The lowest point of the tread under the axle, by the rollers' support functions: R wherever the
// wheel is turned to, to a small ripple.
TEST(RollerWheelsModel, TheTreadIsRound) {
  for (const double roller_m : {0.005, 0.007, 0.010})
    for (const double angle_rad : {kPi / 4, -kPi / 4, 0.6}) {
      WheelSpec wheel;
      wheel.radius_m = 0.030;
      wheel.roller_radius_m = roller_m;
      wheel.roller_angle_rad = angle_rad;
      const double a = RollerHalfLength(wheel);
      const auto height = [&](double turn) {
        const double slant = std::sin(angle_rad) * std::sin(turn);
        return (wheel.radius_m - roller_m) * std::cos(turn) +
               std::sqrt(roller_m * roller_m * (1 - slant * slant) + a * a * slant * slant);
      };
      const double x = kPi / kRollers;
      EXPECT_NEAR(height(0), wheel.radius_m, 1e-12);
      EXPECT_NEAR(height(x), wheel.radius_m, 1e-12) << "at the handover";
      for (const double turn : {0.25 * x, 0.5 * x, 0.75 * x})
        EXPECT_NEAR(height(turn), wheel.radius_m, 0.005 * wheel.radius_m);
    }
}

// Every roller's axis is the one that the ideal wheel's collider gives its contacts: at the floor,
// the axle turned by the angle.
TEST(RollerWheelsModel, TheLowestRollerStandsAtTheAngle) {
  const Pair dut(FindRobotFile("htetro", {}));
  const mjModel* m = dut.with_rollers.model.get();
  const DataPtr data = MakeData(m);
  ForwardEngine(m, data.get());
  for (const WheelSpec& wheel : dut.rollers.spec.wheels) {
    const int hub = mj_name2id(m, mjOBJ_BODY, wheel.name.c_str());
    int lowest = -1;
    for (int b = 1; b < m->nbody; ++b)
      if (m->body_parentid[b] == hub &&
          (lowest < 0 || data->xpos[3 * b + 2] < data->xpos[3 * lowest + 2]))
        lowest = b;
    ASSERT_GE(lowest, 0);
    EXPECT_NEAR(data->xpos[3 * lowest + 2], wheel.roller_radius_m, 1e-9);
    const mjtNum* mat = data->xmat + 9 * lowest;
    const Vec2 axis(mat[2], mat[5]);
    const Vec2 expected(-std::sin(wheel.roller_angle_rad), std::cos(wheel.roller_angle_rad));
    EXPECT_NEAR(std::abs(axis.dot(expected)), 1, 1e-9) << wheel.name;
  }
}

TEST(RollerWheelsModel, ARobotOnPlainWheelsStaysAsItIs) {
  const Pair dut(FindRobotFile("beluga", {}));
  EXPECT_FALSE(HasMecanumWheels(dut.ideal.spec));
  EXPECT_EQ(SceneXml(dut.with_ideal), SceneXml(dut.with_rollers));
}

// The stock MuJoCo: no collider, no user data, friction alike in all directions; it stands and
// drives sideways. A user's own robot, from a file beside, does so alike.
TEST(RollerWheelsModel, TheExportStandsAndDrivesSidewaysInTheStockEngine) {
  const std::filesystem::path copy = ::testing::TempDir() + "/my_robot.xml";
  std::filesystem::copy_file(FindRobotFile("htetro", {}), copy,
                             std::filesystem::copy_options::overwrite_existing);
  const Pair dut(copy);
  const std::string xml = SceneXml(dut.with_rollers);
  char error[1000] = "";
  const SpecPtr spec(mj_parseXMLString(xml.c_str(), nullptr, error, sizeof error));
  ASSERT_TRUE(spec) << error;
  const ModelPtr model = CompileSpec(spec.get());
  for (int p = 0; p < model->npair; ++p)
    EXPECT_EQ(model->pair_friction[5 * p + 1], model->pair_friction[5 * p]);
  for (int g = 0; g < model->ngeom; ++g) EXPECT_EQ(RollersOf(model.get(), g).radius_m, 0);
  const DataPtr data = MakeData(model.get());
  for (int i = 0; i < 125; ++i) StepEngine(model.get(), data.get());
  EXPECT_NEAR(data->qpos[2], 0, 1e-4);
  constexpr double kSpeed_mps = 0.1, kTime_s = 1.2;
  const double from_x = data->qpos[0], from_y = data->qpos[1], from_s = data->time;
  for (int a = 0; a < model->nu; ++a) {
    const WheelSpec& wheel = dut.rollers.spec.wheels[static_cast<std::size_t>(a)];
    // To the left, a wheel turns against the tangent of its rollers' angle.
    data->ctrl[a] = kSpeed_mps / wheel.radius_m * (wheel.roller_angle_rad > 0 ? -1 : 1);
  }
  while (data->time < from_s + kTime_s) StepEngine(model.get(), data.get());
  for (int i = 0; i < mjNWARNING; ++i) EXPECT_EQ(data->warning[i].number, 0);
  EXPECT_NEAR(data->qpos[0], from_x, 0.002);
  EXPECT_NEAR(data->qpos[1] - from_y, kSpeed_mps * kTime_s, 0.01) << "a start-up of 50 ms aside";
}

}  // namespace
}  // namespace floorproof

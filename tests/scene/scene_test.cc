// SPDX-License-Identifier: Apache-2.0
#include "env/scene/scene.h"

#include <gtest/gtest.h>

#include "env/scene/floor.h"

namespace floorproof {
namespace {

HazardMap EmptyRoom(int width, int height) {
  HazardMap map;
  map.frame = {width, height, 0.5, {}};
  map.occupancy = Grid<CellState>(width, height);
  return map;
}

Hazard Cut(const Polygon& outline, double depth_m) {
  Hazard hazard;
  hazard.id = "pit";
  hazard.hazard_class = HazardClass::kLevelChange;
  hazard.height_m = -depth_m;
  hazard.footprint = {outline};
  hazard.solids = {{Solid::Kind::kCut, outline, {}, -depth_m, 0}};
  return hazard;
}

// Height of the first surface below a point 1 m up, by a ray.
double SurfaceBelow(const Scene& scene, mjData* data, const Vec2& p) {
  const mjtNum from[3] = {p.x(), p.y(), 1}, down[3] = {0, 0, -1};
  const mjtByte groups[mjNGROUP] = {0, 0, 0, 0, 1, 1};
  int geom = -1;
  const double distance =
      mj_ray(scene.model.get(), data, from, down, groups, 1, scene.base_body, &geom, nullptr);
  return geom < 0 ? -1e9 : 1 - distance;
}

TEST(SceneTest, AFlatFloorIsOnePlane) {
  EXPECT_TRUE(FloorPieces(EmptyRoom(10, 10)).empty());
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Scene dut = BuildScene(EmptyRoom(10, 10), robot, {}, {2.5, 2.5, 0});
  EXPECT_EQ(dut.num_floor_geoms, 1);
}

// Rays from above meet the base floor beside the pits and the stated depth within.
TEST(SceneTest, HazardsKeepTheirStatedHeights) {
  HazardMap map = EmptyRoom(20, 16);
  map.hazards.push_back(Cut({{3, 3}, {5, 3.5}, {4.5, 6}, {2.5, 5}}, 0.15));
  map.hazards.push_back(Cut(Rectangle({6, 1}, {7, 7}), 0.03));
  Hazard step;
  step.id = "step";
  step.solids = {{Solid::Kind::kPrism, {{8, 1}, {9, 1}, {9, 2}, {8, 2}}, {}, 0, 0.04}};
  map.hazards.push_back(step);
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Scene dut = BuildScene(map, robot, {}, {1, 1, 0});
  const DataPtr data = MakeData(dut.model.get());
  ForwardEngine(dut.model.get(), data.get());
  constexpr double kExact_m = 1e-6;
  EXPECT_NEAR(SurfaceBelow(dut, data.get(), {3.6, 4.5}), -0.15, kExact_m);
  EXPECT_NEAR(SurfaceBelow(dut, data.get(), {6.5, 6.9}), -0.03, kExact_m);
  EXPECT_NEAR(SurfaceBelow(dut, data.get(), {8.5, 1.5}), 0.04, kExact_m);
  for (const Vec2& p : {Vec2(1.5, 5), Vec2(5.5, 2), Vec2(6.5, 7.2), Vec2(2.4, 3.2)})
    EXPECT_NEAR(SurfaceBelow(dut, data.get(), p), 0, kExact_m) << p.transpose();
}

// A wedge: corners of the top coincide.
TEST(SceneTest, ATopMayBeALine) {
  HazardMap map = EmptyRoom(20, 16);
  Hazard wedge;
  wedge.id = "wedge";
  wedge.solids = {{Solid::Kind::kPrism, Rectangle({6, 1}, {7, 3}), {}, 0, 0.04}};
  wedge.solids[0].top = {{7, 1}, {7, 1}, {7, 3}, {7, 3}};
  map.hazards = {wedge};
  const Scene dut = BuildScene(map, ReadRobot(FindRobotFile("beluga", {})), {}, {1, 1, 0});
  const DataPtr data = MakeData(dut.model.get());
  ForwardEngine(dut.model.get(), data.get());
  EXPECT_NEAR(SurfaceBelow(dut, data.get(), {6.25, 2}), 0.01, 1e-6);
  EXPECT_NEAR(SurfaceBelow(dut, data.get(), {6.75, 1.1}), 0.03, 1e-6);
}

TEST(SceneTest, TheExportLoadsAndStepsInTheStockEngine) {
  HazardMap map = EmptyRoom(12, 10);
  map.hazards.push_back(Cut({{3, 3}, {4, 3.2}, {3.5, 4}}, 0.15));
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Scene scene = BuildScene(map, robot, {}, {1, 1, 0});
  const std::string xml = SceneXml(scene);
  char error[1000] = "";
  const SpecPtr spec(mj_parseXMLString(xml.c_str(), nullptr, error, sizeof error));
  ASSERT_TRUE(spec) << error;
  const ModelPtr model = CompileSpec(spec.get());
  EXPECT_EQ(model->ngeom, scene.model->ngeom);
  const DataPtr data = MakeData(model.get());
  for (int i = 0; i < 500; ++i) StepEngine(model.get(), data.get());
  for (int i = 0; i < mjNWARNING; ++i) EXPECT_EQ(data->warning[i].number, 0);
  EXPECT_NEAR(data->qpos[2], 0, 1e-3) << "the robot stands on the floor";
}

// An arena too small for the contacts: the engine's own error, which would end the process.
TEST(SceneTest, AnEngineErrorIsAnExceptionAndNotTheEnd) {
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Scene scene = BuildScene(EmptyRoom(10, 10), robot, {}, {2.5, 2.5, 0});
  scene.model->narena = 2048;
  const DataPtr data = MakeData(scene.model.get());
  EXPECT_THROW(ForwardEngine(scene.model.get(), data.get()), InternalError);
}

// The geom that a ray from above meets, and how steep it is there.
int GeomBelow(const Scene& scene, mjData* data, const Vec2& p) {
  const mjtNum from[3] = {p.x(), p.y(), 3}, down[3] = {0, 0, -1};
  const mjtByte groups[mjNGROUP] = {0, 0, 0, 0, 1, 1};
  int geom = -1;
  mj_ray(scene.model.get(), data, from, down, groups, 1, scene.base_body, &geom, nullptr);
  return geom;
}

TEST(SceneTest, ARampIsAsHighAsItsSlopeSays) {
  const double rise = std::tan(8 * kPi / 180);
  HazardMap map = EmptyRoom(20, 16);
  Hazard ramp;
  ramp.id = "ramp";
  ramp.hazard_class = HazardClass::kTerrain;
  const Polygon place = {{3, 2}, {6, 2}, {5, 6}, {3, 4}};
  ramp.solids = {{Solid::Kind::kPrism, place, {}, 0, 3 * rise, {rise, 0}}};
  ramp.footprint = {place};
  map.hazards = {ramp};
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Scene dut = BuildScene(map, robot, {}, {1, 1, 0});
  const DataPtr data = MakeData(dut.model.get());
  ForwardEngine(dut.model.get(), data.get());
  for (const Vec2& p : {Vec2(3.1, 2.1), Vec2(4, 4), Vec2(5.5, 2.5), Vec2(4.9, 5.5)})
    EXPECT_NEAR(SurfaceBelow(dut, data.get(), p), rise * (p.x() - 3), 1e-6);
  EXPECT_NEAR(SurfaceBelow(dut, data.get(), {5.8, 5}), 0, 1e-6);
}

// What stands in a puddle is not cut in two by it, and stays as it is.
TEST(SceneTest, FurnitureInAWetPatchStaysDry) {
  HazardMap map = EmptyRoom(20, 16);
  Hazard box, wet;
  box.id = "box";
  box.hazard_class = HazardClass::kBlindObject;
  box.footprint = {Rectangle({4, 2}, {5, 3})};
  box.solids = {{Solid::Kind::kPrism, box.footprint[0], {}, 0, 0.5}};
  wet.id = "wet";
  wet.hazard_class = HazardClass::kTerrain;
  wet.material.friction = 0.3;
  wet.footprint = {Rectangle({4.5, 1}, {8, 5})};
  wet.solids = {{Solid::Kind::kSurface, wet.footprint[0], {}, 0, 0}};
  map.hazards = {box, wet};
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Scene dut = BuildScene(map, robot, {}, {1, 1, 0});
  EXPECT_EQ(dut.num_hazard_geoms, 1);
}

// What is wet is the floor there, whatever level or slope that is; what came later is dry.
TEST(SceneTest, AWetPatchGivesItsFrictionToTheFloorsBelowIt) {
  HazardMap map = EmptyRoom(20, 16);
  map.floor_friction = 0.8;
  Hazard step;
  step.id = "step";
  step.hazard_class = HazardClass::kLevelChange;
  step.height_m = 0.04;
  step.footprint = {Rectangle({4, 1}, {6, 7})};
  step.solids = {{Solid::Kind::kPrism, step.footprint[0], {}, 0, 0.04}};
  Hazard later = step;
  later.id = "later";
  later.footprint = {Rectangle({7, 1}, {8, 7})};
  later.solids[0].base = later.footprint[0];
  Hazard wet;
  wet.id = "wet";
  wet.hazard_class = HazardClass::kTerrain;
  wet.material.friction = 0.3;
  const Polygon patch = {{2, 2}, {9, 3}, {9, 5}, {2, 6}};
  wet.footprint = {patch};
  wet.solids = {{Solid::Kind::kSurface, patch, {}, 0, 0}};
  map.hazards = {step, wet, later};
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const Scene dut = BuildScene(map, robot, {}, {1, 1, 0});
  const DataPtr data = MakeData(dut.model.get());
  ForwardEngine(dut.model.get(), data.get());
  const auto friction_at = [&](const Vec2& p) {
    return dut.model->geom_friction[3 * GeomBelow(dut, data.get(), p)];
  };
  for (const Vec2& dry : {Vec2(1, 1), Vec2(3, 1.5), Vec2(5, 1.5), Vec2(7.5, 4), Vec2(8.5, 6)})
    EXPECT_EQ(friction_at(dry), 0.8) << dry.transpose();
  for (const Vec2& met : {Vec2(2.5, 4), Vec2(5, 4), Vec2(4.1, 2.5), Vec2(8.5, 4)})
    EXPECT_EQ(friction_at(met), 0.3) << met.transpose();
  EXPECT_NEAR(SurfaceBelow(dut, data.get(), {5, 4}), 0.04, 1e-6);
  EXPECT_NEAR(SurfaceBelow(dut, data.get(), {2.5, 4}), 0, 1e-6);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/uncovered_patches.h"

#include <gtest/gtest.h>

#include "planners/lines/pieces.h"
#include "planners/lines/prune.h"
#include "tests/planners/floors.h"

namespace floorproof {
namespace {

Floor Hall() {  // 5 m x 4 m; poses from 0.2 m off the walls
  const RobotSpec robot = testing::DiscRobot(0.2, 0.3);
  const HazardMap map = testing::EmptyFloor(100, 80, 0.05);
  return CropFloor(ComputeSweepArea(map, robot.clear, robot.tool, 0.01, {1, 1}), robot.clear,
                   robot.tool, 0.3);
}

// Rows along x at the given heights.
Polyline BackAndForth(const Floor& floor, const std::vector<double>& ys_m) {
  Polyline path;
  for (std::size_t i = 0; i < ys_m.size(); ++i) {
    const Vec2 a = floor.ToCells(Vec2(0.225, ys_m[i])), b = floor.ToCells(Vec2(4.775, ys_m[i]));
    path.push_back(i % 2 ? b : a);
    path.push_back(i % 2 ? a : b);
  }
  return path;
}

TEST(LinesOverUncoveredPatches, AForgottenRowIsFound) {
  const Floor floor = Hall();
  const ShortestPaths paths(floor);
  Swept swept(floor);
  std::vector<double> ys;
  for (double y = 0.225; y < 3.8; y += 0.296)
    if (std::abs(y - 1.7) > 0.1) ys.push_back(y);
  swept.Add(BackAndForth(floor, ys));
  const double before = swept.share();
  const auto lines = LinesOverUncoveredPatches(floor, paths, 20, swept);
  EXPECT_GT(swept.share(), before + 0.05);
  EXPECT_GT(swept.share(), 0.97);
  double length = 0;
  for (const Polyline& line : lines) {
    length += PolylineLength(line);
    for (const Vec2& p : line) EXPECT_TRUE(floor.Free(p, floor.tolerance));
  }
  EXPECT_LT(length * 0.05, 10);  // the row is 4.5 m long
}

TEST(LinesOverUncoveredPatches, SweptGroundNeedsNone) {
  const Floor floor = Hall();
  const ShortestPaths paths(floor);
  Swept swept(floor);
  for (double y = 0.225; y < 3.8; y += 0.05)
    swept.Add(floor.ToCells(Vec2(0.225, y)), floor.ToCells(Vec2(4.775, y)));
  EXPECT_TRUE(LinesOverUncoveredPatches(floor, paths, 20, swept).empty());
}

TEST(Prune, ADetourOverSweptGroundGoesAndARowStays) {
  const Floor floor = Hall();
  const Polyline rows = BackAndForth(floor, {1.0, 1.3, 1.6});
  Polyline path = rows;
  path.insert(path.begin() + 2, floor.ToCells(Vec2(2.0, 1.0)));  // back along the first row
  path.insert(path.begin() + 3, floor.ToCells(Vec2(4.75, 1.0)));
  Swept swept(floor);
  swept.Add(path);
  const double before = swept.swept_cells();
  Prune(floor, {floor.ground_cells, 0.3}, path, swept);
  EXPECT_NEAR(PolylineLength(path), PolylineLength(rows), 1);
  EXPECT_GE(swept.swept_cells(), before);
}

TEST(Prune, KeepsItsBooks) {
  const Floor floor = Hall();
  Polyline path = BackAndForth(floor, {0.3, 0.5, 0.6, 1.4, 1.0, 1.3, 2.6, 2.5, 3.4});
  Swept swept(floor), again(floor);
  swept.Add(path);
  const double length = PolylineLength(path);
  Prune(floor, {0.5 * floor.ground_cells, 0.4}, path, swept);
  again.Add(path);
  EXPECT_EQ(swept.swept_cells(), again.swept_cells());
  EXPECT_GE(swept.share(), 0.5);
  EXPECT_LT(PolylineLength(path), length);
}

TEST(WorkingPieces, TransitsFallOutAndNothingSweptIsLost) {
  const Floor floor = Hall();
  Polyline path = BackAndForth(floor, {0.5, 0.8});
  path.push_back(floor.ToCells(Vec2(4.0, 0.65)));  // over swept ground
  const Polyline far = BackAndForth(floor, {3.0});
  path.push_back(floor.ToCells(Vec2(0.4, 0.65)));
  path.insert(path.end(), far.begin(), far.end());
  Swept swept(floor);
  swept.Add(path);
  const double before = swept.swept_cells();
  const auto pieces = WorkingPieces(floor, path, 0.05, swept);
  EXPECT_EQ(pieces.size(), 2u);
  double length = 0;
  for (const Polyline& piece : pieces) length += PolylineLength(piece);
  EXPECT_LT(length, PolylineLength(path) - floor.ToCells(3.0));
  EXPECT_GT(swept.swept_cells(), 0.98 * before);
}

TEST(CutBeside, ALineIsCutWhereAVisitBranchesOff) {
  const Floor floor = Hall();
  const Polyline row = BackAndForth(floor, {1.0});
  std::vector<Polyline> pieces = {row};
  CutBeside(floor, {{floor.ToCells(Vec2(2.0, 1.5)), floor.ToCells(Vec2(2.0, 3.5))}},
            floor.ToCells(0.8), pieces);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_LT((floor.ToWorld(pieces[0].back()) - Vec2(2, 1)).norm(), 1e-9);
  EXPECT_EQ(pieces[0].back(), pieces[1].front());
  EXPECT_NEAR(PolylineLength(pieces[0]) + PolylineLength(pieces[1]), PolylineLength(row), 1e-9);
}

}  // namespace
}  // namespace floorproof

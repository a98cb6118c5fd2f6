// SPDX-License-Identifier: Apache-2.0
// The paper's strategies, each on a floor on which it alone says where to go.
#include "tests/online/cell_floor.h"

namespace floorproof {
namespace {

using testing::CellFloor;
using testing::CellRun;
using testing::MakeOnline;

double Figure(const OnlinePlanner& planner, const std::string& name) {
  for (const auto& [figure, value] : planner.figures())
    if (figure == name) return value;
  ADD_FAILURE() << name;
  return -1;
}

// Eqs. 4 to 6 in a window of nine cells, of which the robot's is the middle. In a corner each of
// its three neighbours has three free neighbours in the window; beside a wall the one away from it
// has five, the others three; in the open the four at its sides have five.
TEST(RollingWindow, GoesWhereMostIsFreeInTheWindow) {
  const auto first = [](const std::vector<std::string>& rows) {
    const auto dut = MakeOnline("rolling_window", "radius_m: 0.75");
    const CellFloor floor(rows);
    CellRun run(*dut, floor);
    run.Step();
    return Cell{run.way[0].ix - floor.start.ix, run.way[0].iy - floor.start.iy};
  };
  EXPECT_EQ(first({"...", "...", "S.."}), (Cell{1, 0})) << "in a corner all are alike";
  EXPECT_EQ(first({"...", "...", ".S."}), (Cell{0, 1})) << "away from the wall";
  EXPECT_EQ(first({"...", "S..", "..."}), (Cell{1, 0})) << "away from that wall";
  EXPECT_EQ(first({"...", ".S.", "..."}), (Cell{1, 0})) << "in the open the first of its sides";
  EXPECT_EQ(first({"...", ".S#", "..."}), (Cell{-1, 0})) << "opposite to what is occupied";
}

// A wider window holds more of what is free around each of the cells beside the robot.
TEST(RollingWindow, AWiderWindowCountsMore) {
  const auto first = [](const char* radius) {
    const auto dut = MakeOnline("rolling_window", std::string("radius_m: ") + radius);
    CellRun run(*dut, CellFloor({".....",  //
                                 ".....",  //
                                 "..S..",  //
                                 "#####"}));
    run.Step();
    return run.way[0];
  };
  EXPECT_EQ(first("0.75"), (Cell{2, 2})) << "five; the diagonal has three";
  EXPECT_EQ(first("1.5"), (Cell{3, 2})) << "both have eight: the first counter-clockwise from east";
}

// F2 and F3: at the end of a dead end it goes straight to the nearest uncovered cell.
TEST(RollingWindow, GoesStraightToTheNearestUncoveredCell) {
  const CellFloor floor({"....#",  //
                         "###.#",  //
                         "S...#"});
  const auto dut = MakeOnline("rolling_window", "radius_m: 3");
  CellRun run(*dut, floor);
  EXPECT_EQ(run.Run().kind, OnlineStep::Kind::kDone);
  EXPECT_EQ(run.world.coverage(), 1);
  EXPECT_EQ(run.world.revisited(), 0);
  EXPECT_EQ(Figure(*dut, "f3_given_up"), 0);
}

// F3 turns left first. A wall stands between the robot, which has covered its own side, and the
// nearest cell that it has not.
TEST(RollingWindow, TurnsUntilTheWayIsClear) {
  const CellFloor floor({"#########",  //
                         "#.......#",  //
                         "#.##.##.#",  //
                         "#S#####.#",  //
                         "#########"});
  const auto dut = MakeOnline("rolling_window", "radius_m: 2");
  CellRun run(*dut, floor);
  EXPECT_EQ(run.Run().kind, OnlineStep::Kind::kDone);
  EXPECT_EQ(run.world.coverage(), 1);
}

// Behind a long wall F3 would go to and fro: it gives up after its turns, and the shortest way over
// known floor leads on.
TEST(RollingWindow, GivesUpAfterItsTurnsAndTakesTheShortestWay) {
  const CellFloor floor({"..............",  //
                         ".############.",  //
                         "S.............",  //
                         ".############.",  //
                         ".............."});
  double given_up[2];
  int i = 0;
  for (const char* turns : {"1", "16"}) {
    const auto dut =
        MakeOnline("rolling_window", std::string("radius_m: 1.5, most_turns: ") + turns);
    CellRun run(*dut, floor);
    EXPECT_EQ(run.Run().kind, OnlineStep::Kind::kDone);
    EXPECT_EQ(run.world.coverage(), 1);
    given_up[i++] = Figure(*dut, "f3_given_up");
  }
  EXPECT_GE(given_up[0], given_up[1]);
}

// Where nothing uncovered is in the window, it leaves by the shortest way.
TEST(RollingWindow, LeavesAWindowThatIsCovered) {
  const CellFloor floor({"....................",  //
                         ".##################.",  //
                         "...........S........"});
  const auto dut = MakeOnline("rolling_window", "radius_m: 0.5");
  CellRun run(*dut, floor);
  EXPECT_EQ(run.Run().kind, OnlineStep::Kind::kDone);
  EXPECT_EQ(run.world.coverage(), 1);
}

TEST(RollingWindow, StepsDiagonallyOnlyWithoutCuttingCorners) {
  const CellFloor floor({"#.",  //
                         "S#"});
  const auto dut = MakeOnline("rolling_window", "radius_m: 1");
  CellRun run(*dut, floor);
  EXPECT_EQ(run.Step().kind, OnlineStep::Kind::kNowhere);
}

}  // namespace
}  // namespace floorproof

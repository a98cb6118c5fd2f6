// SPDX-License-Identifier: Apache-2.0
// What every planner of unknown floors must do, on drawn floors of cells.
#include <gmock/gmock.h>

#include "tests/online/cell_floor.h"

namespace floorproof {
namespace {

using testing::CellFloor;
using testing::CellRun;
using testing::MakeOnline;

// Rooms with pillars, a comb of dead ends, a diagonal gap that no robot fits through.
const std::vector<std::vector<std::string>>& Floors() {
  static const std::vector<std::vector<std::string>> kFloors = {
      {"..........",  //
       "..........",  //
       "...##.....",  //
       "...##..S..",  //
       "..........",  //
       ".#......##",  //
       ".#......##",  //
       ".........."},
      {"###############",  //
       "#S#...#...#...#",  //
       "#.#.#.#.#.#.#.#",  //
       "#.#.#.#.#.#.#.#",  //
       "#.#.#.#.#.#.#.#",  //
       "#...#...#...#.#",  //
       "###############"},
      {"....#....",  //
       "..S.#....",  //
       "....#....",  //
       "###......",  //
       "....#....",  //
       "....#...."},
      {"S."},
  };
  return kFloors;
}

struct Case {
  std::string planner;
  double radius_m;
  friend std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.planner << " seeing " << c.radius_m << " m";
  }
};

class EveryOnlinePlanner : public ::testing::TestWithParam<Case> {
 protected:
  static std::unique_ptr<OnlinePlanner> Make() {
    return MakeOnline(GetParam().planner, "radius_m: " + std::to_string(GetParam().radius_m));
  }
  std::unique_ptr<OnlinePlanner> dut_ = Make();
};

std::vector<Case> Cases() {
  std::vector<Case> cases;
  for (const auto& entry : OnlinePlanners())
    for (const double radius_m : {0.5, 0.75, 2.5})
      cases.push_back({std::string(entry.name), radius_m});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(All, EveryOnlinePlanner, ::testing::ValuesIn(Cases()),
                         [](const auto& each) {
                           const int cm = static_cast<int>(100 * each.param.radius_m);
                           return each.param.planner + "_" + std::to_string(cm);
                         });

// Where it goes is checked in each step.
TEST_P(EveryOnlinePlanner, CoversAllThatCanBeReachedOrGoesOnForEver) {
  for (const auto& rows : Floors()) {
    CellRun run(*dut_, CellFloor(rows));
    const OnlineStep end = run.Run(20'000);
    if (dut_->covers_all()) {
      EXPECT_EQ(end.kind, OnlineStep::Kind::kDone);
      EXPECT_NE(end.why, "");
      EXPECT_EQ(run.world.coverage(), 1);
    } else {
      EXPECT_EQ(end.kind, OnlineStep::Kind::kTarget);
      EXPECT_GT(run.world.coverage(), 0.9);
    }
    ASSERT_FALSE(HasFailure()) << rows.size() << " rows";
  }
}

TEST_P(EveryOnlinePlanner, ARobotWalledInHasNowhereToGo) {
  const CellFloor floor({"...#...",  //
                         "..#S#..",  //
                         "...#..."});
  CellRun run(*dut_, floor);
  const OnlineStep step = run.Step();
  EXPECT_EQ(step.kind, OnlineStep::Kind::kNowhere);
  EXPECT_THAT(std::string(step.why), ::testing::HasSubstr("no free floor"));
}

TEST_P(EveryOnlinePlanner, TheSameSeedIsTheSameDriveWhateverWasDrivenBefore) {
  const CellFloor floor(Floors()[0]);
  CellRun first(*dut_, floor, 7);
  first.Run(300);
  CellRun other(*dut_, CellFloor(Floors()[2]), 8);
  other.Run(50);
  CellRun again(*dut_, floor, 7);
  again.Run(300);
  EXPECT_EQ(first.way, again.way);
  CellRun seeded(*dut_, floor, 8);
  seeded.Run(300);
  EXPECT_EQ(seeded.way != first.way, dut_->uses_seed());
}

// What it has not seen cannot move it: two floors that differ out of sight are driven alike until
// the difference is seen.
TEST_P(EveryOnlinePlanner, WhatIsOutOfSightChangesNothing) {
  std::vector<std::string> rows(9, std::string(30, '.'));
  rows[4][2] = 'S';
  CellFloor open(rows), other(rows);
  for (int iy = 0; iy < 9; ++iy) other.blocked(20, iy) = 1;
  const auto twin = Make();
  CellRun a(*dut_, open, 3), b(*twin, other, 3);
  const int sight = static_cast<int>(dut_->params().radius_m / testing::kCell_m);
  for (int i = 0; i < 400 && a.world.here().ix + sight < 20; ++i) {
    ASSERT_EQ(a.world.here(), b.world.here()) << "step " << i;
    if (a.Step().kind != OnlineStep::Kind::kTarget) break;
    b.Step();
  }
  EXPECT_GT(a.way.size(), 10u);
}

TEST_P(EveryOnlinePlanner, ParametersAreDocumented) {
  for (const ParamDoc& doc : DocumentParams(*dut_)) EXPECT_NE(doc.help, "") << doc.name;
}

}  // namespace
}  // namespace floorproof

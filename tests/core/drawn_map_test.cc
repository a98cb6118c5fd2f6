// SPDX-License-Identifier: Apache-2.0
#include "env/core/drawn_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "env/core/coverage.h"

namespace floorproof {
namespace {

using State = KnownAgainstTruth::State;

// A floor of square cells; the top row first, '#' is wall.
HazardMap Truth(const std::vector<std::string>& rows, double cell_m = 0.05) {
  HazardMap map;
  const int w = static_cast<int>(rows[0].size()), h = static_cast<int>(rows.size());
  map.frame = {w, h, cell_m, {}};
  map.occupancy = Grid<CellState>(w, h, CellState::kFree);
  for (int iy = 0; iy < h; ++iy)
    for (int ix = 0; ix < w; ++ix)
      if (rows[static_cast<std::size_t>(h - 1 - iy)][static_cast<std::size_t>(ix)] == '#')
        map.occupancy(ix, iy) = CellState::kOccupied;
  return map;
}

// '.' known free, '#' known occupied, '?' unknown.
KnownMap Known(const std::vector<std::string>& rows, double cell_m = 0.05) {
  const int w = static_cast<int>(rows[0].size()), h = static_cast<int>(rows.size());
  KnownMap known({w, h, cell_m, {}});
  for (int iy = 0; iy < h; ++iy)
    for (int ix = 0; ix < w; ++ix) {
      const char c = rows[static_cast<std::size_t>(h - 1 - iy)][static_cast<std::size_t>(ix)];
      known.log_odds(ix, iy) = c == '#' ? 2.0f : (c == '.' ? -2.0f : 0.0f);
    }
  return known;
}

int Count(const KnownAgainstTruth& seen, State state) {
  int n = 0;
  for (const std::uint8_t cell : seen.cells.cells) n += cell == state;
  return n;
}

Hazard Box(HazardClass of, const Vec2& low, const Vec2& high) {
  Hazard hazard;
  hazard.hazard_class = of;
  hazard.footprint = {Rectangle(low, high)};
  return hazard;
}

// Never more room than there is; less by no more than the corners of the polygon that stands for
// the mark, and a cell.
TEST(WithMarks, TheClearanceIsTheWayToTheNearestMark) {
  const HazardMap map =
      Truth(std::vector<std::string>(100, std::string(100, '.')));  // 5 m x 5 m, wall beyond
  const std::vector<FloorMark> marks = {{FloorMark::Kind::kBump, {2.013, 2.04}, 0.05},
                                        {FloorMark::Kind::kDrop, {3.5, 2.6}, 0.3},
                                        {FloorMark::Kind::kBump, {2.2, 3.4}, 0.004},
                                        {FloorMark::Kind::kBump, {1.1, 1.0}, 0.9}};
  const ClearanceField bare = ComputeClearance(map, 0.01);
  const ClearanceField dut = ComputeClearance(WithMarks(map, marks), 0.01);
  for (int iy = 0; iy < 100; ++iy)
    for (int ix = 0; ix < 100; ++ix) {
      const Vec2 p = map.frame.Center(ix, iy);
      double room_m = bare.At(p), least_m = room_m;
      for (const FloorMark& mark : marks) {
        const double to_mark_m = std::max(0.0, (p - mark.p_W).norm() - mark.radius_m);
        room_m = std::min(room_m, to_mark_m);
        least_m = std::min(least_m, to_mark_m - 0.083 * mark.radius_m - std::sqrt(2) * 0.05);
      }
      EXPECT_LE(dut.At(p), room_m + 1e-6) << p.transpose();
      EXPECT_GE(dut.At(p), least_m - 1e-6) << p.transpose();
    }
}

// A mark is no step that a robot could cross, and no floor that lies below it takes it back.
TEST(WithMarks, NothingMakesAMarkADrivableFloor) {
  HazardMap map = Truth(std::vector<std::string>(40, std::string(40, '.')));
  map.hazards = {Box(HazardClass::kLevelChange, {0.5, 0.5}, {1.5, 1.5}),
                 Box(HazardClass::kLevelChange, {0.5, 0.5}, {1.5, 1.5})};
  map.hazards[0].height_m = -1;
  map.hazards[1].height_m = 0.005;
  const Vec2 p(1.02, 1.02);
  ASSERT_GT(ComputeClearance(map, 0.01).At(p), 0.3) << "the bridge over the pit can be driven";
  for (const auto kind : {FloorMark::Kind::kBump, FloorMark::Kind::kDrop})
    EXPECT_EQ(ComputeClearance(WithMarks(map, {{kind, p, 0.05}}), 100).At(p), 0);
}

TEST(WithMarks, KeepsTheMapAsItWas) {
  HazardMap map = Truth(std::vector<std::string>(40, std::string(40, '.')));
  map.hazards = {Box(HazardClass::kBlindObject, {0.5, 0.5}, {0.6, 0.6})};
  map.hazards[0].id = "chair";
  const HazardMap dut = WithMarks(map, {{FloorMark::Kind::kBump, {1.5, 1.5}, 0.05}});
  EXPECT_EQ(map.hazards.size(), 1u);
  ASSERT_EQ(dut.hazards.size(), 2u);
  EXPECT_EQ(dut.hazards[0].id, "chair");
  EXPECT_EQ(dut.occupancy.cells, map.occupancy.cells);
  EXPECT_EQ(ComputeClearance(dut, 0.01).At({0.55, 0.55}), 0);
  EXPECT_EQ(WithMarks(map, {}).hazards.size(), 1u);
}

// Ten cells of floor, of which seven are known; one known cell of ten is wrong.
TEST(Compare, CountsWhatIsKnownAndWhatIsWrong) {
  const HazardMap truth = Truth({"#######",  //
                                 "#.....#",  //
                                 "#.....#",  //
                                 "#######"});
  const KnownMap known = Known({"???????",  //
                                "#...??#",  //
                                "#...#??",  //
                                "???????"});
  const KnownAgainstTruth dut = Compare(known, truth, 0.01, 0);
  EXPECT_DOUBLE_EQ(dut.known, 0.7);
  EXPECT_DOUBLE_EQ(dut.wrong, 0.1);
  EXPECT_EQ(dut.cells(1, 1), State::kFree);
  EXPECT_EQ(dut.cells(4, 1), State::kWronglyOccupied);
  EXPECT_EQ(dut.cells(0, 1), State::kOccupied);
  EXPECT_EQ(dut.cells(5, 1), State::kUnknown);
  EXPECT_EQ(dut.cells(0, 0), State::kUnknown);
  EXPECT_EQ(Count(dut, State::kFree), 6);
  EXPECT_EQ(Count(dut, State::kOccupied), 3);
}

TEST(Compare, NothingKnownIsNothingWrong) {
  const HazardMap truth = Truth({"###", "#.#", "###"});
  const KnownAgainstTruth dut = Compare(Known({"???", "???", "???"}), truth, 0.01, 0.1);
  EXPECT_EQ(dut.known, 0);
  EXPECT_EQ(dut.wrong, 0);
  EXPECT_EQ(Count(dut, State::kUnknown), 9);
}

// A wall is drawn one cell, then three cells, beside its place: in front of it and behind it.
TEST(Compare, AWallALittleBesideItsPlaceIsNotWrong) {
  // High enough that its upper and lower border, beyond which all is wall, are far.
  constexpr std::size_t kRows = 9;
  const HazardMap truth = Truth(std::vector<std::string>(kRows, "........####"));
  const auto wrong = [&](const std::string& row, double slack_m) {
    return Compare(Known(std::vector<std::string>(kRows, row)), truth, 0.01, slack_m).wrong;
  };
  EXPECT_EQ(wrong("........#???", 0), 0);
  EXPECT_EQ(wrong(".......#????", 0.05), 0);
  EXPECT_EQ(wrong(".........#??", 0.05), 0);
  EXPECT_GT(wrong(".......#????", 0), 0);
  EXPECT_GT(wrong(".........#??", 0), 0);
  EXPECT_GT(wrong(".....#??????", 0.1), 0);
  EXPECT_GT(wrong("...........#", 0.1), 0);
}

// However thin: a pane is a wall that was not drawn, not one beside its place.
TEST(Compare, GlassSeenThroughIsTakenForFree) {
  HazardMap truth = Truth(std::vector<std::string>(9, std::string(21, '.')));
  truth.hazards = {Box(HazardClass::kGlass, {0.51, 0}, {0.52, 0.45})};  // within one column
  const std::vector<std::string> through(9, std::string(21, '.'));
  for (const double slack_m : {0.0, 0.05, 0.1}) {
    const KnownAgainstTruth dut = Compare(Known(through), truth, 0.01, slack_m);
    EXPECT_EQ(Count(dut, State::kWronglyFree), 9) << slack_m;
    EXPECT_EQ(dut.cells(10, 4), State::kWronglyFree) << slack_m;
    EXPECT_DOUBLE_EQ(dut.wrong, 1.0 / 21) << slack_m;
  }
  // Where the robot has bumped into it, it knows better, there and as far as the slack goes.
  KnownMap bumped = Known(through);
  bumped.marked(10, 4) = 1;
  const KnownAgainstTruth dut = Compare(bumped, truth, 0.01, 0.05);
  EXPECT_EQ(dut.cells(10, 4), State::kOccupied);
  EXPECT_EQ(dut.cells(10, 5), State::kFree);
  EXPECT_EQ(dut.cells(10, 7), State::kWronglyFree);
}

TEST(Compare, ALevelChangeIsWrongOnlyForARobotThatCannotCrossIt) {
  HazardMap truth = Truth(std::vector<std::string>(9, std::string(21, '.')));
  truth.hazards = {Box(HazardClass::kLevelChange, {0.5, 0}, {0.8, 0.45})};
  truth.hazards[0].height_m = -0.02;
  const KnownMap known = Known(std::vector<std::string>(9, std::string(21, '.')));
  EXPECT_GT(Compare(known, truth, 0.01, 0.1).wrong, 0.1);
  EXPECT_EQ(Compare(known, truth, 0.03, 0.1).wrong, 0);
}

// A site of coarse cells is compared on the known map's own fine ones.
TEST(Compare, TheKnownMapMayBeFinerThanTheSite) {
  const HazardMap truth = Truth({"##", ".#"}, 0.1);
  const KnownAgainstTruth dut = Compare(Known({"????", "????", "..#?", "..#?"}), truth, 0.01, 0);
  EXPECT_EQ(dut.cells.width, 4);
  EXPECT_EQ(dut.known, 1);
  EXPECT_EQ(dut.wrong, 0);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/known/known_map.h"

#include <gmock/gmock.h>

#include <utility>
#include <vector>

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kMost = 4;

KnownMap On(int cells) { return KnownMap({cells, cells, 0.05, {}}); }

TEST(KnownMap, ACellIsKnownOnceItsLogOddsAreSure) {
  KnownMap dut = On(1);
  const std::vector<std::pair<float, CellState>> cases = {{0.0f, CellState::kUnknown},
                                                          {0.79f, CellState::kUnknown},
                                                          {-0.79f, CellState::kUnknown},
                                                          {KnownMap::kSure, CellState::kOccupied},
                                                          {-KnownMap::kSure, CellState::kFree},
                                                          {4.0f, CellState::kOccupied},
                                                          {-4.0f, CellState::kFree}};
  for (const auto& [odds, state] : cases) {
    dut.log_odds(0, 0) = odds;
    EXPECT_EQ(dut.At(0, 0), state) << odds;
  }
}

TEST(KnownMap, AMarkWinsOverEveryScan) {
  KnownMap dut = On(1);
  dut.marked(0, 0) = 1;
  for (const float odds : {-4.0f, 0.0f, 4.0f}) {
    dut.log_odds(0, 0) = odds;
    EXPECT_EQ(dut.At(0, 0), CellState::kOccupied) << odds;
  }
}

TEST(KnownMap, TellsWhichCellsAreOfAnotherState) {
  KnownMap dut = On(5);
  dut.changed.emplace();
  dut.Add(1, 2, -0.5, kMost);
  EXPECT_THAT(*dut.changed, IsEmpty()) << "not sure yet";
  dut.Add(1, 2, -0.5, kMost);
  EXPECT_THAT(*dut.changed, ElementsAre(Cell{1, 2}));
  dut.changed->clear();
  dut.Add(1, 2, -0.5, kMost);
  EXPECT_THAT(*dut.changed, IsEmpty()) << "free as before";
  dut.Add(1, 2, 2, kMost);
  EXPECT_THAT(*dut.changed, ElementsAre(Cell{1, 2})) << "from free to occupied";
  dut.Add(-1, 2, 2, kMost);
  dut.Add(1, 5, 2, kMost);
  EXPECT_EQ(dut.changed->size(), 1u) << "nothing lies off the map";
}

TEST(KnownMap, AMarkTellsOfTheCellsThatWereNotOccupied) {
  KnownMap dut = On(5);
  dut.changed.emplace();
  dut.Add(3, 2, 4, kMost);
  dut.changed->clear();
  dut.Mark(FloorMark::Kind::kDrop, dut.frame.Center(2, 2), 0.051);
  EXPECT_THAT(*dut.changed, ElementsAre(Cell{2, 1}, Cell{1, 2}, Cell{2, 2}, Cell{2, 3}));
}

TEST(KnownMap, WhatIsMetAgainGrows) {
  KnownMap dut = On(5);
  for (int i = 0; i < 3; ++i) dut.Mark(FloorMark::Kind::kBump, dut.frame.Center(2, 2), 0.04);
  dut.Mark(FloorMark::Kind::kBump, dut.frame.Center(0, 0), 0.04);
  ASSERT_EQ(dut.marks.size(), 2u);
  EXPECT_DOUBLE_EQ(dut.marks[0].radius_m, 0.08);
  EXPECT_DOUBLE_EQ(dut.marks[1].radius_m, 0.04);
}

}  // namespace
}  // namespace floorproof

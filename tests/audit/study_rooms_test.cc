// SPDX-License-Identifier: Apache-2.0
// The rooms, places and cleaner of the study (gathering_study_test.cc), and a glance at what it
// finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/audit/gathering_study.h"

namespace floorproof {
namespace {

using testing::DrawStudyRoom;
using testing::SampleAt;
using testing::StudyFloor;
using testing::StudyPlaces;
using testing::Trial;

TEST(StudyRooms, ThoseOfTrial1bHoldMoreFurniture) {
  const auto furniture = [](Trial trial) {
    std::ptrdiff_t cells = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const std::string rows = DrawStudyRoom(trial, seed).rows;
      EXPECT_EQ(rows, DrawStudyRoom(trial, seed).rows);
      const int side = testing::kStudyCells;
      const std::ptrdiff_t in_room = std::ranges::count(rows, '#') - 4 * (side + 1);
      EXPECT_GT(in_room, 0);
      EXPECT_LT(in_room, side * side / 2);
      cells += in_room;
    }
    return static_cast<double>(cells);
  };
  EXPECT_GT(furniture(Trial::k1b), 1.7 * furniture(Trial::k1a));
}

// A square of three cells, 0.45 m, stands for the cleaner: 0.44 m across.
TEST(StudyRooms, TheCleanerGetsToAllFloorFromTheStart) {
  constexpr int kSide = testing::kStudyCells + 2;  // with the walls
  for (const Trial trial : {Trial::k1a, Trial::k1b})
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const testing::StudyRoom room = DrawStudyRoom(trial, seed);
      const auto is_free = [&room](int x, int y) {
        return room.rows[static_cast<std::size_t>((kSide - 1 - y) * (kSide + 1) + x)] == '.';
      };
      const auto fits = [&is_free](Cell c) {
        for (int k = 0; k < 9; ++k)
          if (!is_free(c.ix + k % 3 - 1, c.iy + k / 3 - 1)) return false;
        return true;
      };
      Grid<std::uint8_t> stood(kSide, kSide), swept(kSide, kSide);
      const auto cell = [](double along_m) {
        return static_cast<int>(along_m / testing::kStudyCell_m);
      };
      std::vector<Cell> stack = {{cell(room.start_W.x()), cell(room.start_W.y())}};
      while (!stack.empty()) {
        const Cell c = stack.back();
        stack.pop_back();
        if (!fits(c) || stood(c)) continue;
        stood(c) = 1;
        for (int k = 0; k < 9; ++k) swept(c.ix + k % 3 - 1, c.iy + k / 3 - 1) = 1;
        stack.insert(stack.end(),
                     {{c.ix - 1, c.iy}, {c.ix + 1, c.iy}, {c.ix, c.iy - 1}, {c.ix, c.iy + 1}});
      }
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          EXPECT_EQ(swept(x, y) != 0, is_free(x, y)) << "room " << seed << ": " << x << ", " << y;
    }
}

TEST(StudyRooms, PlacesAreWithinReachOfTheNoseAndOfOneNumber) {
  const StudyFloor floor(Trial::k1a, 21);
  const StudyPlaces places = floor.Places();
  EXPECT_GE(places.geometric.size(), 30u);
  EXPECT_EQ(places.uniform.size(), places.geometric.size());
  const auto mean_to_wall = [&floor](const std::vector<Vec2>& at) {
    double sum = 0;
    for (const Vec2& p_W : at) {
      EXPECT_GE(floor.ToWall(p_W), 0.18 - 0.135 - 1e-9);
      sum += floor.ToWall(p_W);
    }
    return sum / static_cast<double>(at.size());
  };
  EXPECT_LT(mean_to_wall(places.geometric), 0.5 * mean_to_wall(places.uniform));
  EXPECT_FALSE(floor.WithinReach({0.15 + 0.03, 2.0}));
}

TEST(StudyRooms, TapesNearWallsFindMoreDirt) {
  const StudyFloor floor(Trial::k1b, 21);
  const DirtField left = floor.Cleaned(floor.Sweep());
  const StudyPlaces places = floor.Places();
  EXPECT_GT(*Gather(SampleAt(left, places.geometric, 1)).Efficiency(),
            *Gather(SampleAt(left, places.uniform, 1)).Efficiency() + 0.1);
}

}  // namespace
}  // namespace floorproof

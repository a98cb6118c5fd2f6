// SPDX-License-Identifier: Apache-2.0
#include "env/audit/dirt_field.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/audit/audit_floors.h"

namespace floorproof {
namespace {

using testing::AddWall;
using testing::BareRoom;

// Of counts that should be the same everywhere, in standard deviations of the chi-square's law.
double ChiSquareExcess(const std::vector<std::int64_t>& counts) {
  double sum = 0, chi = 0;
  for (const auto n : counts) sum += static_cast<double>(n);
  const double mean = sum / static_cast<double>(counts.size());
  for (const auto n : counts)
    chi += (static_cast<double>(n) - mean) * (static_cast<double>(n) - mean) / mean;
  const double freedom = static_cast<double>(counts.size()) - 1;
  return (chi - freedom) / std::sqrt(2 * freedom);
}

std::vector<std::int64_t> CountsOf(const DirtField& field) {
  std::vector<std::int64_t> counts;
  for (int iy = 0; iy < field.frame().height; ++iy)
    for (int ix = 0; ix < field.frame().width; ++ix)
      if (field.IsFloor(ix, iy)) counts.push_back(field.CountIn(ix, iy));
  return counts;
}

// Particles to the square metre, in a rectangle of the world.
double Density(const DirtField& field, const Vec2& low, const Vec2& high) {
  int inside = 0;
  for (const Particle& p : field.All())
    inside += (p.p_W.array() >= low.array()).all() && (p.p_W.array() < high.array()).all();
  return inside / (high - low).prod();
}

TEST(DirtField, IsEvenOverTheFloorAndWithinItsBins) {
  HazardMap map = BareRoom(3, 2);
  AddWall(map, 20, 10, 29, 19);
  const DirtField dut = LayDirt(map, {}, 1);
  EXPECT_NEAR(dut.floor_m2(), 5.75, 1e-9);
  EXPECT_EQ(dut.size(), 80'000 * 5.75);
  EXPECT_LT(std::abs(ChiSquareExcess(CountsOf(dut))), 4);
  // Fractions of a bin, 8 x 8.
  std::vector<std::int64_t> parts(64);
  for (const Particle& p : dut.All()) {
    const Vec2 at = p.p_W / 0.05;
    const auto part = [](double v) { return static_cast<std::size_t>(8 * (v - std::floor(v))); };
    ++parts[8 * part(at.y()) + part(at.x())];
  }
  EXPECT_LT(std::abs(ChiSquareExcess(parts)), 4);
}

TEST(DirtField, LiesOnFreeFloorOnlyWhereverTheMapLies) {
  HazardMap map = BareRoom(2, 2, 0.2, {3, -1, 0.7});
  AddWall(map, 0, 0, 3, 9);
  map.occupancy(7, 7) = CellState::kUnknown;
  for (const bool unknown_is_wall : {true, false}) {
    map.unknown_is_wall = unknown_is_wall;
    const DirtField dut = LayDirt(map, {.density_per_m2 = 20'000}, 2);
    int on_unknown = 0;
    for (const Particle& p : dut.All()) {
      const Cell cell = map.frame.ToCell(p.p_W);
      ASSERT_FALSE(map.IsWall(cell));
      on_unknown += cell == Cell{7, 7};
    }
    EXPECT_EQ(on_unknown > 0, !unknown_is_wall);
  }
}

TEST(DirtField, DiametersAreEvenBetweenLeastAndMost) {
  const DirtField dut = LayDirt(BareRoom(1, 1), {}, 3);
  std::vector<std::int64_t> counts(10);
  for (const Particle& p : dut.All()) {
    ASSERT_GE(p.diameter_m, 0.0005);
    ASSERT_LE(p.diameter_m, 0.001);
    ++counts[static_cast<std::size_t>(std::min(9.0, (p.diameter_m - 0.0005 + 1e-9) / 0.00005))];
  }
  EXPECT_LT(std::abs(ChiSquareExcess(counts)), 4);
}

TEST(DirtField, TheSameSeedGivesTheSameDirtAnotherSeedOther) {
  const HazardMap map = BareRoom(1, 1);
  const auto first = LayDirt(map, {}, 4).All(), again = LayDirt(map, {}, 4).All(),
             other = LayDirt(map, {}, 5).All();
  ASSERT_EQ(first.size(), again.size());
  int alike = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].p_W, again[i].p_W);
    ASSERT_EQ(first[i].diameter_m, again[i].diameter_m);
    alike += first[i].p_W == other[i].p_W;
  }
  EXPECT_LT(alike, 3);
}

TEST(DirtField, DirtGathersAtWallsAndHalfAsMuchAgainInCorners) {
  DirtParams params;
  params.density_per_m2 = 20'000;
  params.wall_density_per_m2 = 40'000;
  params.reach_m = 0.2;
  const DirtField dut = LayDirt(BareRoom(4, 4), params, 6);
  // 10 cm x 10 cm in the corners, strips of 10 cm along the walls, the middle.
  const double corner = (Density(dut, {0, 0}, {0.1, 0.1}) + Density(dut, {3.9, 3.9}, {4, 4}) +
                         Density(dut, {0, 3.9}, {0.1, 4}) + Density(dut, {3.9, 0}, {4, 0.1})) /
                        4;
  const double wall = (Density(dut, {1, 0}, {3, 0.1}) + Density(dut, {0, 1}, {0.1, 3}) +
                       Density(dut, {3.9, 1}, {4, 3}) + Density(dut, {1, 3.9}, {3, 4})) /
                      4;
  const double middle = Density(dut, {1.5, 1.5}, {2.5, 2.5});
  EXPECT_NEAR(middle, 20'000, 600);
  // The normal law's tail, 5 cm from the wall: 2 * 0.401.
  EXPECT_NEAR(wall, 20'000 + 40'000 * 0.802, 1'500);
  EXPECT_NEAR(corner, 20'000 + 40'000 * 2 * (1 - (1 - 0.401) * (1 - 0.401)), 4'000);
  // It falls all the way to the middle.
  double last = 1e9;
  for (const double x : {0.0, 0.1, 0.2, 0.3}) {
    const double here = Density(dut, {x, 1}, {x + 0.1, 3});
    EXPECT_LT(here, last) << x;
    last = here;
  }
}

// A wall at 45 degrees, drawn in cells, has a corner at every step: it must gather as a wall does.
TEST(DirtField, AWallDrawnInStepsGathersAsAWall) {
  DirtParams params;
  params.density_per_m2 = 0;
  params.wall_density_per_m2 = 40'000;
  params.reach_m = 0.2;
  HazardMap map = BareRoom(4, 4);
  for (int iy = 0; iy < 80; ++iy)
    for (int ix = 0; ix < 80; ++ix)
      if (ix + iy < 80) map.occupancy(ix, iy) = CellState::kOccupied;
  const DirtField dut = LayDirt(map, params, 7);
  // Along the middle of the diagonal, the 10 cm next to it but for the steps themselves.
  int near = 0;
  for (const Particle& p : dut.All()) {
    const double from_wall = (p.p_W.x() + p.p_W.y() - 4) / std::sqrt(2.0);
    const double along = (p.p_W.x() - p.p_W.y()) / std::sqrt(2.0);
    near += std::abs(along) < 1 && from_wall > 0.1 && from_wall < 0.2;
  }
  // The law 15 cm from a straight wall: 2 * 0.227. Cells of 5 cm blur the wall's place by 2 cm.
  EXPECT_NEAR(near / 0.2, 40'000 * 2 * 0.227, 3'500);
}

TEST(DirtField, ParticlesAreLaidTakenAndCountedOneByOne) {
  HazardMap map = BareRoom(1, 1);
  AddWall(map, 0, 0, 9, 19);
  DirtField dut(map);
  EXPECT_EQ(dut.size(), 0);
  EXPECT_TRUE(dut.Lay({{0.71, 0.22}, 0.0007}));
  EXPECT_TRUE(dut.Lay({{0.73, 0.22}, 0.0008}));
  EXPECT_FALSE(dut.Lay({{0.3, 0.3}, 0.0007}));           // in the wall
  EXPECT_FALSE(dut.Lay({{1.5, 0.3}, 0.0007}));           // beyond the map
  EXPECT_FALSE(dut.Lay({{std::nan(""), 0.3}, 0.0007}));  // nowhere
  ASSERT_EQ(dut.size(), 2);
  EXPECT_NEAR(dut.All()[0].p_W.x(), 0.71, 1e-6);
  EXPECT_NEAR(dut.All()[1].diameter_m, 0.0008, 1e-9);
  dut.TakeIf(14, 4, [](const Vec2& p, double) { return p.x() < 0.72; });
  ASSERT_EQ(dut.size(), 1);
  EXPECT_NEAR(dut.All()[0].p_W.x(), 0.73, 1e-6);
}

TEST(DirtField, RefusesWhatCannotBe) {
  const HazardMap map = BareRoom(1, 1);
  EXPECT_THROW(LayDirt(map, {.density_per_m2 = -1}, 1), InputError);
  EXPECT_THROW(LayDirt(map, {.density_per_m2 = std::nan("")}, 1), InputError);
  EXPECT_THROW(LayDirt(map, {.density_per_m2 = 1e9}, 1), InputError);
  EXPECT_THROW(LayDirt(map, {.least_diameter_m = 0.002}, 1), InputError);
  EXPECT_EQ(LayDirt(map, {.density_per_m2 = 0}, 1).size(), 0);
  HazardMap no_floor = BareRoom(1, 1);
  AddWall(no_floor, 0, 0, 19, 19);
  EXPECT_EQ(LayDirt(no_floor, {}, 1).size(), 0);
}

}  // namespace
}  // namespace floorproof

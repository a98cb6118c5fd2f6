// SPDX-License-Identifier: Apache-2.0
#include "planners/search/any_angle_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/streams.h"

namespace floorproof {
namespace {

using Cells = Grid<std::uint8_t>;
constexpr double kNone = std::numeric_limits<double>::infinity();

int Below(Stream& random, int n) {
  return static_cast<int>(random.Below(static_cast<std::uint64_t>(n)));
}

Cells Speckled(Stream& random, int width, int height, double blocked) {
  Cells free(width, height);
  for (std::uint8_t& cell : free.cells) cell = random.Uniform() >= blocked;
  return free;
}

void Fill(Cells& free, int x, int y, int w, int h, std::uint8_t value) {
  for (int iy = std::max(0, y); iy < std::min(free.height, y + h); ++iy)
    for (int ix = std::max(0, x); ix < std::min(free.width, x + w); ++ix) free(ix, iy) = value;
}

// Walls in both directions with a door each of 1 to 3 cells, and a few specks.
Cells Rooms(Stream& random, int width, int height) {
  Cells free(width, height, 1);
  for (int x = 5 + Below(random, 5); x + 3 < width; x += 5 + Below(random, 7)) {
    Fill(free, x, 0, 1 + Below(random, 2), height, 0);
    for (int i = 0; i < 3; ++i)
      Fill(free, x, Below(random, height - 2), 2, 1 + Below(random, 3), 1);
  }
  for (int y = 5 + Below(random, 5); y + 3 < height; y += 5 + Below(random, 7)) {
    Fill(free, 0, y, width, 1 + Below(random, 2), 0);
    for (int i = 0; i < 3; ++i) Fill(free, Below(random, width - 2), y, 1 + Below(random, 3), 2, 1);
  }
  for (int i = 0; i < width * height / 80; ++i)
    free(Below(random, width), Below(random, height)) = 0;
  return free;
}

// Discs in an open room.
Cells Blobs(Stream& random, int width, int height) {
  Cells free(width, height, 1);
  for (int i = 0; i < 3 + width * height / 60; ++i) {
    const int x = Below(random, width), y = Below(random, height);
    const double r = random.Uniform(0.5, 3);
    for (int iy = 0; iy < height; ++iy)
      for (int ix = 0; ix < width; ++ix)
        if (std::hypot(ix - x, iy - y) <= r) free(ix, iy) = 0;
  }
  return free;
}

Cells Mixed(Stream& random, int kind, int width, int height) {
  if (kind % 5 == 3) return Rooms(random, width, height);
  if (kind % 5 == 4) return Blobs(random, width, height);
  return Speckled(random, width, height, kind % 5 == 0 ? 0.03 : kind % 5 == 1 ? 0.12 : 0.3);
}

Cell RandomFree(Stream& random, const Cells& free) {
  for (;;) {
    const Cell c = CellAt(free, random.Below(free.cells.size()));
    if (free(c)) return c;
  }
}

bool IsFree(const Cells& free, int ix, int iy) { return free.Inside(ix, iy) && free(ix, iy); }
bool IsFull(const Cells& free, int ix, int iy) {
  return IsFree(free, ix, iy) && IsFree(free, ix + 1, iy) && IsFree(free, ix, iy + 1) &&
         IsFree(free, ix + 1, iy + 1);
}

// Whether the straight line between two places lies in full squares: each square whose inside it
// meets is full, or, along a row or column, one beside each edge. In integers.
bool Sees(const Cells& free, Cell a, Cell b) {
  const int x0 = std::min(a.ix, b.ix), x1 = std::max(a.ix, b.ix);
  const int y0 = std::min(a.iy, b.iy), y1 = std::max(a.iy, b.iy);
  if (x0 == x1) {
    for (int y = y0; y < y1; ++y)
      if (!IsFull(free, x0 - 1, y) && !IsFull(free, x0, y)) return false;
    return true;
  }
  if (y0 == y1) {
    for (int x = x0; x < x1; ++x)
      if (!IsFull(free, x, y0 - 1) && !IsFull(free, x, y0)) return false;
    return true;
  }
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      bool left = false, right = false;
      for (const Cell c : {Cell{x, y}, Cell{x + 1, y}, Cell{x, y + 1}, Cell{x + 1, y + 1}}) {
        const int cross = (b.ix - a.ix) * (c.iy - a.iy) - (b.iy - a.iy) * (c.ix - a.ix);
        left |= cross > 0, right |= cross < 0;
      }
      if (left && right && !IsFull(free, x, y)) return false;
    }
  return true;
}

// The length of a step to one of the 8 neighbours that full squares do not make, or kNone.
double ThinStep(const Cells& free, Cell a, Cell b) {
  const int dx = b.ix - a.ix, dy = b.iy - a.iy;
  if (std::max(std::abs(dx), std::abs(dy)) != 1 || !IsFree(free, b.ix, b.iy)) return kNone;
  if (dx == 0 || dy == 0) return Sees(free, a, b) ? kNone : 1;
  if (Sees(free, a, b)) return kNone;
  for (const Cell c : {Cell{a.ix, b.iy}, Cell{b.ix, a.iy}})
    if (IsFree(free, c.ix, c.iy) && Sees(free, a, c) && Sees(free, c, b)) return kNone;
  return std::numbers::sqrt2;
}

// Of a leg of a path; kNone: it is not free.
double LegLength(const Cells& free, Cell a, Cell b) {
  if (Sees(free, a, b)) return std::hypot(b.ix - a.ix, b.iy - a.iy);
  // Thin steps in one line are one leg.
  const int dx = b.ix - a.ix, dy = b.iy - a.iy, n = std::max(std::abs(dx), std::abs(dy));
  if (dx % n != 0 || dy % n != 0) return kNone;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const Cell c{a.ix + dx / n * i, a.iy + dy / n * i}, d{c.ix + dx / n, c.iy + dy / n};
    sum += Sees(free, c, d) ? std::hypot(dx / n, dy / n) : ThinStep(free, c, d);
  }
  return sum;
}

// Dijkstra's search over all places, from each to those that `length` gives a length to.
Grid<double> ByDijkstra(const Cells& free, Cell source,
                        const std::function<double(Cell, Cell)>& length) {
  Grid<double> distance(free.width, free.height, kNone);
  std::vector<std::uint8_t> done(free.cells.size(), 0);
  distance(source) = 0;
  for (;;) {
    std::size_t best = free.cells.size();
    for (std::size_t i = 0; i < free.cells.size(); ++i)
      if (!done[i] && distance.cells[i] < (best < done.size() ? distance.cells[best] : kNone))
        best = i;
    if (best == free.cells.size()) return distance;
    done[best] = 1;
    const Cell at = CellAt(free, best);
    for (std::size_t i = 0; i < free.cells.size(); ++i) {
      const Cell to = CellAt(free, i);
      const double straight = std::hypot(to.ix - at.ix, to.iy - at.iy);
      if (!free.cells[i] || done[i] || distance.cells[best] + straight >= distance.cells[i])
        continue;
      distance.cells[i] = std::min(distance.cells[i], distance.cells[best] + length(at, to));
    }
  }
}

// The truth: the visibility graph of all places.
Grid<double> Exact(const Cells& free, Cell source) {
  return ByDijkstra(free, source, [&](Cell a, Cell b) {
    return Sees(free, a, b) ? std::hypot(b.ix - a.ix, b.iy - a.iy) : ThinStep(free, a, b);
  });
}

struct Dut {
  explicit Dut(const Cells& free) : floor(free), field(floor) {}
  AnyAngleFloor floor;
  AnyAngleField field;
};

std::vector<double> Distances(const Cells& free, Cell source) {
  Dut dut(free);
  dut.field.From(source);
  std::vector<double> distances;
  for (std::size_t i = 0; i < free.cells.size(); ++i)
    distances.push_back(dut.field.DistanceTo(CellAt(free, i)));
  return distances;
}

void ExpectEqual(double a, double b, const std::string& where) {
  if (std::isinf(a) || std::isinf(b)) {
    EXPECT_EQ(a, b) << where;
    return;
  }
  EXPECT_NEAR(a, b, 1e-4) << where;
}

// A floor of one of five kinds and a source; enough of them hold all that can happen.
template <class Check>
void OnFloors(const char* name, int count, int side, const Check& check) {
  Stream random(1, 0, name);
  for (int i = 0; i < count; ++i) {
    const int width = 4 + Below(random, side - 3), height = 4 + Below(random, side - 3);
    const Cells free = Mixed(random, i, width, height);
    if (std::count(free.cells.begin(), free.cells.end(), 1) == 0) continue;
    const Cell source = RandomFree(random, free);
    check(free, source, "floor " + std::to_string(i));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(AnyAngleField, DistancesAreThoseOfTheVisibilityGraph) {
  int places = 0;
  const auto check = [&](const Cells& free, Cell source, const std::string& where) {
    const Grid<double> truth = Exact(free, source);
    const std::vector<double> distances = Distances(free, source);
    for (std::size_t i = 0; i < distances.size(); ++i)
      ExpectEqual(distances[i], truth.cells[i], where);
    places += static_cast<int>(distances.size());
  };
  OnFloors("small", 400, 17, check);
  OnFloors("large", 10, 40, check);
  EXPECT_GT(places, 30'000);
}

TEST(AnyAngleField, TheStraightLineIsFoundExactlyWhereTwoCellsSeeEachOther) {
  int straight = 0, turned = 0;
  OnFloors("sight", 60, 40, [&](const Cells& free, Cell source, const std::string& where) {
    const std::vector<double> distances = Distances(free, source);
    for (std::size_t i = 0; i < distances.size(); ++i) {
      const Cell c = CellAt(free, i);
      if (!free(c)) continue;
      const double line = std::hypot(c.ix - source.ix, c.iy - source.iy);
      if (Sees(free, source, c)) {
        EXPECT_NEAR(distances[i], line, 1e-9) << where;
        ++straight;
      } else if (std::abs(distances[i] - line) < 1e-9) {
        EXPECT_LT(LegLength(free, source, c), kNone) << where;
      } else {
        ++turned;
      }
    }
  });
  EXPECT_GT(straight, 1000);
  EXPECT_GT(turned, 1000);
}

TEST(AnyAngleField, TheWayBackIsAsLong) {
  Stream random(3, 0, "back");
  for (int kind = 0; kind < 5; ++kind) {
    const Cells free = Mixed(random, kind, 150, 110);
    Dut dut(free);
    std::vector<Cell> ends;
    for (int i = 0; i < 20; ++i) ends.push_back(RandomFree(random, free));
    std::vector<std::vector<double>> distance;
    for (const Cell a : ends) {
      dut.field.From(a);
      distance.emplace_back();
      for (const Cell b : ends) distance.back().push_back(dut.field.DistanceTo(b));
    }
    for (std::size_t i = 0; i < ends.size(); ++i) {
      EXPECT_EQ(distance[i][i], 0);
      for (std::size_t j = 0; j < i; ++j)
        ExpectEqual(distance[i][j], distance[j][i], "floor " + std::to_string(kind));
    }
  }
}

TEST(AnyAngleField, AllIsReachedThatEightNeighboursConnectAndForNoMore) {
  OnFloors("steps", 100, 30, [&](const Cells& free, Cell source, const std::string& where) {
    const auto is_step = [](Cell a, Cell b) {
      return std::max(std::abs(a.ix - b.ix), std::abs(a.iy - b.iy)) == 1;
    };
    const Grid<double> connected =
        ByDijkstra(free, source, [&](Cell a, Cell b) { return is_step(a, b) ? 2 : kNone; });
    const Grid<double> steps = ByDijkstra(free, source, [&](Cell a, Cell b) {
      if (!is_step(a, b)) return kNone;
      return Sees(free, a, b) ? std::hypot(a.ix - b.ix, a.iy - b.iy) : ThinStep(free, a, b);
    });
    const std::vector<double> distances = Distances(free, source);
    for (std::size_t i = 0; i < distances.size(); ++i) {
      EXPECT_EQ(std::isinf(distances[i]), std::isinf(connected.cells[i])) << where;
      if (std::isinf(distances[i])) continue;
      EXPECT_LE(distances[i], steps.cells[i] + 1e-4) << where;
    }
  });
}

TEST(AnyAngleField, MirroredAndTurnedFloorsGiveTheSameDistances) {
  OnFloors("mirrors", 60, 60, [&](const Cells& free, Cell source, const std::string& where) {
    const std::vector<double> distances = Distances(free, source);
    Cells mirrored(free.width, free.height), turned(free.height, free.width);
    for (int iy = 0; iy < free.height; ++iy)
      for (int ix = 0; ix < free.width; ++ix) {
        mirrored(free.width - 1 - ix, iy) = free(ix, iy);
        turned(free.height - 1 - iy, ix) = free(ix, iy);
      }
    const std::vector<double> of_mirrored =
        Distances(mirrored, {free.width - 1 - source.ix, source.iy});
    const std::vector<double> of_turned =
        Distances(turned, {free.height - 1 - source.iy, source.ix});
    for (int iy = 0; iy < free.height; ++iy)
      for (int ix = 0; ix < free.width; ++ix) {
        const double distance = distances[free.Index(ix, iy)];
        ExpectEqual(distance, of_mirrored[free.Index(free.width - 1 - ix, iy)], where);
        ExpectEqual(distance, of_turned[turned.Index(free.height - 1 - iy, ix)], where);
      }
  });
}

TEST(AnyAngleField, PathsAreFreeAndAsLongAsTheDistances) {
  int turns = 0;
  OnFloors("paths", 80, 40, [&](const Cells& free, Cell source, const std::string& where) {
    Dut dut(free);
    dut.field.From(source);
    for (std::size_t i = 0; i < free.cells.size(); ++i) {
      const Cell c = CellAt(free, i);
      const std::vector<Cell> path = dut.field.PathTo(c);
      ASSERT_EQ(path.empty(), std::isinf(dut.field.DistanceTo(c))) << where;
      if (path.empty()) continue;
      EXPECT_EQ(path.front(), source) << where;
      EXPECT_EQ(path.back(), c) << where;
      double length = 0;
      for (std::size_t k = 1; k < path.size(); ++k) length += LegLength(free, path[k - 1], path[k]);
      EXPECT_NEAR(length, dut.field.DistanceTo(c), 1e-9) << where;
      turns += static_cast<int>(path.size());
    }
  });
  EXPECT_GT(turns, 100'000);
}

TEST(AnyAngleField, SearchesLeaveNothingBehind) {
  Stream random(4, 0, "again");
  const Cells free = Rooms(random, 90, 70);
  Dut dut(free);
  const Cell a = RandomFree(random, free), b = RandomFree(random, free);
  dut.field.From(a);
  dut.field.From(b);
  const std::size_t bytes = dut.field.bytes();
  const std::vector<double> from_a = Distances(free, a);
  for (int i = 0; i < 3; ++i) {
    dut.field.From(a);
    for (std::size_t k = 0; k < from_a.size(); ++k)
      ASSERT_EQ(dut.field.DistanceTo(CellAt(free, k)), from_a[k]);
    dut.field.From(b);
  }
  EXPECT_EQ(dut.field.bytes(), bytes) << "the memory is reused";
}

TEST(AnyAngleField, TheWayRoundAPillarTouchesItsSquares) {
  Cells free(13, 9, 1);
  free(6, 4) = 0;  // its squares reach from 5 to 7 and from 3 to 5
  Dut dut(free);
  EXPECT_EQ(dut.field.DistanceTo({0, 0}), kNone) << "before a search";
  dut.field.From({1, 4});
  EXPECT_NEAR(dut.field.DistanceTo({11, 4}), 2 * std::hypot(4, 1) + 2, 1e-12);
  const std::vector<Cell> path = dut.field.PathTo({11, 4});
  ASSERT_EQ(path.size(), 4u);
  EXPECT_EQ(path[1].ix, 5);
  EXPECT_EQ(path[2].ix, 7);
  EXPECT_EQ(path[1].iy, path[2].iy);
  EXPECT_EQ(dut.field.PathTo({1, 4}), (std::vector<Cell>{{1, 4}}));
  for (const Cell none : {Cell{6, 4}, Cell{-1, 0}, Cell{13, 0}, Cell{0, 9}}) {
    EXPECT_EQ(dut.field.DistanceTo(none), kNone);
    EXPECT_TRUE(dut.field.PathTo(none).empty());
  }
  for (const Cell none : {Cell{6, 4}, Cell{0, -1}}) {
    dut.field.From(none);
    EXPECT_EQ(dut.field.DistanceTo({1, 4}), kNone) << "from nowhere";
  }
}

TEST(AnyAngleField, CorridorsOfOneCellAreWalkedStepByStep) {
  // Two rooms, and between them a corridor that turns diagonally.
  Cells free(12, 8);
  Fill(free, 0, 0, 3, 3, 1);
  Fill(free, 9, 5, 3, 3, 1);
  for (const Cell c : {Cell{3, 2}, {4, 2}, {5, 3}, {6, 4}, {7, 5}, {8, 5}}) free(c) = 1;
  Dut dut(free);
  dut.field.From({0, 0});
  // A diagonal step leads in, three lead up, and the way out is open to all directions.
  const double in = std::hypot(2, 1) + std::numbers::sqrt2, up = 3 * std::numbers::sqrt2;
  EXPECT_NEAR(dut.field.DistanceTo({9, 5}), in + 1 + up + 2, 1e-12);
  EXPECT_NEAR(dut.field.DistanceTo({11, 6}), in + 1 + up + 2 + std::hypot(2, 1), 1e-12);
  EXPECT_EQ(dut.field.PathTo({11, 6}),
            (std::vector<Cell>{{0, 0}, {2, 1}, {3, 2}, {4, 2}, {7, 5}, {9, 5}, {11, 6}}));
}

TEST(AnyAngleField, FloorsTooThinForASquareAreSearchedToo) {
  const Cells row(7, 1, 1), column(1, 5, 1), cell(1, 1, 1);
  EXPECT_EQ(Distances(row, {2, 0}), (std::vector<double>{2, 1, 0, 1, 2, 3, 4}));
  EXPECT_EQ(Distances(column, {0, 4}), (std::vector<double>{4, 3, 2, 1, 0}));
  EXPECT_EQ(Distances(cell, {0, 0}), (std::vector<double>{0}));
  EXPECT_TRUE(Distances(Cells(), {0, 0}).empty());
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/walk/cover_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <queue>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "base/streams.h"

namespace floorproof {
namespace {

// A visit of terrain counts as a step more: it is crossed straight.
void CountTerrainTwice(CoverWalkProblem& problem) {
  problem.more_steps = Grid<double>(problem.terrain.width, problem.terrain.height);
  for (std::size_t i = 0; i < problem.terrain.cells.size(); ++i)
    problem.more_steps.cells[i] = problem.terrain.cells[i] != 0;
}

// '.' to be visited, 'o' open but not wanted, '~' terrain, 'T' terrain to be visited, '#' closed;
// 'S' and 'E' start and end, to be visited. The top row first.
CoverWalkProblem Draw(const std::string& map) {
  std::vector<std::string> rows;
  std::istringstream lines(map);
  for (std::string row; lines >> row;) rows.insert(rows.begin(), row);
  CoverWalkProblem problem;
  const int w = static_cast<int>(rows[0].size()), h = static_cast<int>(rows.size());
  problem.open = problem.required = problem.terrain = Grid<std::uint8_t>(w, h);
  problem.cost = Grid<double>(w, h, 1.0);
  for (int iy = 0; iy < h; ++iy)
    for (int ix = 0; ix < w; ++ix) {
      const char c = rows[static_cast<std::size_t>(iy)][static_cast<std::size_t>(ix)];
      problem.open(ix, iy) = c != '#';
      problem.required(ix, iy) = c == '.' || c == 'T' || c == 'S' || c == 'E';
      problem.terrain(ix, iy) = c == '~' || c == 'T';
      if (c == 'S') problem.start = {ix, iy};
      if (c == 'E') problem.end = Cell{ix, iy};
    }
  CountTerrainTwice(problem);
  return problem;
}

int Crossings(const CoverWalkProblem& problem, const std::vector<Cell>& walk) {
  int crossings = 0;
  for (std::size_t i = 0; i < walk.size(); ++i)
    if (problem.terrain(walk[i]) && (i == 0 || !problem.terrain(walk[i - 1]))) ++crossings;
  return crossings;
}

double Cost(const CoverWalkProblem& problem, const std::vector<Cell>& walk) {
  double cost = 0;
  for (const Cell c : walk) cost += problem.cost(c);
  return cost;
}

std::int64_t Steps(const CoverWalk& walk) {
  return static_cast<std::int64_t>(walk.cells.size()) - 1;
}

void ExpectSolves(const CoverWalk& walk, const CoverWalkProblem& problem) {
  ASSERT_FALSE(walk.cells.empty());
  EXPECT_FALSE(walk.unreachable);
  EXPECT_EQ(walk.cells.front(), problem.start);
  if (problem.end) {
    EXPECT_EQ(walk.cells.back(), *problem.end);
  }
  Grid<std::uint8_t> left = problem.required;
  for (std::size_t i = 0; i < walk.cells.size(); ++i) {
    const Cell c = walk.cells[i];
    ASSERT_TRUE(problem.open.Inside(c) && problem.open(c)) << c.ix << ' ' << c.iy;
    left(c) = 0;
    if (i == 0) continue;
    const Cell before = walk.cells[i - 1];
    EXPECT_EQ(std::abs(c.ix - before.ix) + std::abs(c.iy - before.iy), 1);
  }
  EXPECT_EQ(std::count(left.cells.begin(), left.cells.end(), 1), 0);
  EXPECT_EQ(walk.crossings, Crossings(problem, walk.cells));
}

// A w x h floor with closed cells, terrain and cells that are not wanted, strewn.
CoverWalkProblem Strewn(int w, int h, std::uint64_t seed) {
  Stream random(seed, 0, "cover_walk_test");
  CoverWalkProblem problem;
  problem.open = problem.required = problem.terrain = Grid<std::uint8_t>(w, h);
  problem.cost = Grid<double>(w, h);
  const double open = random.Uniform(0.6, 1), wanted = random.Uniform(0.5, 1),
               terrain = random.Below(2) ? random.Uniform(0, 0.4) : 0,
               ratio = random.Below(2) ? 1.2 : 10;
  const bool terrain_too = random.Below(3) == 0;
  for (std::size_t i = 0; i < problem.open.cells.size(); ++i) {
    problem.cost.cells[i] = std::pow(ratio, random.Uniform());
    problem.open.cells[i] = random.Uniform() < open;
    problem.terrain.cells[i] = random.Uniform() < terrain;
    problem.required.cells[i] = problem.open.cells[i] && random.Uniform() < wanted &&
                                (terrain_too || !problem.terrain.cells[i]);
  }
  CountTerrainTwice(problem);
  const auto draw = [&] {
    const Cell c{static_cast<int>(random.Below(static_cast<std::uint64_t>(w))),
                 static_cast<int>(random.Below(static_cast<std::uint64_t>(h)))};
    problem.open(c) = 1;
    return c;
  };
  problem.start = draw();
  const auto end = random.Below(3);  // anywhere, somewhere, the start
  if (end > 0) problem.end = end == 1 ? draw() : problem.start;
  return problem;
}

// Obstacles of one to four cells, terrain across the floor with gaps and without.
CoverWalkProblem Hall(int size, std::uint64_t seed) {
  Stream random(seed, 0, "hall");
  const auto below = [&random](int n) {
    return static_cast<int>(random.Below(static_cast<std::uint64_t>(n)));
  };
  CoverWalkProblem problem;
  problem.open = problem.required = Grid<std::uint8_t>(size, size, 1);
  problem.terrain = Grid<std::uint8_t>(size, size);
  problem.cost = Grid<double>(size, size);
  for (double& cost : problem.cost.cells) cost = random.Uniform(1, 1.2);
  for (int strip = 0; strip < 3; ++strip) {
    const bool upright = below(2) == 0;
    const int at = 2 + below(size - 4), gap = strip == 0 ? size : below(size);
    for (int i = 0; i < size; ++i) {
      const Cell c = upright ? Cell{at, i} : Cell{i, at};
      if (std::abs(i - gap) > 3) problem.terrain(c) = 1, problem.required(c) = 0;
    }
  }
  for (int k = 0; k < size * size / 100; ++k) {
    Cell c{1 + below(size - 2), 1 + below(size - 2)};
    for (int cells = 1 + below(4); cells > 0 && problem.open.Inside(c); --cells) {
      problem.open(c) = problem.required(c) = 0;
      (below(2) ? c.ix : c.iy) += 1;
    }
  }
  problem.start = {0, 0};
  problem.open(problem.start) = 1;
  CountTerrainTwice(problem);
  const CoverWalk reached = ShortCoverWalk(problem, {.effort = 0});
  if (reached.unreachable) return Hall(size, seed + 1000);
  return problem;
}

// The least (crossings, weight) of all walks, by Dijkstra over (cell, what has been visited).
using Least = std::pair<int, double>;
std::optional<Least> Exhaust(const CoverWalkProblem& problem, const CoverWalkOptions& options,
                             bool count_crossings = true) {
  const std::size_t n = problem.open.cells.size();
  std::vector<std::size_t> bit(n);  // by cell: of those visited
  std::size_t bits = 0;
  double mean = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (problem.required.cells[i]) bit[i] = std::size_t{1} << bits++, mean += problem.cost.cells[i];
  mean = bits > 0 ? mean / static_cast<double>(bits) : 1;
  const auto weight = [&](std::size_t i) {
    return 1 - options.cost_share + options.cost_share * problem.cost.cells[i] / mean +
           problem.more_steps.cells[i];
  };
  const std::size_t all = (std::size_t{1} << bits) - 1;
  using Open = std::tuple<int, double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  std::vector<Least> best(n * (all + 1), {1000, 0});
  const auto reach = [&](std::size_t cell, std::size_t visited, Least least) {
    Least& known = best[cell * (all + 1) + visited];
    if (known <= least) return;
    known = least;
    open.push({least.first, least.second, cell * (all + 1) + visited});
  };
  const std::size_t start = problem.open.Index(problem.start.ix, problem.start.iy);
  reach(start, bit[start], {count_crossings && problem.terrain.cells[start], weight(start)});
  while (!open.empty()) {
    const auto [crossings, sum, state] = open.top();
    open.pop();
    if (best[state] < Least{crossings, sum}) continue;
    const std::size_t cell = state / (all + 1), visited = state % (all + 1);
    const auto width = static_cast<std::size_t>(problem.open.width);
    const Cell at{static_cast<int>(cell % width), static_cast<int>(cell / width)};
    if (visited == all && (!problem.end || at == *problem.end)) return Least{crossings, sum};
    for (const Cell d : {Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}}) {
      const Cell to{at.ix + d.ix, at.iy + d.iy};
      if (!problem.open.Inside(to) || !problem.open(to)) continue;
      const bool crosses = count_crossings && problem.terrain(to) && !problem.terrain(at);
      const std::size_t next = problem.open.Index(to.ix, to.iy);
      reach(next, visited | bit[next], {crossings + crosses, sum + weight(next)});
    }
  }
  return std::nullopt;
}

double Weight(const CoverWalkProblem& problem, const CoverWalkOptions& options,
              const CoverWalk& walk) {
  double mean = 0, wanted = 0, sum = 0;
  for (std::size_t i = 0; i < problem.required.cells.size(); ++i)
    if (problem.required.cells[i]) mean += problem.cost.cells[i], ++wanted;
  mean = wanted > 0 ? mean / wanted : 1;
  for (const Cell c : walk.cells)
    sum += 1 - options.cost_share + options.cost_share * problem.cost(c) / mean +
           problem.more_steps(c);
  return sum;
}

TEST(CoverWalk, OnSmallFloorsNoWalkIsBetter) {
  int solved = 0, not_to_be_done = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    Stream random(seed, 0, "size");
    const int w = 1 + static_cast<int>(random.Below(4)), h = 1 + static_cast<int>(random.Below(3));
    const CoverWalkProblem problem = Strewn(w, h, seed);
    CoverWalkOptions options;
    options.effort = 0.1;
    options.cost_share = random.Uniform();
    const CoverWalk dut = ShortCoverWalk(problem, options);
    const auto least = Exhaust(problem, options);
    ASSERT_EQ(dut.cells.empty(), !least);
    ASSERT_EQ(dut.unreachable.has_value(), !least);
    ++(least ? solved : not_to_be_done);
    if (!least) continue;
    ExpectSolves(dut, problem);
    EXPECT_EQ(dut.crossings, least->first);
    EXPECT_NEAR(Weight(problem, options, dut), least->second, 1e-3);
  }
  EXPECT_GT(solved, 100);
  EXPECT_GT(not_to_be_done, 5);
}

TEST(CoverWalk, OnAWideFloorFewCellsAreVisitedInTheBestOrderOnTheBestWays) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    SCOPED_TRACE(seed);
    Stream random(seed, 0, "few");
    CoverWalkProblem problem = Hall(24, seed);
    for (double& cost : problem.cost.cells) cost = std::pow(10, random.Uniform());
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < problem.required.cells.size(); ++i)
      if (std::exchange(problem.required.cells[i], std::uint8_t{0})) wanted.push_back(i);
    for (int k = 0; k < 6; ++k) problem.required.cells[wanted[random.Below(wanted.size())]] = 1;
    const CoverWalkOptions options;
    const CoverWalk dut = ShortCoverWalk(problem, options);
    ExpectSolves(dut, problem);
    const auto least = Exhaust(problem, options);
    EXPECT_EQ(dut.crossings, least->first);
    EXPECT_NEAR(Weight(problem, options, dut), least->second, 1e-2);
  }
}

TEST(CoverWalk, NoWalkIsBelowTheBound) {
  int tight = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    CoverWalkProblem problem = Strewn(4, 3, seed);
    std::ranges::fill(problem.more_steps.cells, 0);
    const auto steps = Exhaust(problem, {.cost_share = 0}, false);
    if (!steps) continue;
    const auto cost = Exhaust(problem, {.cost_share = 1}, false);
    double mean = 0, wanted = 0;
    for (std::size_t i = 0; i < problem.required.cells.size(); ++i)
      if (problem.required.cells[i]) mean += problem.cost.cells[i], ++wanted;
    mean = wanted > 0 ? mean / wanted : 1;
    const CoverWalkBound dut = BoundCoverWalk(problem);
    EXPECT_LE(static_cast<double>(dut.steps), steps->second - 1 + 1e-9);
    EXPECT_LE(dut.cost, cost->second * mean + 1e-9);
    tight += static_cast<double>(dut.steps) > steps->second - 1 - 1e-9;
  }
  EXPECT_GT(tight, 50);
}

TEST(CoverWalk, ATreeIsDrivenTwiceButForTheLongestWay) {
  const CoverWalkProblem problem = Draw(R"(
    .#.#...
    .#.#.#.
    S....#.)");
  const CoverWalk dut = ShortCoverWalk(problem);
  ExpectSolves(dut, problem);
  EXPECT_EQ(Steps(dut), 2 * 14 - 10);
  EXPECT_EQ(BoundCoverWalk(problem).steps, Steps(dut));
}

TEST(CoverWalk, ALargeTreeNeedsNoSearch) {
  CoverWalkProblem comb = Draw("S");
  comb.open = Grid<std::uint8_t>(201, 40);
  comb.terrain = comb.open;
  comb.cost = Grid<double>(201, 40, 1.0);
  for (int ix = 0; ix < 201; ++ix)
    for (int iy = 0; iy < (ix % 2 ? 1 : 40 - ix % 7); ++iy) comb.open(ix, iy) = 1;
  comb.required = comb.open;
  CountTerrainTwice(comb);
  const CoverWalk dut = ShortCoverWalk(comb, {.effort = 0});
  ExpectSolves(dut, comb);
  EXPECT_EQ(Steps(dut), BoundCoverWalk(comb).steps);
}

TEST(CoverWalk, OneCell) {
  for (const bool closed : {false, true}) {
    CoverWalkProblem problem = Draw("S");
    if (closed) problem.end = problem.start;
    const CoverWalk dut = ShortCoverWalk(problem);
    EXPECT_EQ(dut.cells, std::vector<Cell>{problem.start});
    EXPECT_EQ(BoundCoverWalk(problem).steps, 0);
  }
}

TEST(CoverWalk, InACorridorTheShortArmIsDrivenTwice) {
  const CoverWalkProblem problem = Draw("...S.......");
  const CoverWalk dut = ShortCoverWalk(problem);
  ExpectSolves(dut, problem);
  EXPECT_EQ(Steps(dut), 3 + 3 + 7);
  EXPECT_EQ(dut.cells.back(), (Cell{10, 0}));
}

TEST(CoverWalk, WithAFixedEndItDrivesTheOtherArmTwice) {
  const CoverWalkProblem problem = Draw("E..S.......");
  const CoverWalk dut = ShortCoverWalk(problem);
  ExpectSolves(dut, problem);
  EXPECT_EQ(Steps(dut), 7 + 7 + 3);
}

TEST(CoverWalk, AnEvenRectangleIsClosedWithoutAStepTooMany) {
  CoverWalkProblem problem = Draw("......\n......\n......\n..S...");
  problem.end = problem.start;
  const CoverWalk dut = ShortCoverWalk(problem);
  ExpectSolves(dut, problem);
  EXPECT_EQ(Steps(dut), 24);
}

TEST(CoverWalk, FloorsAreMadeWhole) {
  // What the chessboard's colours alone ask for: 13 black cells and 12 white ones.
  const CoverWalkProblem corner = Draw("S....\n.....\n.....\n.....\n.....");
  EXPECT_EQ(Steps(ShortCoverWalk(corner)), 24);
  const CoverWalkProblem beside = Draw(".S...\n.....\n.....\n.....\n.....");
  EXPECT_EQ(Steps(ShortCoverWalk(beside)), 25);
}

TEST(CoverWalk, WeighsCostAgainstSteps) {
  // A short way to the other side, and a long one that is cheap.
  CoverWalkProblem problem = Draw(R"(
    oooooo
    o####o
    o####o
    S####.
    oooooo)");
  for (int ix = 0; ix < 6; ++ix) problem.cost(ix, 0) = 3;
  const CoverWalk cheap = ShortCoverWalk(problem, {.cost_share = 1});
  EXPECT_EQ(Steps(cheap), 11);
  EXPECT_EQ(Cost(problem, cheap.cells), 12);
  const CoverWalk brief = ShortCoverWalk(problem, {.cost_share = 0});
  EXPECT_EQ(Steps(brief), 7);
  EXPECT_EQ(Cost(problem, brief.cells), 20);
}

TEST(CoverWalk, AStripIsCrossedOnceOrToAndFro) {
  const auto crossings = [](const std::string& map) {
    const CoverWalkProblem problem = Draw(map);
    const CoverWalk dut = ShortCoverWalk(problem);
    ExpectSolves(dut, problem);
    return dut.crossings;
  };
  EXPECT_EQ(crossings("S....~.....\n.....~....E\n.....~....."), 1);
  EXPECT_EQ(crossings("S....~.....\n.....~.....\n....E~....."), 2);
  EXPECT_EQ(crossings("S....~.....\n.....~.....\n.....~....."), 1);  // ends anywhere
  EXPECT_EQ(crossings("S....~.....\n.....~....E\n..........."), 0);  // a gap
  EXPECT_EQ(crossings("S....~.....~...\n.....~.....~...\n.....~.....~..E"), 2);
  EXPECT_EQ(crossings("S....~.....~...\n.....~....E~...\n.....~.....~..."), 3);
  EXPECT_EQ(crossings(".....~..S..~...\n.....~.....~...\n.....~.....~..."), 3);
  EXPECT_EQ(crossings("...~...\n.S.~...\n~~~~~~~\n...~...\n...~.E."), 3);  // round the middle
}

// Rooms of 15 x 15 cells with terrain between; `posts`: closed where four rooms meet.
CoverWalkProblem Rooms(int nx, int ny, bool posts, Cell start_room) {
  constexpr int kPitch = 16;
  CoverWalkProblem problem;
  problem.open = problem.required = Grid<std::uint8_t>(nx * kPitch - 1, ny * kPitch - 1, 1);
  problem.terrain = Grid<std::uint8_t>(problem.open.width, problem.open.height);
  problem.cost = Grid<double>(problem.open.width, problem.open.height, 1.0);
  for (int iy = 0; iy < problem.open.height; ++iy)
    for (int ix = 0; ix < problem.open.width; ++ix) {
      const bool x = (ix + 1) % kPitch == 0, y = (iy + 1) % kPitch == 0;
      problem.terrain(ix, iy) = x || y;
      problem.required(ix, iy) = !x && !y;
      problem.open(ix, iy) = !(x && y && posts);
    }
  CountTerrainTwice(problem);
  problem.start = {start_room.ix * kPitch + 7, start_room.iy * kPitch + 7};
  return problem;
}

TEST(CoverWalk, RoomsAreVisitedInAnOrderWithFewCrossings) {
  const auto crossings = [](CoverWalkProblem problem, std::optional<Cell> end_room) {
    if (end_room) problem.end = Cell{end_room->ix * 16 + 2, end_room->iy * 16 + 9};
    // No search over the cells could mend a bad order of the rooms, had they many.
    const CoverWalk dut = ShortCoverWalk(problem, {.effort = 0});
    ExpectSolves(dut, problem);
    return dut.crossings;
  };
  EXPECT_EQ(crossings(Rooms(6, 1, false, {1, 0}), {}), 1 + 5);  // the short side first
  EXPECT_EQ(crossings(Rooms(6, 1, false, {4, 0}), {}), 1 + 5);
  EXPECT_EQ(crossings(Rooms(6, 1, false, {1, 0}), Cell{0, 0}), 4 + 5);
  EXPECT_EQ(crossings(Rooms(4, 4, true, {0, 0}), {}), 15);
  EXPECT_EQ(crossings(Rooms(4, 4, true, {1, 1}), Cell{1, 2}), 15);
  EXPECT_EQ(crossings(Rooms(4, 4, true, {1, 1}), Cell{1, 1}), 16);
  // The chessboard again: five rooms black, four white, and it begins on a white one.
  EXPECT_EQ(crossings(Rooms(3, 3, true, {1, 0}), {}), 9);
  // Neighbours with a wall between: from the middle below first to the left, then round by the
  // right.
  CoverWalkProblem walled = Rooms(3, 2, true, {1, 0});
  for (int ix = 0; ix < 15; ++ix) walled.open(ix, 15) = 0;
  EXPECT_EQ(crossings(walled, {}), 1 + 2 + 3);
}

TEST(CoverWalk, RoomsAreLeftWhereTheNextOneIsComeTo) {
  const CoverWalkProblem problem = Rooms(4, 4, true, {0, 0});
  const CoverWalk dut = ShortCoverWalk(problem, {.effort = 0});
  ExpectSolves(dut, problem);
  // A step of terrain at each crossing, and few more.
  const auto wanted = std::count(problem.required.cells.begin(), problem.required.cells.end(), 1);
  EXPECT_LE(Steps(dut), wanted - 1 + 3 * dut.crossings);
}

TEST(CoverWalk, CrossesStraightWhereItCostsLeast) {
  CoverWalkProblem problem = Draw(R"(
    S....~......
    .....~......
    .....~......
    .....~.....E
    .....~......)");
  for (int iy = 0; iy < 5; ++iy) problem.cost(5, iy) = iy == 2 ? 1.1 : 1.2;
  const CoverWalk dut = ShortCoverWalk(problem);
  ExpectSolves(dut, problem);
  std::vector<Cell> crossed;
  for (const Cell c : dut.cells)
    if (problem.terrain(c)) crossed.push_back(c);
  EXPECT_EQ(crossed, (std::vector<Cell>{{5, 2}}));
}

TEST(CoverWalk, GoesRoundTerrainThatSplitsNothing) {
  const CoverWalkProblem problem = Draw(R"(
    S........
    ...~~~...
    ...~~~...
    ...~~~...
    .........)");
  const CoverWalk dut = ShortCoverWalk(problem);
  ExpectSolves(dut, problem);
  EXPECT_EQ(dut.crossings, 0);
  EXPECT_EQ(Steps(dut), 45 - 9 - 1);
}

TEST(CoverWalk, NamesWhatCannotBeReached) {
  const CoverWalk pocket = ShortCoverWalk(Draw("S..#.\n...##"));
  EXPECT_TRUE(pocket.cells.empty());
  EXPECT_EQ(pocket.unreachable, (Cell{4, 1}));
  EXPECT_EQ(ShortCoverWalk(Draw("S..#E")).unreachable, (Cell{4, 0}));
  CoverWalkProblem problem = Draw("S..");
  problem.open(0, 0) = 0;
  EXPECT_EQ(ShortCoverWalk(problem).unreachable, (Cell{0, 0}));
  problem.start = {7, 0};
  EXPECT_EQ(ShortCoverWalk(problem).unreachable, (Cell{7, 0}));
}

TEST(CoverWalk, TheSameProblemHasTheSameWalk) {
  const CoverWalkProblem problem = Hall(30, 3);
  const CoverWalk one = ShortCoverWalk(problem), two = ShortCoverWalk(problem);
  EXPECT_EQ(one.cells, two.cells);
}

TEST(CoverWalk, MoreEffortIsNoWorse) {
  double little = 0, much = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const CoverWalkProblem problem = Hall(12, seed);
    for (const double effort : {0.0, 1.0}) {
      const CoverWalkOptions options = {.effort = effort};
      (effort > 0 ? much : little) += Weight(problem, options, ShortCoverWalk(problem, options));
    }
  }
  EXPECT_LT(much, little);
}

TEST(CoverWalk, LargeHallsAreCoveredWithFewStepsTooMany) {
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    SCOPED_TRACE(seed);
    const CoverWalkProblem problem = Hall(200, seed);
    const CoverWalk dut = ShortCoverWalk(problem, {.effort = 0.2});
    ExpectSolves(dut, problem);
    const auto wanted = std::count(problem.required.cells.begin(), problem.required.cells.end(), 1);
    EXPECT_LT(static_cast<double>(Steps(dut) - (wanted - 1)), 0.01 * static_cast<double>(wanted));
    const CoverWalkBound bound = BoundCoverWalk(problem);
    EXPECT_GE(Steps(dut), bound.steps);
    EXPECT_LT(static_cast<double>(Steps(dut)), 1.005 * static_cast<double>(bound.steps));
  }
}

TEST(CoverWalk, FloorsInVeryManyPiecesComeToAnEnd) {
  // Terrain all over, and a checked floor of which each cell is a piece.
  CoverWalkProblem checked = Draw("S");
  checked.open = checked.required = Grid<std::uint8_t>(60, 60, 1);
  checked.terrain = Grid<std::uint8_t>(60, 60);
  checked.cost = Grid<double>(60, 60, 1.0);
  for (int iy = 0; iy < 60; ++iy)
    for (int ix = 0; ix < 60; ++ix) checked.terrain(ix, iy) = (ix + iy) % 2 != 0;
  CountTerrainTwice(checked);
  ExpectSolves(ShortCoverWalk(checked, {.effort = 0.1}), checked);
  checked.required = Grid<std::uint8_t>(60, 60);
  for (std::size_t i = 0; i < checked.required.cells.size(); ++i)
    checked.required.cells[i] = !checked.terrain.cells[i];
  const CoverWalk dut = ShortCoverWalk(checked, {.effort = 0.1});
  ExpectSolves(dut, checked);
  EXPECT_EQ(dut.crossings, 1799);  // one from each of the 1800 pieces to the next
}

}  // namespace
}  // namespace floorproof

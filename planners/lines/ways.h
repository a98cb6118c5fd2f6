// SPDX-License-Identifier: Apache-2.0
// Shortest ways over a floor, and what they cost.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "planners/lines/floor.h"

namespace floorproof {

class Ways {
 public:
  explicit Ways(const Floor& floor);

  // The shortest way from a to b, both included, pulled taut. a and b are poses, or next to poses.
  Polyline Route(const Vec2& a, const Vec2& b);
  // About the length of Route(a, b), cells: exact in plain sight, over coarse cells nearby, over
  // blocks of floor from afar.
  double Distance(const Vec2& a, const Vec2& b);
  // Remembers places for NearestPlaces.
  void IndexPlaces(const std::vector<Vec2>& places);
  struct Near {
    double distance;  // as Distance()
    int place;
  };
  // About `count` places nearest to the one given, by way length, itself excluded.
  std::vector<Near> NearestPlaces(int place, std::size_t count);
  // The pose cell nearest to p within `reach` cells, or p's own; {-1, -1}: none.
  Cell NearestPose(const Vec2& p, double reach) const;

 private:
  struct Node {
    float cost = 0;
    int parent = -1;
    std::uint32_t stamp = 0;
  };
  bool Search(Cell from, Cell to, std::vector<Cell>& cells);
  double CoarseDistance(int from, int to);
  int CoarseAt(const Vec2& p) const;
  void BuildBlocks();

  const Floor& floor_;
  std::vector<Node> nodes_;  // fine cells, reused between searches
  std::uint32_t stamp_ = 0;
  std::vector<std::pair<float, int>> heap_;

  int step_ = 2;  // fine cells a coarse one
  Grid<std::uint8_t> coarse_;
  std::vector<Node> coarse_nodes_;
  std::uint32_t coarse_stamp_ = 0;
  std::int64_t coarse_budget_ = 4'000'000;  // cells to look at before the table must do

  std::array<std::vector<int>, 8> buckets_;
  std::vector<Vec2> places_;
  std::vector<int> place_cell_;                // coarse cell of each place
  std::vector<int> first_place_, place_list_;  // places by coarse cell

  int block_ = 16;               // fine cells a block
  Grid<std::int32_t> block_of_;  // per coarse cell: the connected piece of a block it is in
  std::vector<Vec2> block_at_;
  std::vector<float> block_distance_;  // all pairs
};

// Joins points by Route and returns the whole.
Polyline JoinByRoutes(Ways& ways, const std::vector<Polyline>& lines);

}  // namespace floorproof

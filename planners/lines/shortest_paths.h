// SPDX-License-Identifier: Apache-2.0
// Shortest paths over a floor, and about how long they are.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "planners/lines/floor.h"
#include "planners/search/best_first.h"
#include "planners/search/index.h"

namespace floorproof {

class ShortestPaths {
 public:
  explicit ShortestPaths(const Floor& floor);

  // The shortest path from a to b, both included, pulled taut. a and b are poses, or next to poses.
  // Empty: there is none.
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
  // About `count` places nearest to the one given, by the length of the path there, itself
  // excluded.
  std::vector<Near> NearestPlaces(int place, std::size_t count);
  // The pose cell nearest to p within `reach` cells, or p's own; {-1, -1}: none.
  Cell NearestPose(const Vec2& p, double reach) const;

 private:
  // Numbers of places, by the cell of some grid that they lie in.
  class PlacesBy {
   public:
    // cell_of: of each place.
    void Fill(std::size_t cells, const std::vector<int>& cell_of) {
      first_.assign(cells + 1, 0);
      for (const int c : cell_of) ++first_[Z(c) + 1];
      std::partial_sum(first_.begin(), first_.end(), first_.begin());
      list_.resize(cell_of.size());
      std::vector<int> next = first_;
      for (std::size_t i = 0; i < cell_of.size(); ++i)
        list_[Z(next[Z(cell_of[i])]++)] = static_cast<int>(i);
    }
    std::span<const int> Of(int cell) const {
      return std::span(list_).subspan(Z(first_[Z(cell)]), Z(first_[Z(cell) + 1] - first_[Z(cell)]));
    }

   private:
    std::vector<int> first_, list_;
  };

  static constexpr int kStraight = 5, kDiagonal = 7;  // costs of steps, for NearestPlaces

  std::vector<Cell> Search(Cell from, Cell to);
  double CoarseDistance(int from, int to);
  int CoarseAt(const Vec2& p) const;
  Cell SquareAt(const Vec2& p) const;
  std::vector<Near> NearestInSight(int place, std::size_t count, bool& hidden) const;
  void NameBlocks();
  void BuildBlocks();

  const Floor& floor_;
  BestFirstSearch<float> fine_search_;

  int step_;  // fine cells a coarse one
  Grid<std::uint8_t> coarse_;
  BestFirstSearch<float> coarse_search_;
  std::int64_t coarse_budget_ = 4'000'000;  // cells to look at before the table must do

  BestFirstSearch<int, BucketFrontier<kDiagonal + 1>> place_search_;  // over coarse cells
  std::vector<Vec2> places_;
  std::vector<int> place_cell_;  // coarse cell of each place
  double square_ = 1;            // side, cells
  Grid<char> squares_;           // their frame
  PlacesBy on_coarse_, on_squares_;

  int block_ = 16;               // fine cells a block
  Grid<std::int32_t> block_of_;  // per coarse cell: the connected piece of a block it is in
  std::vector<Vec2> block_at_;
  std::vector<float> block_distance_;  // all pairs
};

// Joins lines by Route and returns the whole.
Polyline JoinByRoutes(ShortestPaths& paths, const std::vector<Polyline>& lines);

}  // namespace floorproof

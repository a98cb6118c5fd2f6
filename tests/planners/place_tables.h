// SPDX-License-Identifier: Apache-2.0
// Places and tables of the distances between them, for tests of orders of visit.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "base/streams.h"
#include "planners/orders/visit_order.h"

namespace floorproof::testing {

struct PlaceTable {
  std::vector<Vec2> places;  // p_W (m)
  PlaceDistances distances{0};

  OrderRequest Request(bool closed, std::uint64_t seed = 0) const {
    return {distances, places, closed, seed};
  }
};

inline PlaceTable StraightTable(std::vector<Vec2> places) {
  const int n = static_cast<int>(places.size());
  PlaceTable table{std::move(places), PlaceDistances(n)};
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < a; ++b)
      table.distances.Set(a, b, (table.places[Z(a)] - table.places[Z(b)]).norm());
  return table;
}

// Anywhere in a square of 20 m.
inline PlaceTable ScatteredPlaces(int n, std::uint64_t seed) {
  Stream random(seed, 0, "scattered");
  std::vector<Vec2> places;
  for (int i = 0; i < n; ++i) {
    const double x_m = random.Uniform(0, 20), y_m = random.Uniform(0, 20);
    places.push_back({x_m, y_m});
  }
  return StraightTable(std::move(places));
}

// Within 0.3 m of the walls of a room of 8 m x 12 m, in clusters of about four.
inline PlaceTable PlacesNearWalls(int n, std::uint64_t seed) {
  Stream random(seed, 0, "near walls");
  std::vector<Vec2> places;
  double along = 0, off_m = 0;
  std::uint64_t wall = 0;
  for (int i = 0; i < n; ++i) {
    if (i % 4 == 0) along = random.Uniform(0.1, 0.9), wall = random.Below(4);
    along += random.Uniform(-0.04, 0.04);
    off_m = random.Uniform(0, 0.3);
    const double x_m[] = {off_m, 8 - off_m, 8 * along, 8 * along};
    const double y_m[] = {12 * along, 12 * along, off_m, 12 - off_m};
    places.push_back({x_m[wall], y_m[wall]});
  }
  return StraightTable(std::move(places));
}

// Symmetric, and nothing else: not even the triangle inequality holds.
inline PlaceTable RandomTable(int n, std::uint64_t seed) {
  Stream random(seed, 0, "table");
  PlaceTable table = ScatteredPlaces(n, seed);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < a; ++b) table.distances.Set(a, b, random.Uniform(0, 10));
  return table;
}

// Ways over a grid of cells of 0.25 m, some of which are walls, in eight directions.
class WalledGrid {
 public:
  explicit WalledGrid(std::uint64_t seed) : random_(seed, 0, "walls"), is_wall_(kSide * kSide) {
    for (int wall = 0; wall < 14; ++wall) {
      const bool along_x = random_.Below(2) == 0;
      int x = Below(kSide), y = Below(kSide);
      for (int left = 5 + Below(20); left > 0 && x < kSide && y < kSide; --left) {
        is_wall_[Z(y * kSide + x)] = true;
        ++(along_x ? x : y);
      }
    }
  }

  // n free cells that the first one reaches.
  PlaceTable Places(int n) {
    std::vector<int> cells;
    std::vector<double> reached_m;
    while (static_cast<int>(cells.size()) < n) {
      const int cell = Below(kSide * kSide);
      if (is_wall_[Z(cell)]) continue;
      if (cells.empty()) reached_m = From(cell);
      if (std::isfinite(reached_m[Z(cell)])) cells.push_back(cell);
    }
    PlaceTable table{{}, PlaceDistances(n)};
    for (int a = 0; a < n; ++a) {
      table.places.push_back(kCell_m * Vec2(cells[Z(a)] % kSide, cells[Z(a)] / kSide));
      const std::vector<double> way_m = From(cells[Z(a)]);
      for (int b = 0; b < a; ++b) table.distances.Set(a, b, way_m[Z(cells[Z(b)])]);
    }
    return table;
  }

 private:
  static constexpr int kSide = 48;
  static constexpr double kCell_m = 0.25;

  int Below(int n) { return static_cast<int>(random_.Below(static_cast<std::uint64_t>(n))); }
  bool IsFree(int x, int y) const {
    return x >= 0 && y >= 0 && x < kSide && y < kSide && !is_wall_[Z(y * kSide + x)];
  }

  // Dijkstra's algorithm; corners are not cut.
  std::vector<double> From(int start) const {
    using Entry = std::pair<double, int>;
    std::vector<double> way_m(is_wall_.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    way_m[Z(start)] = 0;
    queue.push({0, start});
    while (!queue.empty()) {
      const auto [at_m, cell] = queue.top();
      queue.pop();
      if (at_m > way_m[Z(cell)]) continue;
      const int x = cell % kSide, y = cell / kSide;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (!IsFree(x + dx, y + dy) || !IsFree(x + dx, y) || !IsFree(x, y + dy)) continue;
          const int next = cell + dy * kSide + dx;
          const double next_m = at_m + kCell_m * std::hypot(dx, dy);
          if (next_m >= way_m[Z(next)]) continue;
          way_m[Z(next)] = next_m;
          queue.push({next_m, next});
        }
    }
    return way_m;
  }

  Stream random_;
  std::vector<bool> is_wall_;  // by cell
};

using Settings = std::vector<std::pair<std::string, std::string>>;

inline std::unique_ptr<VisitOrder> MakeOrder(std::string_view name, const Settings& settings = {}) {
  ConfigNode params = ConfigNode::Map();
  for (const auto& [key, value] : settings) params.Add(key, ConfigNode::Scalar(value));
  auto order = MakePlugin(VisitOrders(), name, "order");
  ReadParams(params, "order.", *order);
  return order;
}

}  // namespace floorproof::testing

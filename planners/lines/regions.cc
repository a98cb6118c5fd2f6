// SPDX-License-Identifier: Apache-2.0
// What it costs to sweep a spot by rows in direction d, per area: 1 / width for the rows, and
// link / (width * chord) for the links at their ends. The chord is the free line through the spot
// along d.
//
// (1) The directions of the walls are the candidates. (2) For each small block of floor the cost of
// each candidate is summed up. (3) Two regions of blocks are merged where one direction for both
// costs less than the rows that would end at the border between them. That is a Potts labelling by
// greedy merging, the best saving first.
// Not done: a search for doors. A border appears only where it pays.
#include "planners/lines/regions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "planners/lines/wall_directions.h"
#include "planners/search/index.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxCandidates = 2 * kMaxDirections;  // along walls and across
using Costs = std::array<double, kMaxCandidates>;

struct Block {
  Costs cost{};
  int cells = 0;
};

struct Blocks {
  int size = 1;  // cells a side
  Grid<Block> grid;
  // Cells of common border with the block to the right, and with the one above.
  Grid<int> right, above;
  int At(int ix, int iy) const { return iy / size * grid.width + ix / size; }
};

// Adds link / chord for every pose cell near a sampled line.
void AddChordCosts(const Floor& floor, double direction_rad, double link, std::size_t candidate,
                   Blocks& blocks) {
  const Vec2 along(std::cos(direction_rad), std::sin(direction_rad)), across(-along.y(), along.x());
  const double w = floor.frame.width, h = floor.frame.height;
  double u0 = 1e300, u1 = -1e300, v0 = 1e300, v1 = -1e300;
  for (const Vec2& c : {Vec2(0, 0), Vec2(w, 0), Vec2(0, h), Vec2(w, h)}) {
    u0 = std::min(u0, c.dot(along)), u1 = std::max(u1, c.dot(along));
    v0 = std::min(v0, c.dot(across)), v1 = std::max(v1, c.dot(across));
  }
  constexpr double kLineGap = 3;
  std::vector<int> run;
  for (double v = v0; v <= v1; v += kLineGap) {
    run.clear();
    const auto close = [&] {
      const double chord = static_cast<double>(run.size()) + floor.tool_width;
      for (const int b : run) blocks.grid.cells[Z(b)].cost[candidate] += kLineGap * link / chord;
      run.clear();
    };
    for (double u = u0; u <= u1; u += 1) {
      const Cell c = Floor::CellAt(u * along + v * across);
      if (floor.pose.Inside(c) && floor.pose(c)) {
        run.push_back(blocks.At(c.ix, c.iy));
      } else if (!run.empty()) {
        close();
      }
    }
    close();
  }
}

Blocks MakeBlocks(const Floor& floor) {
  Blocks blocks;
  blocks.size = std::max(2, static_cast<int>(std::lround(0.4 / floor.frame.cell_m)));
  const int w = (floor.frame.width + blocks.size - 1) / blocks.size;
  const int h = (floor.frame.height + blocks.size - 1) / blocks.size;
  blocks.grid = Grid<Block>(w, h);
  blocks.right = blocks.above = Grid<int>(w, h);
  for (int iy = 0; iy < floor.frame.height; ++iy)
    for (int ix = 0; ix < floor.frame.width; ++ix) {
      if (!floor.pose(ix, iy)) continue;
      const std::size_t b = Z(blocks.At(ix, iy));
      ++blocks.grid.cells[b].cells;
      if ((ix + 1) % blocks.size == 0) blocks.right.cells[b] += floor.pose(ix + 1, iy);
      if ((iy + 1) % blocks.size == 0) blocks.above.cells[b] += floor.pose(ix, iy + 1);
    }
  return blocks;
}

std::size_t BestOf(const Costs& cost, std::size_t n) {
  return static_cast<std::size_t>(std::min_element(cost.begin(), cost.begin() + n) - cost.begin());
}

// Regions of blocks, merged while that saves.
class Merger {
 public:
  Merger(const Blocks& blocks, std::size_t candidates, double border_cost)
      : n_(candidates), border_cost_(border_cost), parent_(blocks.grid.cells.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    cost_.reserve(parent_.size());
    for (const Block& b : blocks.grid.cells) cost_.push_back(b.cost);
    std::vector<std::size_t> direction;
    for (const Costs& cost : cost_) direction.push_back(BestOf(cost, n_));
    ForEachBorder(blocks, [&](int a, int b, int) {
      if (direction[Z(a)] == direction[Z(b)]) Join(Root(a), Root(b));
    });
    border_.resize(parent_.size());
    ForEachBorder(blocks, [&](int a, int b, int length) {
      const int p = Root(a), q = Root(b);
      if (p == q) return;
      border_[Z(p)][q] += length;
      border_[Z(q)][p] += length;
    });
  }

  void Run() {
    for (int a = 0; a < static_cast<int>(border_.size()); ++a)
      for (const auto& [b, length] : border_[Z(a)])
        if (a < b) Offer(a, b);
    while (!queue_.empty()) {
      const auto [saving, a, b] = queue_.top();
      queue_.pop();
      if (!border_[Z(a)].contains(b)) continue;  // one of them is part of another now
      if (const double now = Saving(a, b); now < saving) {
        if (now > 0) queue_.push({now, a, b});
      } else {
        Merge(a, b);
      }
    }
  }

  int Root(int a) {
    while (parent_[Z(a)] != a) a = parent_[Z(a)] = parent_[Z(parent_[Z(a)])];
    return a;
  }
  std::size_t Direction(int root) const { return BestOf(cost_[Z(root)], n_); }

 private:
  template <class Use>
  static void ForEachBorder(const Blocks& blocks, const Use& use) {
    for (int b = 0; b < static_cast<int>(blocks.grid.cells.size()); ++b) {
      if (const int length = blocks.right.cells[Z(b)]) use(b, b + 1, length);
      if (const int length = blocks.above.cells[Z(b)]) use(b, b + blocks.grid.width, length);
    }
  }
  double Saving(int a, int b) const {
    const Costs &ca = cost_[Z(a)], &cb = cost_[Z(b)];
    double apart_a = ca[0], apart_b = cb[0], together = ca[0] + cb[0];
    for (std::size_t k = 1; k < n_; ++k) {
      apart_a = std::min(apart_a, ca[k]), apart_b = std::min(apart_b, cb[k]);
      together = std::min(together, ca[k] + cb[k]);
    }
    return border_cost_ * border_[Z(a)].at(b) + apart_a + apart_b - together;
  }
  // The part's costs are the whole's.
  void Join(int whole, int part) {
    if (whole == part) return;
    parent_[Z(part)] = whole;
    for (std::size_t k = 0; k < n_; ++k) cost_[Z(whole)][k] += cost_[Z(part)][k];
  }
  void Offer(int a, int b) {
    if (const double saving = Saving(a, b); saving > 0)
      queue_.push({saving, std::min(a, b), std::max(a, b)});
  }
  // Neighbours of the smaller part alone are offered anew: what merging with the others saves is
  // looked at when their turn comes.
  void Merge(int a, int b) {
    if (border_[Z(a)].size() < border_[Z(b)].size()) std::swap(a, b);
    auto& into = border_[Z(a)];
    into.erase(b);
    border_[Z(b)].erase(a);
    Join(a, b);
    const auto from = std::exchange(border_[Z(b)], {});
    for (const auto& [c, length] : from) {
      auto& back = border_[Z(c)];
      back.erase(b);
      back[a] = into[c] += length;
      Offer(a, c);
    }
  }

  struct Offered {
    double saving;
    int a, b;
    bool operator<(const Offered& other) const {  // the greatest saving first, ties by index
      return saving != other.saving ? saving < other.saving
                                    : std::pair(a, b) > std::pair(other.a, other.b);
    }
  };

  std::size_t n_;
  double border_cost_;
  std::vector<int> parent_;
  std::vector<Costs> cost_;
  std::vector<std::map<int, double>> border_;
  std::priority_queue<Offered> queue_;
};

}  // namespace

Regions FindRegions(const Floor& floor, double link, std::optional<double> fixed_rad) {
  Regions regions;
  regions.label = Grid<std::int32_t>(floor.frame.width, floor.frame.height, -1);
  std::vector<double> candidates;
  if (fixed_rad) {
    candidates = {*fixed_rad - kPi * std::floor(*fixed_rad / kPi)};
  } else {
    const bool footprint = floor.tool.kind == Shape2::Kind::kFootprint;
    for (const double d : footprint ? std::vector<double>{0} : WallDirections(floor.margin)) {
      candidates.push_back(d);
      candidates.push_back(d + kPi / 2);
    }
  }
  Blocks blocks = MakeBlocks(floor);
  for (std::size_t k = 0; k < candidates.size(); ++k)
    AddChordCosts(floor, candidates[k], link / floor.tool_width, k, blocks);
  Merger merger(blocks, candidates.size(), 0.75 * link / floor.tool_width);
  merger.Run();

  std::map<int, std::int32_t> name;
  for (int iy = 0; iy < floor.frame.height; ++iy)
    for (int ix = 0; ix < floor.frame.width; ++ix) {
      if (!floor.pose(ix, iy)) continue;
      const int root = merger.Root(blocks.At(ix, iy));
      const auto [it, fresh] =
          name.try_emplace(root, static_cast<std::int32_t>(regions.direction_rad.size()));
      if (fresh) regions.direction_rad.push_back(candidates[merger.Direction(root)]);
      regions.label(ix, iy) = it->second;
    }
  return regions;
}

}  // namespace floorproof

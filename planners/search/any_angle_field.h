// SPDX-License-Identifier: Apache-2.0
// Shortest distances at any angle from one cell to all others, and the paths.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/search/any_angle_floor.h"
#include "planners/search/paint_row.h"

namespace floorproof {

// One search after another over a floor; the memory, 8 bytes a cell and what the turning points
// take, is kept between them. One thread uses a field, many fields may share a floor.
class AnyAngleField {
 public:
  explicit AnyAngleField(const AnyAngleFloor& floor);  // outlives it

  // Searches from a cell to all others. Nothing is in reach of a cell that is not free.
  void From(Cell source);
  // The length of the shortest path from the source, in cells; infinity: there is none, or the
  // cell lies outside, or nothing was searched yet.
  double DistanceTo(Cell c) const;
  // Where that path turns: the source first, the cell last. The source alone if that is the cell;
  // empty: there is none.
  std::vector<Cell> PathTo(Cell c) const;

  // Places that were looked at in this search, each time: what it has cost.
  std::int64_t work() const { return work_; }
  std::size_t bytes() const;  // of memory held

 private:
  static constexpr int kNone = -1;

  // A place where paths turn, or may turn.
  struct Root {
    Cell at;
    int parent;       // the root before it, or kNone
    double distance;  // from the source, cells
  };
  // What a root sees, cut by a row of places: from left * rows to right * rows beside it.
  struct Cone {
    int root;
    int rows;                                    // from the root's own, at least 0
    int up;                                      // 1 or -1: on which side of it
    double left, right;                          // slopes: cells aside for each row, left < right
    bool left_lost = false, right_lost = false;  // an end along which the root is worse, for good
  };
  enum class Kind : std::uint8_t { kSource, kThin, kCorner, kCone };
  // What waits for its turn.
  struct Entry {
    double distance;  // of the place, or at most of all that the cone reaches on its next rows
    int place;        // or the number of the cone in waiting_
    int parent;       // the root that the place was reached from
    Kind kind;
    std::int8_t sx = 0, sy = 0;  // of a corner: the quadrant that it opens,
    bool upright = false;        // bounded by the corner's column, else by its row
  };

  static bool IsLater(const Entry& a, const Entry& b);
  void Push(const Entry& entry);
  void PushCone(const Cone& cone, double distance);
  void PushCorner(int root, Cell c, int sx, int sy, bool upright);
  void PushIfThin(int root, Cell c);
  void Settle(const Entry& entry);
  void OpenSource(int root);
  void OpenCorner(int root, const Entry& entry);
  void TakeThinSteps(int root);
  void FollowRay(int root, Cell step);
  void Scan(const Cone& cone);
  void ScanBand(const Cone& cone);
  void Enter(const Cone& cone, const AnyAngleFloor::Run& run);
  void Trim(Cone cone, int x1, int x2, const PaintedRow& painted);
  PaintedRow Paint(int root, int iy, int x1, int x2);
  void Prefetch(int iy, int x1, int x2) const;
  bool MayBeBetter(const Cone& cone, double slope, int x) const;

  // Places are numbered through the blocks, row by row.
  int PlaceOf(Cell c) const { return c.iy * pitch_ * PlaceBlock::kPlaces + c.ix; }
  Cell CellOf(int place) const {
    const int row = pitch_ * PlaceBlock::kPlaces;
    return {place % row, place / row};
  }
  const float& ReachOf(int place) const {
    return blocks_[Z(place / PlaceBlock::kPlaces)].distance[place % PlaceBlock::kPlaces];
  }
  const std::int32_t& RootOf(int place) const {
    return blocks_[Z(place / PlaceBlock::kPlaces)].root[place % PlaceBlock::kPlaces];
  }
  void Reach(int place, double distance, int root) {
    PlaceBlock& block = blocks_[Z(place / PlaceBlock::kPlaces)];
    block.distance[place % PlaceBlock::kPlaces] = static_cast<float>(distance);
    block.root[place % PlaceBlock::kPlaces] = root;
  }
  double Through(int root, Cell c) const;

  const AnyAngleFloor& floor_;
  int pitch_;  // blocks a row
  std::vector<PlaceBlock> blocks_;
  std::vector<Root> roots_;
  std::vector<Entry> queue_;  // a heap
  std::vector<Cone> waiting_, stack_;
  std::vector<int> unused_;  // of waiting_
  double limit_ = 0;         // what lies farther from the source waits
  std::int64_t work_ = 0;
};

}  // namespace floorproof

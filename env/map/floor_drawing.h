// SPDX-License-Identifier: Apache-2.0
// A floor drawn at random, step by step, in the characters of char_grid.h.
//
// What a robot of one cell may drive on (`. = g r`) stays connected, by the cells' sides, after
// every step. A block that is no longer driven on is placed only where the driveable cells of its
// own ring stay connected along that ring. This is enough for the whole floor, and needs a look at
// only a few cells. It is not necessary, because a detour may be longer than the ring; so the last
// pieces of very dense furniture are found with a spanning tree of the floor instead. Every step is
// a function of the stream alone and ends after a bounded number of tries; it says whether it found
// a place. It knows nothing of robots or of what a hazard measures.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/streams.h"
#include "env/geometry/grid.h"
#include "env/map/cell_shapes.h"

namespace floorproof {

// Whole numbers from low to high, both included.
struct IntRange {
  int low = 0, high = 0;
  int Draw(Stream& stream) const;
};

class FloorDrawing {
 public:
  // An empty floor within an outer wall of one cell. Both at least 3.
  FloorDrawing(int width, int height);

  // Cuts the floor in two by a wall with one door, and each part again, until a part would be
  // narrower than `room_cells` inside. No wall ends at a door.
  void DivideIntoRooms(int room_cells, int door_cells, Stream& stream);

  // A strip of `kind` one cell wide, from wall to wall, with floor on both of its sides: it splits
  // the room that it lies in. It keeps off doors.
  bool AddStrip(char kind, Stream& stream);
  // A rectangle of `kind` of about so many cells, which touches none of its kind. Glass is a pane
  // one cell thick. At the border: along the outer wall.
  bool AddCluster(char kind, const IntRange& cells, bool at_border, Stream& stream);
  // Exactly `total` cells of `#`, in rectangles of about so many cells, half of them against a
  // wall; when no rectangle fits any more, cell by cell.
  bool Furnish(int total, const IntRange& cells, Stream& stream);

  // A start at least two cells from hazards and outside doors, or as far as there is, and a goal of
  // the same kind that is farthest from it by the cells' sides. They are one cell only if no other
  // is free.
  struct Ends {
    Cell start, goal;
  };
  Ends ChooseEnds(Stream& stream) const;

  int FreeCells() const { return free_; }  // of '.'
  std::string Rows() const;                // the top row first, a line each

 private:
  enum class Ring { kClear, kNotOfItsKind, kAny };
  bool Fits(const CellBox& box, char kind, Ring ring) const;
  bool HangsTogetherAround(const CellBox& box) const;
  void Fill(const CellBox& box, char kind);
  CellBox DrawBox(char kind, int area, Stream& stream) const;
  void SlideToWall(CellBox& box, Stream& stream) const;
  void MoveToBorder(CellBox& box, Stream& stream) const;
  std::optional<CellBox> WallAcross(const CellBox& room, int room_cells, Stream& stream) const;
  std::optional<CellBox> StripThrough(Cell c, bool along_x) const;
  int FurnishCellByCell(int most, Stream& stream);
  int FurnishLeaves(int most, Stream& stream);
  // Calls visit(cell, is_corner) for the cells around the box, in order along its ring.
  template <class Visit>
  void AlongRing(const CellBox& box, Visit visit) const;

  Grid<char> chars_;
  Grid<std::uint8_t> wall_, door_;
  int free_ = 0;
};

}  // namespace floorproof

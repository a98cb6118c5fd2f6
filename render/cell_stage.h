// SPDX-License-Identifier: Apache-2.0
// Draws the moments of a film of cells, in order. For cell_film.cc only.
#pragma once

#include <vector>

#include "render/cell_film.h"
#include "render/cell_floor.h"

namespace floorproof {

class CellStage {
 public:
  CellStage(const CellFilmScript& script, int width, int height);
  // At t_s; `last`: as the drive left it, though `steps` may lack some moves of a very long one.
  const Image& Draw(const FilmFrame& frame, bool last);
  const CellFloor& floor() const { return floor_; }
  Cell floor_px() const { return {left_px_, top_px_}; }  // its upper left corner in the picture

 private:
  struct Layout;
  CellStage(const CellFilmScript& script, const Layout& layout);
  void Reach(double t_s);
  void Leave();
  void Look(Cell from);
  void DrawBackdrop(const Layout& layout);
  void DrawNumbers();
  TextStyle Headline() const;

  const CellFilmScript& script_;
  double unit_px_;
  int left_px_, top_px_, column_px_;  // the floor's corner; the legend's left border
  CellFloor floor_;
  std::vector<Cell> window_;  // from the robot
  Image backdrop_, image_;
  std::size_t next_ = 0;  // step
};

}  // namespace floorproof

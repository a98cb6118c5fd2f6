// SPDX-License-Identifier: Apache-2.0
#include "planners/walk/wave_front.h"

#include <utility>

#include "planners/search/neighbours.h"

namespace floorproof {
namespace {

constexpr double kT = 15, kX = 20;

}  // namespace

Wave::Wave(const Grid<std::uint8_t>& open, Cell end, CellScore cell_score)
    : open_(open), cell_score_(std::move(cell_score)), search_(open.cells.size()) {
  search_.Begin();
  search_.Reach(NumberOf(open_, end), 0);
  Spread();
}

void Wave::GoOnThrough(std::span<const Cell> opened) {
  for (const Cell cell : opened)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (const Cell near = cell + Cell{dx, dy}; open_.Inside(near) && Reaches(near))
          search_.Reopen(NumberOf(open_, near));
  Spread();
}

Grid<double> Wave::Scores() const {
  Grid<double> scores(open_.width, open_.height, kOutOfReach);
  for (int i = 0; i < static_cast<int>(scores.cells.size()); ++i)
    if (search_.IsReached(i)) scores.cells[Z(i)] = search_.CostOf(i);
  return scores;
}

void Wave::Spread() {
  const auto is_open = [&](Cell c) { return open_.Inside(c) && open_(c); };
  search_.Run([](const auto&) { return false; },
              [&](const auto& at, const auto& reach) {
                const Cell now = CellAt(open_, Z(at.node));
                const auto enter = [&](Cell next, double step) {
                  reach(NumberOf(open_, next),
                        at.cost + step + (cell_score_ ? cell_score_(next) : 0));
                };
                for (const Cell step : kSideSteps)
                  if (is_open(now + step)) enter(now + step, kT);
                for (const Cell step : kCornerSteps)
                  if (is_open(now + step) && is_open(now + Cell{step.ix, 0}) &&
                      is_open(now + Cell{0, step.iy}))
                    enter(now + step, kX);
              });
}

Grid<double> WaveFront(const Grid<std::uint8_t>& open, Cell end, const CellScore& cell_score) {
  return Wave(open, end, cell_score).Scores();
}

}  // namespace floorproof

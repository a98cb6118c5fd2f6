// SPDX-License-Identifier: Apache-2.0
#include "run/episode/cell_world.h"

#include <cmath>
#include <cstdlib>
#include <utility>

namespace floorproof {
namespace {

constexpr double kSlack = 1e-9;
constexpr double kCertain = 4;  // log odds

}  // namespace

CellWorld::CellWorld(const GridFrame& frame, Grid<std::uint8_t> blocked, Cell start,
                     double radius_m)
    : frame_(frame),
      blocked_(std::move(blocked)),
      reachable_(frame.width, frame.height),
      visits_(frame.width, frame.height) {
  const double radius = radius_m / frame.cell_m + kSlack;
  const int reach = static_cast<int>(radius);
  for (int iy = -reach; iy <= reach; ++iy)
    for (int ix = -reach; ix <= reach; ++ix)
      if (std::hypot(ix, iy) <= radius) window_.push_back({ix, iy});
  here_ = start;
  FindReachable();
  Come(start);
}

bool CellWorld::MayStep(Cell from, Cell by) const {
  if (std::abs(by.ix) > 1 || std::abs(by.iy) > 1) return false;
  return IsOpen({from.ix + by.ix, from.iy + by.iy}) && IsOpen({from.ix + by.ix, from.iy}) &&
         IsOpen({from.ix, from.iy + by.iy});
}

void CellWorld::FindReachable() {
  std::vector<Cell> todo = {here_};
  reachable_(here_) = 1;
  while (!todo.empty()) {
    const Cell at = todo.back();
    todo.pop_back();
    ++reachable_cells_;
    for (int iy = -1; iy <= 1; ++iy)
      for (int ix = -1; ix <= 1; ++ix) {
        const Cell to = {at.ix + ix, at.iy + iy};
        if (!MayStep(at, {ix, iy}) || reachable_(to)) continue;
        reachable_(to) = 1;
        todo.push_back(to);
      }
  }
}

void CellWorld::Sense(KnownMap& known) const {
  for (const Cell by : window_) {
    const Cell c = {here_.ix + by.ix, here_.iy + by.iy};
    if (!frame_.Inside(c) || known.At(c) != CellState::kUnknown) continue;
    known.Add(c.ix, c.iy, blocked_(c) ? kCertain : -kCertain, kCertain);
  }
}

bool CellWorld::Step(Cell to) {
  if (!MayStep(here_, {to.ix - here_.ix, to.iy - here_.iy})) return false;
  ++moves_;
  Come(to);
  return true;
}

void CellWorld::Come(Cell to) {
  here_ = to;
  const int visits = ++visits_(to);
  visited_ += visits == 1;
  revisited_ += visits == 2;
}

}  // namespace floorproof

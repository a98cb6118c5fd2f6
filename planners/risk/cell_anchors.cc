// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/cell_anchors.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "planners/search/grid_paths.h"

namespace floorproof {
namespace {

std::string_view ClassName(HazardClass c) {
  constexpr std::string_view kNames[] = {"a blind object (C1)", "glass (C2)", "a level change (C3)",
                                         "terrain (C4)"};
  return kNames[static_cast<std::size_t>(c)];
}

}  // namespace

std::string DescribePlace(const GridFrame& cells, const Vec2& p_W) {
  const Cell cell = cells.ToCell(p_W);
  const auto metres = [](double m) { return FormatDouble(std::round(m * 1000) / 1000); };
  std::ostringstream out;
  out << "(" << metres(p_W.x()) << ", " << metres(p_W.y()) << ") m, cell (" << cell.ix << ", "
      << cell.iy << ") of " << metres(cells.cell_m) << " m";
  return out.str();
}

CellAnchors::CellAnchors(const PlanRequest& request)
    : request_(request), grid_(request.risk->grid) {}

std::optional<Cell> CellAnchors::At(const Vec2& p_W, std::string& why) {
  const Cell cell = grid_.frame.ToCell(p_W);
  // (On the map's very edge the two frames may round apart.)
  if (!request_.map.frame.Inside(request_.map.frame.ToCell(p_W)) || !grid_.frame.Inside(cell)) {
    why = "lies off the map";
    return std::nullopt;
  }
  for (const Hazard& hazard : request_.map.hazards)
    for (const Polygon& polygon : hazard.footprint)
      if (Contains(polygon, p_W)) {
        why = "lies on a hazard, " + std::string(ClassName(hazard.hazard_class));
        return std::nullopt;
      }
  if (grid_.contents(cell).terrain()) {
    why = "its " + Width() + " cell holds a hazard, terrain (C4)";
    return std::nullopt;
  }
  if (grid_.contents(cell).free() && LiesWithin(cell, p_W)) return cell;
  if (!Fits(p_W)) {
    const auto& hazard = grid_.contents(cell).hazard;
    why = "the robot does not fit";
    if (hazard)
      why += ": its " + Width() + " cell holds a hazard, " + std::string(ClassName(*hazard));
    return std::nullopt;
  }
  std::optional<Cell> best;
  double least = std::numeric_limits<double>::infinity();
  constexpr int kReach = 2;
  for (int dy = -kReach; dy <= kReach; ++dy)
    for (int dx = -kReach; dx <= kReach; ++dx) {
      const Cell near = cell + Cell{dx, dy};
      if (!grid_.contents.Inside(near) || !grid_.contents(near).free()) continue;
      const double d = (grid_.frame.Center(near) - p_W).norm();
      if (d < least && Sees(p_W, grid_.frame.Center(near))) best = near, least = d;
    }
  if (!best) why = "the robot fits, but it can drive straight to no free cell of " + Width();
  return best;
}

std::string CellAnchors::Width() const { return FormatDouble(grid_.frame.cell_m) + " m"; }

// Whether the clear shape at p_W keeps to the cell, which is free as a whole.
bool CellAnchors::LiesWithin(Cell cell, const Vec2& p_W) const {
  const double room_m = (grid_.frame.cell_m - LeastCellWidth(request_.robot)) / 2;
  const Vec2 off_G = grid_.frame.X_WG.Inverse().Rotate(p_W - grid_.frame.Center(cell));
  constexpr double kTouch_m = 1e-3;
  return off_G.cwiseAbs().maxCoeff() <= room_m + kTouch_m;
}

// Where the robot can be, in finer cells: for places at which it does not lie within a free cell.
const SweepArea& CellAnchors::area() {
  if (!area_)
    area_ = ComputeSweepArea(request_.map, request_.robot.clear, request_.robot.tool,
                             request_.robot.step_m, request_.start.p());
  return *area_;
}

bool CellAnchors::Reaches(Cell fine) {
  return area().reachable.Inside(fine) && area().reachable(fine);
}

bool CellAnchors::Fits(const Vec2& p_W) {
  const Cell fine = area().frame.ToCell(p_W);
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (Reaches(fine + Cell{dx, dy})) return true;
  return false;
}

// Whether it drives straight from a_W to b_W, the centre of a free cell.
bool CellAnchors::Sees(const Vec2& a_W, const Vec2& b_W) {
  const int samples = 1 + static_cast<int>((b_W - a_W).norm() / area().frame.cell_m);
  for (int i = 1; i < samples; ++i)
    if (!IsClear(a_W + (b_W - a_W) * i / samples)) return false;
  return true;
}

// A place on a border of fine cells is in each of them.
bool CellAnchors::IsClear(const Vec2& p_W) {
  constexpr double kBorder_m = 1e-6;
  for (const double dy : {-kBorder_m, kBorder_m})
    for (const double dx : {-kBorder_m, kBorder_m})
      if (Reaches(area().frame.ToCell(p_W + area().frame.X_WG.Rotate({dx, dy})))) return true;
  return false;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Spiral: rings at growing distance from the walls.
//
// (1) For each pose of the robot the distance to the nearest place that is none is measured. (2)
// Contours of that distance, one row apart from the walls inwards, are traced. They are kept where
// they sweep something new. (3) What all coverage planners share orders and joins them
// (planners/lines/coverage_planner.h). That strings the rings of a room together as a spiral.
// Contour-parallel paths as in Held, "On the Computational Geometry of Pocket Machining", 1991.
// Parameters: those of every coverage planner. `edges` changes little, as the first ring is a lap.
// Not done: avoiding turns. Rings have corners where walls have, so they turn more than rows.
#include <algorithm>

#include "planners/lines/coverage_planner.h"
#include "planners/lines/wall_contours.h"

namespace floorproof {
namespace {

constexpr double kAtWall = 0.7;     // cells: as far as the steps of a traced contour
constexpr double kSlack = 0.12;     // of the tool's width, away from walls: fewer corners
constexpr double kOpenShare = 0.3;  // of the tool's width: less is left to later

class Spiral final : public CoveragePlanner {
 protected:
  std::vector<Polyline> Lines(const Floor& floor, const Swept& swept,
                              Figures& figures) const override {
    const Grid<float> depth = PoseDepth(floor);
    Swept covered = swept;
    std::vector<Polyline> lines;
    int rings = 0;
    for (double at = 0;; at += floor.tool_width) {
      const auto contours = Contours(floor, depth, at);
      if (contours.empty()) break;
      const double tolerance = at == 0 ? kAtWall : std::max(kAtWall, kSlack * floor.tool_width);
      for (auto& part :
           OpenParts(floor, contours, kOpenShare, floor.tool_width, tolerance, covered))
        lines.push_back(std::move(part));
      ++rings;
    }
    figures.push_back({"rings", rings});
    return lines;
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, Spiral)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "planners/lib/coverage_planner.h"
#include "planners/lib/laps.h"

namespace floorproof {
namespace {

class Spiral final : public CoveragePlanner {
 protected:
  std::vector<Polyline> Lines(const Floor& floor, const Swept& swept,
                              Figures& figures) const override {
    const Grid<float> depth = PoseDepth(floor);
    Swept covered = swept;
    std::vector<Polyline> lines;
    int rings = 0;
    for (double at = 0;; at += Spacing(floor)) {
      const auto contours = Contours(floor, depth, at);
      if (contours.empty()) break;
      for (auto& part : OpenParts(floor, contours, 0.3, floor.tool_width, covered))
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

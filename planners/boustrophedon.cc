// SPDX-License-Identifier: Apache-2.0
// Boustrophedon ("as the ox ploughs"): back-and-forth rows.
//
// (1) The floor is cut into regions, each with the direction that makes its rows long
// (planners/lines/regions.h). (2) Rows lie at the spacing and offset that fit a region best.
// Obstacles break them into the cells of a boustrophedon decomposition (Choset & Pignon 1997).
// (3) A tour leads over the rows, joined by shortest paths. (4) What sweeps nothing is dropped,
// uncovered patches are visited, and the tour is made anew (planners/lines/coverage_planner.h).
// Parameters: those of every coverage planner, and direction_deg. With `edges`, laps along walls
// and furniture come first, and the rows fill what these leave.
// Not done: rows do not bend. Ground narrower than the tool gets single visits, no rows.
#include <algorithm>
#include <cmath>

#include "planners/lines/coverage_planner.h"
#include "planners/lines/rows.h"

namespace floorproof {
namespace {

// What a row costs beside its length: about a step to the next one, and two turns.
constexpr double kLinkWidths = 1.5;

class Boustrophedon final : public CoveragePlanner {
 public:
  void Visit(ParamVisitor& visit) override {
    CoveragePlanner::Visit(visit);
    visit("direction_deg", direction_deg_, Any(),
          "of the rows, in the map's frame; none: chosen for each part of the floor");
  }

 protected:
  std::vector<Polyline> Lines(const Floor& floor, const Swept& swept,
                              Figures& figures) const override {
    const RowOptions options{floor.tool_width, kLinkWidths * floor.tool_width};
    std::optional<double> fixed;
    if (direction_deg_) fixed = *direction_deg_ * kPi / 180 - floor.turned_rad;
    const Regions regions = FindRegions(floor, options.link, fixed);
    const std::vector<Row> rows =
        MakeRows(floor, regions, options, swept.swept_cells() > 0 ? &swept : nullptr);

    std::vector<Polyline> lines;
    std::vector<double> length(regions.direction_rad.size());
    for (const Row& row : rows) {
      lines.push_back({row.a, row.b});
      length[static_cast<std::size_t>(row.region)] += (row.b - row.a).norm();
    }
    const auto longest = std::max_element(length.begin(), length.end()) - length.begin();
    figures.push_back({"regions", static_cast<double>(regions.direction_rad.size())});
    figures.push_back({"cells", static_cast<double>(CountCells(rows, regions))});
    figures.push_back({"rows", static_cast<double>(rows.size())});
    const double direction_rad =
        regions.direction_rad[static_cast<std::size_t>(longest)] + floor.turned_rad;
    figures.push_back({"sweep_direction_deg",
                       (direction_rad - kPi * std::floor(direction_rad / kPi + 1e-9)) * 180 / kPi});
    return lines;
  }

 private:
  std::optional<double> direction_deg_;
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, Boustrophedon)

}  // namespace floorproof

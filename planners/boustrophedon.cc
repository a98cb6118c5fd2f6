// SPDX-License-Identifier: Apache-2.0
#include "planners/lib/coverage_planner.h"
#include "planners/lib/rows.h"

namespace floorproof {
namespace {

class Boustrophedon final : public CoveragePlanner {
 public:
  void Visit(ParamVisitor& visit) override {
    CoveragePlanner::Visit(visit);
    visit("direction_deg", direction_deg_, Any(), "of the rows in the map's frame; none: chosen");
  }

 protected:
  std::vector<Polyline> Lines(const Floor& floor, const Swept& swept,
                              Figures& figures) const override {
    RowOptions options;
    options.spacing = Spacing(floor);
    options.link = 1.5 * floor.tool_width;
    std::optional<double> fixed;
    if (direction_deg_) fixed = *direction_deg_ * kPi / 180;
    Regions regions = FindRegions(floor, options.link, fixed);
    std::vector<Polyline> lines;
    for (const Row& row :
         MakeRows(floor, regions, options, swept.swept_cells() > 0 ? &swept : nullptr))
      lines.push_back({row.a, row.b});
    figures.push_back({"regions", static_cast<double>(regions.direction_rad.size())});
    figures.push_back({"rows", static_cast<double>(lines.size())});
    return lines;
  }

 private:
  std::optional<double> direction_deg_;
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, Boustrophedon)

}  // namespace floorproof

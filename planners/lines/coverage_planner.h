// SPDX-License-Identifier: Apache-2.0
// What coverage planners of a known floor share: from lines over the floor to a path.
//
// (1) The lines are the planner's own, and laps along the walls if these are asked for. (2) A tour
// leads over them, joined by shortest paths. (3) Twice, parts that sweep nothing are dropped, what
// is still uncovered is visited, and the tour is made anew. (4) Detours that are not worth their
// length are cut out.
// Overlap: away from walls the tool counts as narrower than it is, by that share. So neighbouring
// lines overlap everywhere, and a robot may stray by half of the overlap.
// A footprint is held along the map's axes, or along walls that are askew to them
// (map_along_walls.h) if that takes less length and turns for the share of the floor that it
// sweeps. Assumed: the floor is known and does not change; a footprint is convex and keeps its yaw.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planners/lines/held_yaw.h"
#include "planners/lines/shortest_paths.h"
#include "planners/lines/swept.h"
#include "planners/planner.h"

namespace floorproof {

using Figures = std::vector<std::pair<std::string, double>>;

class CoveragePlanner : public Planner {
 public:
  void Visit(ParamVisitor& visit) override;
  PlanResult Plan(const PlanRequest& request) const override;
  PlannerPromises promises() const override {
    return {.covers = PlannerPromises::Covers::kGround, .least_coverage = 0.9};
  }

 protected:
  // The lines that the planner is named for, up to one tool width apart. `swept` holds the laps
  // along the walls if they are asked for; else it is empty.
  virtual std::vector<Polyline> Lines(const Floor& floor, const Swept& swept,
                                      Figures& figures) const = 0;

 private:
  // The floor as the robot's shapes lie on it, on the map's grid or on one along the walls.
  struct HeldGround {
    HeldShapes held;
    FloorRoom room;
    SweepArea area;
    double turned_rad = 0;  // from the map's axes to the grid's
    double lost = 0;        // share of the sweepable floor on the map's own grid
  };
  // `plan`: with the shapes that it is made for, as `shapes` below.
  static HeldGround GroundOf(const HazardMap& map, const PlanRequest& request,
                             const PlanResult& plan);
  PlanResult PlanOn(const HeldGround& ground, const PlanRequest& request, PlanResult shapes) const;
  // A plan with rows along walls that are askew to the map, for a footprint. None if it loses much
  // of `ground` (that of the map's own grid), or if the robot does not fit at the start at that
  // yaw.
  std::optional<PlanResult> PlanAlongWalls(const PlanRequest& request, const HeldGround& ground,
                                           const PlanResult& shapes) const;
  // `shortfall`: the share of the robot's ground that this floor lacks, or that driving loses. To
  // make up for it, more of what is there is swept.
  Polyline Sweep(const Floor& floor, const Vec2& start, double shortfall, Figures& figures) const;

  std::optional<double> tool_width_m_;
  std::optional<double> radius_m_;
  std::optional<double> margin_m_;
  double overlap_ = 0.05;
  bool edges_ = false;
};

}  // namespace floorproof

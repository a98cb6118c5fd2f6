// SPDX-License-Identifier: Apache-2.0
// What coverage planners of a known floor share: from lines over the floor to a path.
//
// (1) Laps along the walls, if asked for, and the planner's own lines; (2) a tour over them, joined
// by shortest ways; (3) twice: what sweeps nothing is dropped, what is left open is visited, and
// all that works is ordered anew; (4) detours not worth their length are cut out. Overlap means
// that away from walls the tool counts as narrower than it is, by that share, so that neighbouring
// lines overlap everywhere and a robot may stray by half of it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planners/lines/swept.h"
#include "planners/lines/ways.h"
#include "planners/planner.h"

namespace floorproof {

using Figures = std::vector<std::pair<std::string, double>>;

class CoveragePlanner : public Planner {
 public:
  void Visit(ParamVisitor& visit) override;
  PlanResult Plan(const PlanRequest& request) const override;
  PlannerPromises promises() const override {
    return {.covers = PlannerPromises::Covers::kGround, .least_coverage = 0.95};
  }

 protected:
  // The lines that a planner is named for, up to one tool width apart. `swept` holds the laps along
  // the walls, if they are asked for, and is empty otherwise.
  virtual std::vector<Polyline> Lines(const Floor& floor, const Swept& swept,
                                      Figures& figures) const = 0;

 private:
  // `shortfall`: share of the robot's ground that this floor lacks, or that driving loses; more of
  // what is there is swept for it.
  Polyline Sweep(const Floor& floor, const Vec2& start, double shortfall, Figures& figures) const;

  std::optional<double> tool_width_m_;
  std::optional<double> radius_m_;
  std::optional<double> margin_m_;
  double overlap_ = 0.05;
  bool edges_ = false;
};

}  // namespace floorproof

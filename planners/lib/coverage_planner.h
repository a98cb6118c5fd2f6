// SPDX-License-Identifier: Apache-2.0
// What coverage planners of a known floor share: from lines over the floor to a path.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planners/lib/swept.h"
#include "planners/lib/ways.h"
#include "planners/planner.h"

namespace floorproof {

using Figures = std::vector<std::pair<std::string, double>>;

class CoveragePlanner : public Planner {
 public:
  void Visit(ParamVisitor& visit) override;
  PlanResult Plan(const PlanRequest& request) const override;

 protected:
  // The lines that a planner is named for. `swept` starts empty and may be used; laps along the
  // walls, if asked for, are in it already.
  virtual std::vector<Polyline> Lines(const Floor& floor, const Swept& swept,
                                      Figures& figures) const = 0;

  double Spacing(const Floor& floor) const { return floor.tool_width * (1 - overlap_); }

 private:
  Polyline Sweep(const Floor& floor, const Vec2& start, Figures& figures) const;

  std::optional<double> tool_width_m_;
  std::optional<double> radius_m_;
  double overlap_ = 0.05;
  bool edges_ = false;
};

}  // namespace floorproof

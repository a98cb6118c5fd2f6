// SPDX-License-Identifier: Apache-2.0
// Coverage of an unknown floor that keeps along the frontier of what is covered: where the robot's
// steps are the known map's cells, or a step is stated, cell by cell (cell_frontier.h); else in
// lanes of the tool's width (lane_frontier.h). Ours.
#include <optional>

#include "planners/online/cell_frontier.h"
#include "planners/online/lane_frontier.h"

namespace floorproof {
namespace {

class FrontierCoverage final : public OnlinePlanner {
 public:
  void Visit(ParamVisitor& v) override {
    params_.Visit(v);
    v("look_around", look_around_, Between(0, 100),
      "for so many cells around it thinks its way through before each step; 0: the rule alone");
  }
  const OnlineParams& params() const override { return params_; }

  void Start(const OnlineTask& task) override {
    cells_.reset();
    lanes_.reset();
    if (params_.step_m || task.ground.cell_m >= task.tool_width_m)
      cells_.emplace(task, params_, look_around_);
    else
      lanes_.emplace(task);
  }
  OnlineStep Next(const OnlineInput& input) override {
    return cells_ ? cells_->Next(input) : lanes_->Next(input);
  }
  std::vector<std::pair<std::string, double>> figures() const override {
    if (cells_) return {{"dead_ends", cells_->dead_ends()}};
    return {{"dead_ends", lanes_ ? lanes_->dead_ends() : 0}};
  }

 private:
  OnlineParams params_;
  int look_around_ = 28;
  std::optional<CellFrontier> cells_;
  std::optional<LaneFrontier> lanes_;
};

}  // namespace

FP_DEFINE_PLUGIN(OnlinePlanner, FrontierCoverage)

}  // namespace floorproof

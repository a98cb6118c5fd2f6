// SPDX-License-Identifier: Apache-2.0
// Straight on until blocked, then in a random direction: what Li et al. (robot_cells.h) compare
// their planner with (section 6), after Gage, "Randomized search strategies with imperfect
// sensors", 1993. A direction is any angle, all alike, of those in which the first step is free;
// the robot takes the cells that a straight line in it passes, by steps to 8 neighbours. It knows
// of no end.
#include <algorithm>
#include <cmath>

#include "base/streams.h"
#include "planners/online/online_planner.h"
#include "planners/online/robot_cells.h"

namespace floorproof {
namespace {

class RandomWalk final : public OnlinePlanner {
 public:
  void Visit(ParamVisitor& v) override { params_.Visit(v); }
  const OnlineParams& params() const override { return params_; }
  bool uses_seed() const override { return true; }
  bool covers_all() const override { return false; }

  void Start(const OnlineTask& task) override {
    cells_ = CellsOf(task, params_);
    draws_ = Stream(task.seed, 0, "random_walk");
    way_ = Vec2::Zero();
    from_ = {};
    steps_ = 0;
  }

  OnlineStep Next(const OnlineInput& input) override {
    cells_.Update(input.known, input.changed);
    const Cell here = cells_.FreeAt(input.estimate.X_WB.p());
    std::size_t step = StepOn(here);
    if (input.left_its_way() || step == kNone || !cells_.MayStep(here, step)) {
      if (!IsAnyOpen(here))
        return {OnlineStep::Kind::kNowhere, {}, "there is no free floor around the robot"};
      do {
        Turn(here);
        step = StepOn(here);
      } while (!cells_.MayStep(here, step));
    }
    ++steps_;
    return {OnlineStep::Kind::kTarget, cells_.frame().Center(here + kSteps[step])};
  }

 private:
  static constexpr std::size_t kNone = kSteps.size();

  bool IsAnyOpen(Cell here) const {
    for (std::size_t k = 0; k < kSteps.size(); ++k)
      if (cells_.MayStep(here, k)) return true;
    return false;
  }

  void Turn(Cell here) {
    const double angle_rad = draws_.Uniform(0, 2 * kPi);
    const Vec2 way(std::cos(angle_rad), std::sin(angle_rad));
    way_ = way / std::max(std::abs(way.x()), std::abs(way.y()));  // one cell at a time
    from_ = here;
    steps_ = 0;
  }

  // The next cell of the line; kNone: the robot is not on it.
  std::size_t StepOn(Cell here) const {
    const auto at = [&](int n) {
      return from_ + Cell{static_cast<int>(std::lround(n * way_.x())),
                          static_cast<int>(std::lround(n * way_.y()))};
    };
    if (here != at(steps_)) return kNone;
    const Cell next = at(steps_ + 1);
    return StepOf({next.ix - here.ix, next.iy - here.iy});
  }

  OnlineParams params_;
  RobotCells cells_;
  Stream draws_{0, 0, ""};
  // Along which line, from where, and how many steps were taken on it.
  Vec2 way_ = Vec2::Zero();
  Cell from_;
  int steps_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(OnlinePlanner, RandomWalk)

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What a robot's tool has swept, whichever of its shapes it had.
#pragma once

#include "env/core/coverage.h"
#include "env/core/robot_spec.h"

namespace floorproof {

class ToolMeter {
 public:
  ToolMeter(const SweepArea& area, const RobotSpec& robot)
      : meter_(area, robot.tool), robot_(robot), shape_(robot.shape) {}

  // The robot's from now on, as in Sample. Between two shapes the tool is lifted; then it is the
  // new shape's.
  void Take(int shape) {
    if (shape == shape_) return;
    shape_ = shape;
    meter_.Lift();
    if (shape < 0 || robot_.tool.kind != Shape2::Kind::kFootprint) return;
    meter_.SetTool(
        {Shape2::Kind::kFootprint, 0, robot_.shapes[static_cast<std::size_t>(shape)].footprint_B});
  }
  // The robot moved on to here.
  void Add(const Pose2& X_WB) {
    if (shape_ >= 0) meter_.Add(X_WB);
  }
  void Lift() { meter_.Lift(); }  // it was carried
  const CoverageMeter& swept() const { return meter_; }

 private:
  CoverageMeter meter_;
  const RobotSpec& robot_;
  int shape_;
};

}  // namespace floorproof

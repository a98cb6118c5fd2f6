// SPDX-License-Identifier: Apache-2.0
// Estimators: where the robot thinks it is. A new one is one file and one line in estimators.inc.
#pragma once

#include <memory>
#include <span>

#include "env/core/motion.h"
#include "env/core/params.h"
#include "env/core/registry.h"

namespace floorproof {

class Estimator : public Configurable {
 public:
  virtual void Start(const Pose2& X_WB) = 0;
  // One control period; `truth` is the last physics step's sample.
  virtual Estimate Update(const Sample& truth, double dt_s) = 0;
};

std::span<const PluginEntry<Estimator>> Estimators();

}  // namespace floorproof

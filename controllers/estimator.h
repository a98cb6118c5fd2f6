// SPDX-License-Identifier: Apache-2.0
// Estimators: where the robot thinks it is. A new one is one file and one line in estimators.inc.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "base/streams.h"
#include "env/core/hazard_map.h"
#include "env/core/motion.h"
#include "env/core/observation.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// What an estimator is given at the start; it outlives the episode.
struct EstimatorContext {
  const HazardMap& known;  // the map that the robot has
  const RobotSpec& robot;
  Pose2 start;   // where the robot truly stands
  Stream draws;  // of this episode: for its start error and its particles
};

class Estimator : public Configurable {
 public:
  // What it cannot do without.
  virtual std::vector<Reading> Needs() const { return {}; }
  // Whether what it thinks hangs on its stream, beyond what it is told; false: another episode's
  // stream changes nothing.
  virtual bool draws() const { return true; }
  // Throws InputError where map or robot do not let it work, its line beginning with the key: it is
  // heard when a scenario is read (run/scenario/start_check.h).
  virtual void Start(const EstimatorContext& context) = 0;
  // What these wheels turn, a flag each, is not to be believed any more, until Start.
  virtual void Exclude(std::span<const char>) {}
  // How far off its position may be after `way_m`, metres, on a floor that it was given as `known`:
  // some 5 % of the time it is farther off. A plan that passes obstacles this closely is warned of.
  virtual double error_m([[maybe_unused]] const HazardMap& known,
                         [[maybe_unused]] double way_m) const {
    return 0;
  }
  // One control period.
  virtual Estimate Update(const Observation& sensed, double dt_s) = 0;
};

std::span<const PluginEntry<Estimator>> Estimators();

}  // namespace floorproof

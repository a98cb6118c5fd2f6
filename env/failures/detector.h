// SPDX-License-Identifier: Apache-2.0
// Failure detectors: from the stream of true samples to events. A new one is one file in this
// folder and one line in list.inc. They know no MuJoCo: an old trace can be judged again.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "env/core/event.h"
#include "env/core/hazard_map.h"
#include "env/core/motion.h"
#include "env/core/path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct EpisodeContext {
  const HazardMap& map;  // the true one, hazards of `known: false` included
  const RobotSpec& robot;
  double timestep_s = 0.004;
};

class Detector : public Configurable {
 public:
  virtual FailureMode mode() const = 0;
  // Before the first sample, and again after an intervention. May allocate; Update may not, unless
  // it fires.
  virtual void Start(const EpisodeContext& context) = 0;
  // Every physics step. Returns true at the step at which the failure is established, once per
  // failure (it rearms when the condition has cleared); then event() has the evidence.
  virtual bool Update(const Sample& sample) = 0;
  const Event& event() const { return event_; }
  // How far from failing, in the threshold's unit, where that was the smallest share of the
  // threshold since Start(); positive is safe.
  double margin() const { return margin_; }
  // That share: 1, it never came nearer; below 0, it was beyond it. It does not say whether it
  // failed: beyond for too short a time is no failure.
  double margin_share() const { return margin_ / threshold_; }

 protected:
  // In Start: nothing has come nearer yet than the whole threshold, which is > 0.
  void StartMargin(double threshold) { margin_ = threshold_ = threshold; }
  // `left` of a `threshold` > 0 that differs from place to place.
  void LowerMargin(double left, double threshold) {
    if (left / threshold >= margin_share()) return;
    margin_ = left;
    threshold_ = threshold;
  }

  Event event_;
  double margin_ = 0;

 private:
  double threshold_ = 1;
};

struct NamedDetector {
  std::string name;
  std::unique_ptr<Detector> detector;
};

std::span<const PluginEntry<Detector>> Detectors();

// The id of the hazard of that index, or of the base floor (ObstacleContact::kFloor); "wall" for a
// map's own obstacle when `contact`, else "".
std::string HazardId(const HazardMap& map, int index, bool contact);

}  // namespace floorproof

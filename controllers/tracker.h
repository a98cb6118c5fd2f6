// SPDX-License-Identifier: Apache-2.0
// Path trackers: from an estimate and a path to a body twist. A new one is one file in this folder
// and one line in trackers.inc.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "controllers/missed_stops.h"
#include "env/core/coverage.h"
#include "env/core/motion.h"
#include "env/core/path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

class Drive;

class Tracker : public Configurable {
 public:
  // Whether it can command a robot on this drive, judged by what the drive can do.
  virtual bool Commands(const Drive& drive) const = 0;
  // Takes the plan, once, before the first Update. `clearance` is the known map's and outlives the
  // tracker, or is nullptr. May allocate; Update may not.
  virtual void Start(const Path& path, const RobotSpec& robot, const ClearanceField* clearance) = 0;
  // The way goes on: this path begins on the segment that is tracked. It leads farther than the one
  // before, or leaves it for what came into sight. The robot keeps moving. Its shape stays. May
  // allocate.
  virtual void Extend(const Path& path) = 0;
  // From now on, until Start, its speeds and turns are at most this share of what they would be; 0:
  // it comes to rest where it is, and stays.
  virtual void Slow(double share) = 0;
  // What the path taken takes by its own speeds, where nothing goes wrong (s): ways, stops, turns,
  // dwells, folding, and slowing down beside what is known. Time limits are made from it.
  virtual double Duration() const = 0;
  // Of the path taken, so far: what was passed beside. Who turns on the spot misses nothing.
  virtual MissedStops Missed() const { return {}; }
  // Whether Update() would find the end reached. Who cannot say it beforehand says no.
  virtual bool WouldBeDone(const Estimate&, double /*t_s*/) const { return false; }
  // One control period. `t_s` is simulated time; `dt_s` the period.
  virtual Command Update(const Estimate& estimate, double t_s, double dt_s) = 0;
};

// Throws InputError, naming the tracker, when one of the robot's speeds or accelerations is not
// positive.
void RequireLimits(const RobotSpec& robot, std::string_view tracker);

std::span<const PluginEntry<Tracker>> Trackers();
// The first tracker of the list that commands this drive; throws InputError when there is none.
std::string_view DefaultTracker(std::string_view drive);

}  // namespace floorproof

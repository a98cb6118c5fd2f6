// SPDX-License-Identifier: Apache-2.0
// Which hazards a robot met on its way, how, and what came of each: its Encounters. Free floor and
// walls beside are added up in metres.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "env/core/encounter.h"
#include "env/core/motion.h"
#include "env/core/passages.h"

namespace floorproof {

class EncounterMeter {
 public:
  // All outlive it. `map`: the true floor as it is for its robot (TrueFloor); `holds_yaw`: see
  // PathWalk.
  EncounterMeter(const HazardMap& map, const RobotSpec& robot, bool holds_yaw);

  // Once a control period. `path`: that it follows; nullptr: none, it is led otherwise. Allocates
  // only where an encounter begins.
  void OnControl(const Sample& sample, const Estimate& estimate, const Path* path);
  // A failure belongs to the last encounter with the hazard that did it, open or not long past. One
  // that no hazard did belongs to what the robot is in, else to the wall beside it or the floor.
  void OnEvent(const Event& event);
  // It was carried elsewhere.
  void Lift();

  // What is still open is censored, if nothing failed there. In the order in which they began;
  // exposures last.
  std::vector<Encounter> Finish();

 private:
  struct Live {
    int meeting = 0;  // its id
    std::size_t row = 0;
    double from_m = 0;
    bool planned = false;  // its path says how it is to be passed
  };
  // Of walls beside, or of free floor.
  struct Exposure {
    double way_m = 0, time_s = 0, wall_sum_m2 = 0;
    double t_s = 0;
    Vec2 p_W = Vec2::Zero();
  };

  void Follow(const Sample& sample, const Path* path);
  Live& Begin(const Meeting& meeting, const Sample& sample, const Path* path);
  void TakeEntry(const Meeting& meeting, const Sample& sample, Encounter& row) const;
  void TakePlanned(const PlannedPassage& planned, Encounter& row) const;
  void End(const Meeting& meeting);
  Encounter* Blamed(const Event& event);
  void AddExposure(const Sample& sample, double way_m, double time_s);
  void CloseExposure(std::string_view type, Encounter::Outcome outcome, FailureMode mode);

  const HazardMap& map_;
  const RobotSpec& robot_;
  bool holds_yaw_;
  HazardParts parts_;
  PassageWatch watch_;
  std::vector<Encounter> rows_, exposures_;
  std::vector<Live> live_;
  std::array<Exposure, 2> exposed_;  // to walls, to free floor
  bool has_last_ = false, at_wall_ = false;
  Pose2 last_;
  double last_s_ = 0, way_m_ = 0, estimate_error_m_ = 0, estimate_error_rad_ = 0;
};

}  // namespace floorproof

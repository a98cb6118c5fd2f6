// SPDX-License-Identifier: Apache-2.0
// Which hazards a robot met on its way, how, and what came of each: its Encounters. Free floor and
// walls beside are added up in metres.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "env/core/encounter.h"
#include "env/core/motion.h"
#include "env/core/passages.h"
#include "run/episode/hazard_sight.h"

namespace floorproof {

class EncounterMeter {
 public:
  // All outlive it. `map`: the true floor as it is for its robot (TrueFloor); `holds_yaw`: see
  // PathWalk; `sight`: what its sensors tell of hazards, nullptr: it has none that could.
  EncounterMeter(const HazardMap& map, const RobotSpec& robot, bool holds_yaw,
                 const HazardSight* sight = nullptr);

  // Once a control period. `path`: that it follows; nullptr: none, it is led otherwise. Allocates
  // only where an encounter begins.
  void OnControl(const Sample& sample, const Estimate& estimate, const Path* path);
  // A failure belongs to the last encounter with the hazard that did it, open or not long past. One
  // that no hazard did belongs to what the robot is in, else to the wall beside it or the floor.
  void OnEvent(const Event& event);
  // The hardest fall or blow since this was last called.
  void OnBlow(double energy_j);
  // It was carried elsewhere.
  void Lift();
  // It failed, and drives on unhelped: no row begins or goes on from here. What it is in is
  // followed, and blows are the failure's.
  void Watch() { watched_ = true; }
  // Whether it has left what it failed at.
  bool HasLeftFailure() const;
  // What became of it.
  void TakeAfter(Encounter::After after);

  // What is still open is censored, if nothing failed there. In the order in which they began;
  // exposures last.
  std::vector<Encounter> Finish();

 private:
  struct Live {
    int meeting = 0;  // its id
    std::size_t row = 0;
    double from_m = 0;
    double before_m = 0;   // way in it before it fell back
    bool planned = false;  // its path says how it is to be passed
    int seen_as = -1;      // of its sight; -1: it is not asked
    bool upon = false;
  };
  // Of walls beside, or of free floor.
  struct Exposure {
    double way_m = 0, time_s = 0;
    double wall_m2 = 0, error_m2 = 0, error_rad_m = 0;  // sums over the way
    double t_s = 0;
    Vec2 p_W = Vec2::Zero();
  };

  void Follow(const Sample& sample, const Path* path);
  void TakeSensed(const Sample& sample, bool enters, Live& live);
  Live& Begin(const Meeting& meeting, const Sample& sample, const Path* path);
  void TakeEntry(const Meeting& meeting, const Sample& sample, Encounter& row) const;
  void TakePlanned(const PlannedPassage& planned, Encounter& row) const;
  void End(const Meeting& meeting);
  bool GoesOn(const Meeting& meeting, Live& live);
  Encounter* Blamed(const Event& event);
  Encounter* Failed();
  void AddExposure(const Sample& sample, double way_m, double time_s);
  void CloseExposure(std::string_view type, Encounter::Outcome outcome, FailureMode mode);

  const HazardMap& map_;
  const RobotSpec& robot_;
  bool holds_yaw_;
  const HazardSight* sight_;
  HazardParts parts_;
  PassageWatch watch_;
  std::vector<Encounter> rows_, exposures_;
  std::vector<Live> live_;
  std::array<Exposure, 2> exposed_;  // to walls, to free floor
  bool has_last_ = false, at_wall_ = false;
  // The first failure's row, of rows_ or else of exposures_.
  struct FailedRow {
    bool is_exposure = false;
    std::size_t row = 0;
  };
  std::optional<FailedRow> failed_;
  bool watched_ = false;
  Pose2 last_;
  double last_s_ = 0, way_m_ = 0, estimate_error_m_ = 0, estimate_error_rad_ = 0;
  double speed_mps_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A meeting of a robot with a hazard, from when its footprint comes within reach until it has left:
// the unit in which risk is measured. What it was met with, and what came of it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "env/core/event.h"

namespace floorproof {

// What the plan wanted: over the hazard, or past it.
enum class Passage { kOver, kBeside };
constexpr std::string_view Name(Passage passage) {
  return passage == Passage::kOver ? "over" : "beside";
}

// How a hazard is met: by a plan that is to come, or by a robot as it enters.
struct Approach {
  double heading_rad = 0;  // of the travel, from the inward normal of the edge that is entered by,
                           // or of the nearest that is passed: 0 is square on, positive
                           // counter-clockwise, pi/2 along it
  double lead_rad = 0;     // of the travel, in the body's frame: 0 forward, pi/2 to the left
  double speed_mps = 0;
  double gap_m = 0;        // from the footprint to the hazard where the plan comes nearest; 0: over
  double width_share = 0;  // of the footprint, across the way, what the plan leads over it
  double turn_rad = 0;    // that the plan turns the body by while it is over, or passes, the hazard
  double turn_gap_m = 0;  // from the body's centre to the hazard's edge where the plan turns it,
                          // mean over all that it turns, at most the robot's radius; below 0: the
                          // centre is over the hazard
  double over_m = 0;      // way of the plan over it, or within reach where it leads past it
  double wall_m = 0;      // from the footprint to the nearest wall; kFarWall_m: as far or farther
  double friction = 0;    // of floor and wheels there
  double mass_kg = 0, clearance_m = 0;  // the robot's
  double estimate_error_m = 0;          // how far off the robot thinks it is
  double estimate_error_rad = 0;        // how far astray, either way
};
// Walls farther away than this are not looked for.
inline constexpr double kFarWall_m = 1;

// One of the numbers of an Approach, by its name in tables and models.
struct ApproachColumn {
  std::string_view name;
  double Approach::*member;
  std::string_view unit, help;  // a line of docs/results.md
};
inline constexpr std::array<ApproachColumn, 14> kApproach = {{
    {"heading_rad", &Approach::heading_rad, "rad",
     "of the travel, from the inward normal of the edge that is entered by, or of the nearest that "
     "is passed: 0 is square on, positive counter-clockwise"},
    {"lead_rad", &Approach::lead_rad, "rad",
     "of the travel, in the body's frame: 0 forward, 1.57 to the left"},
    {"speed_mps", &Approach::speed_mps, "m/s", "speed over the floor"},
    {"gap_m", &Approach::gap_m, "m",
     "from the footprint to the hazard where the plan comes nearest; 0: over it"},
    {"width_share", &Approach::width_share, "",
     "of the footprint, across the way, what the plan leads over the hazard"},
    {"turn_rad", &Approach::turn_rad, "rad",
     "that the plan turns the body by while it is over the hazard, or, where it is passed, within "
     "reach"},
    {"turn_gap_m", &Approach::turn_gap_m, "m",
     "from the body's centre to the hazard's edge where the plan turns it, mean over all that it "
     "turns, at most the robot's radius; below 0: its centre is over the hazard"},
    {"over_m", &Approach::over_m, "m",
     "way of the plan over the hazard, or within reach where it leads past"},
    {"wall_m", &Approach::wall_m, "m",
     "from the footprint to the nearest wall, 1 where none is so near"},
    {"friction", &Approach::friction, "", "of floor and wheels"},
    {"mass_kg", &Approach::mass_kg, "kg", "the robot's mass"},
    {"clearance_m", &Approach::clearance_m, "m", "from the floor to the robot's belly"},
    {"estimate_error_m", &Approach::estimate_error_m, "m",
     "from where the robot thinks it is to where it is"},
    {"estimate_error_rad", &Approach::estimate_error_rad, "rad",
     "from the heading that the robot thinks it has to its own, either way"},
}};

struct Encounter {
  // Of the hazard; of exposures, which belong to none, `type` is kWallBeside or kFreeFloor, and
  // way_m says how much there was.
  std::string hazard, type;
  Passage passage = Passage::kOver;
  std::vector<std::pair<std::string, double>> size;     // the hazard's keys (Hazard::keys)
  Approach at;                                          // as it entered
  double t_s = 0, x_m = 0, y_m = 0;                     // then
  double time_s = 0, way_m = 0;                         // in it
  enum class Outcome { kCleared, kFailed, kCensored };  // censored: the episode ended otherwise
  Outcome outcome = Outcome::kCensored;
  FailureMode mode = FailureMode::kVeerOff;  // of kFailed
  int drive = -1;  // among encounters of several drives, which it belongs to; -1: to none known
  // The hardest fall or blow, J (run/episode/blow_meter.h): while the robot was in it; of a
  // failure, to the end of the drive.
  double energy_j = 0;
  // What became of the robot after a failure. Unseen: nothing failed, or the drive did not go on by
  // itself.
  enum class After { kUnseen, kRecovered, kNeedsHelp };
  After after = After::kUnseen;
  // Whether its sensors told of the hazard while it could still have stopped before it. Unseen: it
  // has no sensors that could, or met it before.
  enum class Sensed { kUnseen, kInTime, kNotInTime };
  Sensed sensed = Sensed::kUnseen;
};
inline constexpr std::string_view kWallBeside = "wall_beside", kFreeFloor = "free_floor";

// cleared, censored, or the failure's mode.
constexpr std::string_view OutcomeText(const Encounter& encounter) {
  if (encounter.outcome == Encounter::Outcome::kCleared) return "cleared";
  if (encounter.outcome == Encounter::Outcome::kCensored) return "censored";
  return Name(encounter.mode);
}
// Their values' names in tables, in order.
inline constexpr std::array<std::string_view, 3> kAfterNames = {"", "recovered", "needs_help"};
inline constexpr std::array<std::string_view, 3> kSensedNames = {"", "in_time", "not_in_time"};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How large hazards may be that a robot was measured to cross (the ladder, validate/ladder.h), and
// what that says of a floor.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace floorproof {

struct Hazard;
struct HazardMap;
struct RobotSpec;

struct MeasuredLimit {
  std::string kind;  // as hazards state their sizes (HazardSize)
  // One a friction: the least of all directions and speeds; m, rad or a share. 0: nothing was
  // crossed.
  std::vector<double> most;
};

struct MeasuredLimits {
  std::string by;                     // what measured them; empty: the file states none
  std::string model;                  // that was measured, by its SHA-256
  std::vector<double> frictions;      // of the floors that they were measured on, ascending
  std::vector<MeasuredLimit> limits;  // empty: none
  // Whether the file states the figures' hash, so that none can have been edited unseen.
  bool hashed = false;
  // Why the limits that the model's file states are not here: they are of another robot than this,
  // or were edited.
  std::string why_unused;
};

// They do not hold for this robot, and why. The first reason stays.
void DropLimits(MeasuredLimits& measured, std::string_view why);

// The limit of this kind on a floor of this friction: the lesser of those at the nearest frictions
// that were measured. Below the lowest of these it is that one's. None: it was not measured.
std::optional<double> LimitOn(const MeasuredLimits& measured, std::string_view kind,
                              double friction);
// Whether the robot crosses the hazard on a floor of this friction; where the hazard has a lower
// friction of its own, that counts. None: nothing that was measured says.
std::optional<bool> Crosses(const MeasuredLimits& measured, const Hazard& hazard,
                            double floor_friction);

// The highest level change that the robot is trusted to cross on a floor of this friction, m: the
// lesser of the measured limits up and down where there are such, else its step_m.
double TrustedStep(const RobotSpec& robot, double floor_friction);
// The map with `crossable` of each level change and terrain as the robot's limits say.
HazardMap JudgedFor(HazardMap map, const RobotSpec& robot);

}  // namespace floorproof

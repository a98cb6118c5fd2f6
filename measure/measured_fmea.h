// SPDX-License-Identifier: Apache-2.0
// The tables of the hTetro FMEA paper (htetro-fmea-coverage, Tables 1 to 3), counted in encounters
// instead of estimated, with the experts' figures beside.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "env/core/encounter.h"
#include "env/core/hazard_map.h"
#include "planners/risk/fmea_tables.h"
#include "stats/interval.h"

namespace floorproof {

// Of `of` cases that were counted, `events` were so. The interval is Clopper and Pearson's, 95 %.
struct CountedShare {
  int events = 0, of = 0;
  Interval interval = {0, 1};
  // None where nothing was counted.
  double value() const { return of > 0 ? static_cast<double>(events) / of : 0; }
};
CountedShare Counted(int events, int of);

struct ComparedShare {
  CountedShare measured;
  double experts = 0;
  bool excluded() const { return measured.of > 0 && !measured.interval.Contains(experts); }
};

// What comes of an encounter: no failure, or a mode first. They sum to 1.
struct EncounterShares {
  int encounters = 0;  // with an outcome
  int censored = 0;    // without, in none of the shares
  CountedShare none;
  std::array<CountedShare, kNumFailureModes> modes;
};

// Which side of the body leads: less than 30 degrees off its axis, forward or back; less than 30
// off the axis across; or between the two.
enum class LeadingSide { kForward, kSideways, kDiagonal };
inline constexpr std::array<const char*, 3> kLeadingSides = {"forward", "sideways", "diagonal"};
LeadingSide LeadingSideOf(double lead_rad);

struct MeasuredClass {
  std::vector<std::string> types;  // of its hazards that were met, ascending
  EncounterShares all;
  // By leading side, below slow_below_mps and from there.
  std::array<std::array<EncounterShares, 2>, kLeadingSides.size()> by_way;
  // Table 3, upper half: of the failures, the share of each mode. That is all that the experts
  // state of a class; their table has no "no failure".
  std::array<ComparedShare, kNumFailureModes> given_failure;
  // Table 1's ranking is no share, so the two are not compared: the share of hazards that were not
  // sensed by the time the robot could still have stopped.
  CountedShare not_sensed;
};

struct MeasuredFmea {
  double slow_below_mps = 0;
  std::array<MeasuredClass, kNumHazardClasses> classes;
  // Table 3, lower half.
  std::array<std::array<ComparedShare, kNumEffects>, kNumFailureModes> effect_of_mode;
  FmeaTables experts;
};

// What physics showed of one failure: its effect, 0 to 4 for E1 to E5, by what the robot could do
// afterwards and by the energy of its fall or blow.
struct ObservedEffect {
  FailureMode mode = FailureMode::kVeerOff;
  std::size_t effect = 0;
};
struct ObservedDetection {
  HazardClass hazard_class = HazardClass::kBlindObject;
  bool in_time = false;  // sensed while the robot could still have stopped
};

// Encounters passed over and passed beside count alike; exposures, whose failures are a metre and
// not an encounter, are left out. `class_of_type`: the class of each hazard type; one that is not
// in it is left out.
MeasuredFmea MeasureFmea(const std::vector<Encounter>& encounters,
                         const std::map<std::string, HazardClass>& class_of_type,
                         double slow_below_mps, const FmeaTables& experts,
                         const std::vector<ObservedEffect>& effects = {},
                         const std::vector<ObservedDetection>& detections = {});

}  // namespace floorproof

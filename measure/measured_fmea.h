// SPDX-License-Identifier: Apache-2.0
// The tables of the hTetro FMEA paper (htetro-fmea-coverage, Tables 1 to 3), counted in encounters
// instead of estimated, with the experts' figures beside.
#pragma once

#include <array>
#include <map>
#include <optional>
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
  // sensed by the time the robot could still have stopped. Of what can be driven over, those that
  // the plan led over.
  CountedShare not_sensed;
};

// What a fall or blow does to a robot, by the drop that has as much energy a kilogram: one edge of
// the robot let fall from that height while the other rests on the floor, m g h / 2. So it is said
// of any robot, and as handling tests of equipment say it (drop and topple, IEC 60068-2-31).
// Nothing in physics says where damage begins: these are assumptions, and whoever knows the robot
// sets them. The first is just beyond the thresholds that makers of floor robots allow, 10 to 22
// mm, from which they come down again every day, an edge at a time; the second is four times that.
struct DamageLimits {
  double recoverable_drop_m = 0.025, lasting_drop_m = 0.1;
};
// Of a failure, 0 to 4 for E1 to E5 (docs/results.md); none: what became of the robot was not seen.
std::optional<std::size_t> EffectOf(const Encounter& failed, const DamageLimits& limits);

struct MeasuredFmea {
  double slow_below_mps = 0;
  DamageLimits limits;
  std::array<MeasuredClass, kNumHazardClasses> classes;
  // Table 3, lower half.
  std::array<std::array<ComparedShare, kNumEffects>, kNumFailureModes> effect_of_mode;
  FmeaTables experts;
};

// Encounters passed over and passed beside count alike; exposures, whose failures are a metre and
// not an encounter, are left out. `class_of_type`: the class of each hazard type; one that is not
// in it is left out.
MeasuredFmea MeasureFmea(const std::vector<Encounter>& encounters,
                         const std::map<std::string, HazardClass>& class_of_type,
                         double slow_below_mps, const FmeaTables& experts,
                         const DamageLimits& limits = {});

}  // namespace floorproof

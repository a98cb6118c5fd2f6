// SPDX-License-Identifier: Apache-2.0
#include "measure/measured_fmea.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "env/geometry/geometry.h"
#include "stats/binomial.h"

namespace floorproof {
namespace {

// What came of the encounters of one row.
struct Counts {
  int encounters = 0, censored = 0;
  std::array<int, kNumFailureModes> modes = {};

  void Add(const Encounter& e) {
    if (e.outcome == Encounter::Outcome::kCensored) {
      ++censored;
      return;
    }
    ++encounters;
    if (e.outcome == Encounter::Outcome::kFailed) ++modes[static_cast<std::size_t>(e.mode)];
  }
  int failures() const {
    int sum = 0;
    for (const int count : modes) sum += count;
    return sum;
  }
  EncounterShares Shares() const {
    EncounterShares shares;
    shares.encounters = encounters;
    shares.censored = censored;
    shares.none = Counted(encounters - failures(), encounters);
    for (std::size_t m = 0; m < modes.size(); ++m) shares.modes[m] = Counted(modes[m], encounters);
    return shares;
  }
};

struct ClassCounts {
  Counts all;
  std::array<std::array<Counts, 2>, kLeadingSides.size()> by_way;
  int sensed = 0, not_sensed = 0;

  // A drop that is passed by lies under no sensor, nor would the robot have to stop.
  void AddSensed(const Encounter& e, HazardClass is) {
    const bool stands = is == HazardClass::kBlindObject || is == HazardClass::kGlass;
    if (!stands && e.passage == Passage::kBeside) return;
    sensed += e.sensed == Encounter::Sensed::kInTime;
    not_sensed += e.sensed == Encounter::Sensed::kNotInTime;
  }
};

MeasuredClass Measured(const ClassCounts& counts,
                       const std::array<double, kNumFailureModes>& experts) {
  MeasuredClass measured;
  measured.all = counts.all.Shares();
  for (std::size_t side = 0; side < kLeadingSides.size(); ++side)
    for (std::size_t fast = 0; fast < 2; ++fast)
      measured.by_way[side][fast] = counts.by_way[side][fast].Shares();
  for (std::size_t m = 0; m < experts.size(); ++m)
    measured.given_failure[m] = {Counted(counts.all.modes[m], counts.all.failures()), experts[m]};
  measured.not_sensed = Counted(counts.not_sensed, counts.not_sensed + counts.sensed);
  return measured;
}

}  // namespace

CountedShare Counted(int events, int of) {
  return {events, of, ClopperPearson(events, of, kReportedConfidence)};
}

LeadingSide LeadingSideOf(double lead_rad) {
  const double off_axis = std::abs(std::asin(std::clamp(std::sin(lead_rad), -1.0, 1.0)));
  if (off_axis < kPi / 6) return LeadingSide::kForward;
  return off_axis > kPi / 3 ? LeadingSide::kSideways : LeadingSide::kDiagonal;
}

std::optional<std::size_t> EffectOf(const Encounter& failed, const DamageLimits& limits) {
  constexpr std::size_t kE1 = 0, kE2 = 1, kE3 = 2, kE4 = 3, kE5 = 4;
  constexpr double kGravity_mps2 = 9.81;
  if (failed.outcome != Encounter::Outcome::kFailed || failed.after == Encounter::After::kUnseen ||
      !(failed.at.mass_kg > 0))
    return std::nullopt;
  const double drop_m = 2 * failed.energy_j / (failed.at.mass_kg * kGravity_mps2);
  const bool alone = failed.after == Encounter::After::kRecovered;
  if (drop_m >= limits.lasting_drop_m) return alone ? kE4 : kE5;
  if (!alone) return kE3;
  return drop_m >= limits.recoverable_drop_m ? kE2 : kE1;
}

MeasuredFmea MeasureFmea(const std::vector<Encounter>& encounters,
                         const std::map<std::string, HazardClass>& class_of_type,
                         double slow_below_mps, const FmeaTables& experts,
                         const DamageLimits& limits) {
  MeasuredFmea fmea;
  fmea.slow_below_mps = slow_below_mps;
  fmea.limits = limits;
  fmea.experts = experts;
  std::array<ClassCounts, kNumHazardClasses> counts;
  std::array<std::vector<std::string>, kNumHazardClasses> types;
  std::array<std::array<int, kNumEffects>, kNumFailureModes> effects = {};
  for (const Encounter& e : encounters) {
    const auto found = class_of_type.find(e.type);
    if (found == class_of_type.end()) continue;
    const auto c = static_cast<std::size_t>(found->second);
    counts[c].all.Add(e);
    counts[c].AddSensed(e, found->second);
    if (const auto effect = EffectOf(e, limits))
      ++effects[static_cast<std::size_t>(e.mode)].at(*effect);
    const auto side = static_cast<std::size_t>(LeadingSideOf(e.at.lead_rad));
    counts[c].by_way[side][e.at.speed_mps >= slow_below_mps].Add(e);
    const auto at = std::lower_bound(types[c].begin(), types[c].end(), e.type);
    if (at == types[c].end() || *at != e.type) types[c].insert(at, e.type);
  }
  for (std::size_t c = 0; c < kNumHazardClasses; ++c) {
    fmea.classes[c] = Measured(counts[c], experts.mode_of_class[c]);
    fmea.classes[c].types = types[c];
  }
  for (std::size_t m = 0; m < kNumFailureModes; ++m) {
    const int failures = std::accumulate(effects[m].begin(), effects[m].end(), 0);
    for (std::size_t k = 0; k < kNumEffects; ++k)
      fmea.effect_of_mode[m][k] = {Counted(effects[m][k], failures), experts.effect_of_mode[m][k]};
  }
  return fmea;
}

}  // namespace floorproof

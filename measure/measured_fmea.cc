// SPDX-License-Identifier: Apache-2.0
#include "measure/measured_fmea.h"

#include <algorithm>
#include <cmath>

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

MeasuredFmea MeasureFmea(const std::vector<Encounter>& encounters,
                         const std::map<std::string, HazardClass>& class_of_type,
                         double slow_below_mps, const FmeaTables& experts,
                         const std::vector<ObservedEffect>& effects,
                         const std::vector<ObservedDetection>& detections) {
  MeasuredFmea fmea;
  fmea.slow_below_mps = slow_below_mps;
  fmea.experts = experts;
  std::array<ClassCounts, kNumHazardClasses> counts;
  std::array<std::vector<std::string>, kNumHazardClasses> types;
  for (const Encounter& e : encounters) {
    const auto found = class_of_type.find(e.type);
    if (found == class_of_type.end()) continue;
    const auto c = static_cast<std::size_t>(found->second);
    counts[c].all.Add(e);
    const auto side = static_cast<std::size_t>(LeadingSideOf(e.at.lead_rad));
    counts[c].by_way[side][e.at.speed_mps >= slow_below_mps].Add(e);
    const auto at = std::lower_bound(types[c].begin(), types[c].end(), e.type);
    if (at == types[c].end() || *at != e.type) types[c].insert(at, e.type);
  }
  for (std::size_t c = 0; c < kNumHazardClasses; ++c) {
    fmea.classes[c] = Measured(counts[c], experts.mode_of_class[c]);
    fmea.classes[c].types = types[c];
    int sensed = 0, met = 0;
    for (const ObservedDetection& each : detections)
      if (static_cast<std::size_t>(each.hazard_class) == c) {
        ++met;
        sensed += each.in_time;
      }
    fmea.classes[c].not_sensed = Counted(met - sensed, met);
  }
  for (std::size_t m = 0; m < kNumFailureModes; ++m) {
    std::array<int, kNumEffects> seen = {};
    int failures = 0;
    for (const ObservedEffect& each : effects)
      if (static_cast<std::size_t>(each.mode) == m) {
        ++failures;
        ++seen.at(each.effect);
      }
    for (std::size_t k = 0; k < kNumEffects; ++k)
      fmea.effect_of_mode[m][k] = {Counted(seen[k], failures), experts.effect_of_mode[m][k]};
  }
  return fmea;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/rare/rare_score.h"

#include <algorithm>
#include <limits>

namespace floorproof {
namespace {

constexpr const char* kAny = "any_failure";

}  // namespace

RareScore::RareScore(const std::string& mode, std::span<const NamedDetector> detectors) {
  std::string known = kAny;
  for (int m = 0; m < kNumFailureModes; ++m) {
    known += std::string(", ") + std::string(Name(static_cast<FailureMode>(m)));
    if (mode == Name(static_cast<FailureMode>(m))) mode_ = static_cast<FailureMode>(m);
  }
  if (!mode_ && mode != kAny) throw InputError({"--mode", 0}, "", mode, "must be one of " + known);
  const bool told = std::ranges::any_of(
      detectors, [&](const NamedDetector& d) { return !mode_ || d.detector->mode() == *mode_; });
  if (!told)
    throw InputError({"--mode", 0}, "", mode,
                     "no detector of the scenario tells how far from it a drive was");
}

TrialResult RareScore::Of(const EpisodeRow& row) const {
  if (!row.counts()) return {false, std::numeric_limits<double>::infinity(), 0, false};
  double least = std::numeric_limits<double>::infinity(), sum = 0;
  for (int m = 0; m < kNumFailureModes; ++m) {
    const auto mode = static_cast<FailureMode>(m);
    const std::optional<double> margin = row.metric(MarginOf(mode));
    if (!margin) continue;
    if (!mode_ || mode == *mode_) least = std::min(least, *margin);
    sum += std::clamp(*margin, -1.0, 1.0);
  }
  const auto of = [&](double Metrics::*member) { return row.metric(member).value_or(0); };
  // Each in units of which one is a lot.
  double trouble = of(&Metrics::way_lost_m) / 0.1;
  if (mode_ == FailureMode::kBounceBack)
    trouble = of(&Metrics::max_contact_n) / 100 + of(&Metrics::max_cross_track_m) / 0.1;
  if (!mode_) trouble -= sum;
  const bool failed =
      mode_ ? row.events_of[static_cast<std::size_t>(*mode_)] > 0 : row.any_failure();
  return {failed, least, -trouble};
}

}  // namespace floorproof

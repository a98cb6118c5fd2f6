// SPDX-License-Identifier: Apache-2.0
// What a campaign keeps of an episode: a row of its table.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "env/core/event.h"
#include "run/episode/episode.h"

namespace floorproof {

// Metrics in the order of result.json; a column each.
inline constexpr std::array<std::string_view, 20> kMetricColumns = {"coverage",
                                                                    "overlap",
                                                                    "path_length_m",
                                                                    "duration_s",
                                                                    "energy_j",
                                                                    "charge_ah",
                                                                    "least_battery_v",
                                                                    "battery_left",
                                                                    "max_cross_track_m",
                                                                    "mean_cross_track_m",
                                                                    "turns",
                                                                    "cumulative_risk",
                                                                    "interventions",
                                                                    "reactions",
                                                                    "max_estimate_error_m",
                                                                    "mean_estimate_error_m",
                                                                    "p95_estimate_error_m",
                                                                    "mean_estimate_spread_m",
                                                                    "contacts",
                                                                    "max_impulse_ns"};

inline constexpr std::size_t kDuration = 3;  // its place among them
static_assert(kMetricColumns[kDuration] == "duration_s");

struct EpisodeRow {
  std::string variant;
  std::uint64_t episode = 0;
  std::string outcome, message;
  std::array<int, kNumFailureModes> events_of{};                       // by mode
  std::array<std::optional<double>, kMetricColumns.size()> metrics{};  // none: not driven
  std::string drawn = "{}", plan = "{}", events = "[]";                // JSON, as in result.json
  double wall_s = 0;                                                   // told apart: not a result

  bool failed() const { return outcome == "failure" || outcome == "timeout"; }
  // Counts in rates: its outcome is the robot's.
  bool counts() const { return outcome != "error" && outcome != "not_planned"; }
  bool driven() const { return metrics[kDuration].has_value(); }
  // With a failure event, or, as a run that covered too little, without one.
  bool any_failure() const;
  double metric(std::string_view name) const;  // 0 where there is none
};

EpisodeRow MakeRow(const std::string& variant, const Scenario& scenario, const std::string& plan,
                   const EpisodeRecord& record);

// One line of text, and back; throws InternalError on any other text.
std::string ToLine(const EpisodeRow& row);
EpisodeRow FromLine(std::string_view line);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// What an episode is measured by, as one table. result.json, campaign.sqlite, episodes.csv,
// summary.json, comparisons and the report are made from it, and docs/results.md is held against
// it. A new metric is a member, its row below, and the line that measures it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

#include "env/core/event.h"

namespace floorproof {

// What each means stands in kMetrics.
struct Metrics {
  double coverage = 0, overlap = 0, revisited = 0, extra_visits = 0;
  double path_length_m = 0, way_lost_m = 0;
  double duration_s = 0;
  double energy_j = 0;
  double charge_ah = 0;
  double least_battery_v = 0;
  std::optional<double> battery_left;
  double max_cross_track_m = 0, mean_cross_track_m = 0;
  int turns = 0;
  std::optional<double> cumulative_risk;
  int interventions = 0;
  int reactions = 0;
  int stops_missed = 0;
  std::optional<double> end_off_m, plan_left_m;
  double max_estimate_error_m = 0, mean_estimate_error_m = 0, p95_estimate_error_m = 0;
  double mean_estimate_position_std_m = 0;
  int contacts = 0;
  double contact_s = 0, contact_m = 0, max_contact_n = 0;
  double max_impulse_ns = 0;
  std::optional<double> alarms, false_alarms, detection_s, held_s;
  std::optional<double> samples_taken, max_sample_off_m, dirt_gathering, audit_score;
  std::optional<double> veer_off_margin, stuck_margin, roll_over_margin, bounce_back_margin;
};

struct MetricColumn {
  // Its member's type is the metric's: a real number, a count, or a number that may be missing.
  using Member = std::variant<double Metrics::*, int Metrics::*, std::optional<double> Metrics::*>;

  std::string_view name;  // in all files
  std::string_view unit;  // as people write it; empty: a share, a count or a sum without one
  Member member;
  std::string_view help;  // a line of docs/results.md
  // An episode that a failure cuts short has less of it, for no merit of its own: pairs of episodes
  // are compared by it where both succeed.
  bool needs_success = false;
  std::string_view former_name = {};  // in files of earlier versions, which are still read

  std::optional<double> Of(const Metrics& metrics) const {
    return std::visit([&](auto m) -> std::optional<double> { return metrics.*m; }, member);
  }
};

// In the order of result.json.
inline constexpr auto kMetrics = std::to_array<MetricColumn>({
    {"coverage", "", &Metrics::coverage,
     "share of the floor that the tool can reach, that it swept"},
    {"overlap", "", &Metrics::overlap,
     "share of what was swept, that was swept in two passes or more"},
    {"revisited", "", &Metrics::revisited,
     "share of the floor that the tool can reach, that it swept in two passes or more"},
    {"extra_visits", "", &Metrics::extra_visits,
     "passes beyond the first, over the floor that the tool can reach: 1 is a second pass over all "
     "of it"},
    {"path_length_m", "m", &Metrics::path_length_m, "way driven", true},
    {"way_lost_m", "m", &Metrics::way_lost_m,
     "way that was commanded and not driven: slip, and being held", true},
    {"duration_s", "s", &Metrics::duration_s, "simulated time", true},
    {"energy_j", "J", &Metrics::energy_j, "energy at the battery's terminals", true},
    {"charge_ah", "Ah", &Metrics::charge_ah, "charge drawn from the battery", true},
    {"least_battery_v", "V", &Metrics::least_battery_v,
     "lowest voltage at the battery's terminals"},
    {"battery_left", "", &Metrics::battery_left,
     "share of the battery's capacity that is left; none where the scenario states no capacity"},
    {"max_cross_track_m", "m", &Metrics::max_cross_track_m,
     "greatest distance of the true place from the path"},
    {"mean_cross_track_m", "m", &Metrics::mean_cross_track_m, "that distance, mean over time"},
    {"turns", "", &Metrics::turns, "turns of the plan", true},
    {"cumulative_risk", "", &Metrics::cumulative_risk,
     "risk factors of the cells that the robot's centre came to, as driven, each visit counted; "
     "none "
     "where neither a planner nor the key `risk` asks for risk",
     true},
    {"interventions", "", &Metrics::interventions, "times that a person set the robot down anew"},
    {"reactions", "", &Metrics::reactions, "times that it went back from what it met (`react`)"},
    {"stops_missed", "", &Metrics::stops_missed,
     "stops of the plan, its end among them, that a robot which cannot turn on the spot passed "
     "beside: nothing was done there"},
    {"end_off_m", "m", &Metrics::end_off_m,
     "distance of the true place at the end from the plan's end; none where there was no plan "
     "beforehand"},
    {"plan_left_m", "m", &Metrics::plan_left_m,
     "length of the plan that the robot's true place never came to, within `success.arrival_m`; "
     "none "
     "where there was no plan beforehand"},
    {"max_estimate_error_m", "m", &Metrics::max_estimate_error_m,
     "greatest distance of the estimated place from the true one"},
    {"mean_estimate_error_m", "m", &Metrics::mean_estimate_error_m,
     "that distance, mean over time"},
    {"p95_estimate_error_m", "m", &Metrics::p95_estimate_error_m,
     "below which it was for 95 % of the time, to a millimetre"},
    {"mean_estimate_position_std_m", "m", &Metrics::mean_estimate_position_std_m,
     "standard deviation of the place that the estimator itself believed in, mean over time", false,
     "mean_estimate_spread_m"},
    {"contacts", "", &Metrics::contacts, "times that the body met an obstacle"},
    {"contact_s", "s", &Metrics::contact_s,
     "time in which the body touched an obstacle; what lets go for less than 0.25 s touches", true},
    {"contact_m", "m", &Metrics::contact_m, "way driven while it did", true},
    {"max_contact_n", "N", &Metrics::max_contact_n,
     "greatest force with which obstacles pushed the body, the mean over a physics step"},
    {"max_impulse_ns", "N s", &Metrics::max_impulse_ns,
     "greatest impulse of a contact in one physics step"},
    {"alarms", "", &Metrics::alarms,
     "alarms that the robot's monitors raised; none without `safety`"},
    {"false_alarms", "", &Metrics::false_alarms,
     "of them, those raised before anything was broken; none without `safety`"},
    {"detection_s", "s", &Metrics::detection_s,
     "from when the first fault came to the first alarm after it; none where there was no fault, "
     "or "
     "no alarm"},
    {"held_s", "s", &Metrics::held_s,
     "time for which its supervision held the robot still; none without `safety`"},
    {"samples_taken", "", &Metrics::samples_taken,
     "samples that an audit took; none where the plan takes none", true},
    {"max_sample_off_m", "m", &Metrics::max_sample_off_m,
     "greatest distance of a tape's true place from the place that was to be sampled"},
    {"dirt_gathering", "", &Metrics::dirt_gathering,
     "share of the samples that are dirty; none without `dirt`"},
    {"audit_score", "", &Metrics::audit_score,
     "how clean the region is by its samples, 1 as if nothing lay there; none without `dirt`"},
    {"veer_off_margin", "", &Metrics::veer_off_margin,
     "how far it stayed from veering off, as a share of the limit that applies at that place "
     "(max_cross_track_m, or half of a narrower lane): 1 nowhere nearer, 0 or less at or beyond "
     "it, which is a failure only where it lasts; none without the detector"},
    {"stuck_margin", "", &Metrics::stuck_margin, "the same of getting stuck"},
    {"roll_over_margin", "", &Metrics::roll_over_margin, "the same of rolling over"},
    {"bounce_back_margin", "", &Metrics::bounce_back_margin, "the same of bouncing back"},
});

// The member that says how near a drive came to that failure.
constexpr std::optional<double> Metrics::*MarginOf(FailureMode mode) {
  switch (mode) {
    case FailureMode::kStuck:
      return &Metrics::stuck_margin;
    case FailureMode::kRollOver:
      return &Metrics::roll_over_margin;
    case FailureMode::kBounceBack:
      return &Metrics::bounce_back_margin;
    case FailureMode::kVeerOff:
      break;
  }
  return &Metrics::veer_off_margin;
}

// By its name, of this version or an earlier one; nullptr: there is none.
constexpr const MetricColumn* FindMetric(std::string_view name) {
  for (const MetricColumn& column : kMetrics)
    if (name == column.name || (!name.empty() && name == column.former_name)) return &column;
  return nullptr;
}

// The place of a member in the table; no constant where it has no row.
template <class T>
constexpr std::size_t MetricIndex(T Metrics::*member) {
  for (std::size_t i = 0; i < kMetrics.size(); ++i)
    if (kMetrics[i].member == MetricColumn::Member(member)) return i;
  throw "no metric";
}

}  // namespace floorproof

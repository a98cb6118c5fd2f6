// SPDX-License-Identifier: Apache-2.0
// What a campaign keeps of an episode: a row of its table.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "env/core/encounter.h"
#include "env/core/event.h"
#include "run/episode/metrics.h"
#include "run/episode/timeout.h"

namespace floorproof {

struct EpisodeRecord;
struct ScenarioSpec;

struct EpisodeRow {
  std::string variant;
  std::uint64_t episode = 0;
  std::string outcome, message;
  std::array<int, kNumFailureModes> events_of{};                 // by mode
  std::array<std::optional<double>, kMetrics.size()> metrics{};  // as kMetrics; none: not driven
  std::string drawn = "{}", plan = "{}", events = "[]";          // JSON, as in result.json
  std::string timeout = "null";                                  // the same
  // What a program made as its plan (plan.csv); `plan` has its SHA-256 as `made`. Not in the table:
  // the store keeps it beside itself, and rows from there lack it.
  std::string made;
  // The hazards that it met. They have a table of their own: rows from the store lack them
  // (CampaignStore::EncountersOf).
  std::vector<Encounter> encounters;
  // Of a drive that did not succeed, where replays were asked for: the bytes of its replay.bin. Not
  // in the table (replay_shelf.h).
  std::string replay;
  double wall_s = 0;  // told apart: not a result

  // Counts in rates: its outcome is the robot's.
  bool counts() const { return outcome != "error" && outcome != "not_planned"; }
  bool driven() const { return metric(&Metrics::duration_s).has_value(); }
  // Of what came out, without what was drawn: outcome, events, metrics, plan.
  std::string ResultHash() const;
  // With a failure event, or, as a run that covered too little, without one.
  bool any_failure() const;
  template <class T>
  std::optional<double> metric(T Metrics::*member) const {
    return metrics[MetricIndex(member)];
  }
};

EpisodeRow MakeRow(const std::string& variant, const ScenarioSpec& spec, const std::string& plan,
                   const EpisodeRecord& record);

// Its events; their evidence is left out. Throws InternalError where the text is damaged.
std::vector<Event> EventsOf(const EpisodeRow& row);

// Where its time ran out, if that is its outcome. Throws InternalError where the text is damaged.
std::optional<Timeout> TimeoutOf(const EpisodeRow& row);

// The SHA-256 of the plan that a program made for it, as its `plan` says; empty: none did. Throws
// InternalError where the text is damaged.
std::string MadePlan(const EpisodeRow& row);

// Why what stands in the row cannot be used: its texts are no JSON of their kinds, its outcome is
// none. Empty when it can.
std::string WhyUnreadableRow(const EpisodeRow& row);

// One line of text, and back; throws InternalError on any other text.
std::string ToLine(const EpisodeRow& row);
EpisodeRow FromLine(std::string_view line);

}  // namespace floorproof

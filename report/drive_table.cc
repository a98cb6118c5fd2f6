// SPDX-License-Identifier: Apache-2.0
#include "report/drive_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/quantity.h"
#include "base/words.h"
#include "env/core/failure_text.h"
#include "report/dirt_pictures.h"
#include "report/pictures.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

// "stuck at 198.8 s: stood still for 7.6 s before 'plank' (step, 40 mm), at x 5.58, y 2.67 m; ..."
std::string EventText(const Event& e, const HazardMap& map) {
  return fmt::format("{} at {} s: {}; effect {}", FailureName(e), FixedText(e.t_s, 1),
                     FailureSentence(e, map), e.effect);
}

// With several failures each has a row of its own; the maps name them by the same numbers.
void AddVerdict(const World& world, const EpisodeRecord& record, FactTable& table) {
  constexpr std::size_t kShown = 9;
  const std::size_t n = record.events.size();
  std::string text(Name(record.outcome));
  if (n == 1) text += ", " + EventText(record.events.front(), world.site.map);
  if (n > 1) text += ", the robot failed " + CountText(n, "time");
  if (const std::size_t times = record.interventions.size(); times > 0)
    text += ", helped " + CountText(times, "time");
  if (!record.message.empty()) text += ": " + record.message;
  table.Add({"Verdict", {text, record.outcome == Outcome::kSuccess ? Tone::kGood : Tone::kBad}});
  for (std::size_t i = 0; n > 1 && i < std::min(n, kShown); ++i)
    table.Add({fmt::format("Failure {}", i + 1), EventText(record.events[i], world.site.map)});
  if (n > kShown)
    table.Add(
        {"Further failures", FixedText(static_cast<double>(n - kShown), 0) + ", see result.json"});
}

// What a supervised robot noticed and did.
void AddSupervision(const EpisodeRecord& record, FactTable& table) {
  if (record.alarms.empty()) return;
  const RaisedAlarm& first = record.alarms.front();
  std::string text = fmt::format("{}, the first at {} s by {}{}",
                                 CountText(record.alarms.size(), "alarm"), FixedText(first.t_s, 1),
                                 first.monitor, first.wheel.empty() ? "" : " of " + first.wheel);
  for (const SafetyRow& row : record.safety)
    if (row.reason.starts_with(kDrivenWithout)) text += "; " + row.reason;
  if (const double held_s = record.metrics.held_s.value_or(0); held_s > 0)
    text += "; held still for " + FixedText(held_s, 1) + " s";
  table.Add({"Supervision", text + "; see safety.csv"});
}

// The remaining margin and its limit, in the unit of the mode. Rolling over has several limits: the
// share of the nearest one is given.
std::string MarginText(const Margin& margin) {
  if (margin.mode == FailureMode::kRollOver) return PercentText(margin.share, 2) + " left";
  const auto text = [&](double value) {
    return margin.mode == FailureMode::kBounceBack ? NumberText(value) + " m/s" : LengthText(value);
  };
  return text(margin.value) + " of " + text(margin.value / margin.share) + " left";
}

// Of the modes that did not fail, what was left of each limit, the nearest first; of one that was
// never neared nothing is said.
std::string MarginsText(const EpisodeRecord& record) {
  std::array<const Margin*, kNumFailureModes> least{};
  const auto of = [&](FailureMode mode) -> const Margin*& {
    return least.at(static_cast<std::size_t>(mode));
  };
  for (const Margin& margin : record.margins)
    if (of(margin.mode) == nullptr || margin.share < of(margin.mode)->share)
      of(margin.mode) = &margin;
  for (const Event& event : record.events) of(event.mode) = nullptr;
  std::ranges::stable_sort(least, {}, [](const Margin* m) { return m == nullptr ? 1 : m->share; });
  std::string text;
  for (const Margin* margin : least) {
    if (margin == nullptr || margin->share >= 1) continue;
    text += (text.empty() ? "" : "; ") + Words(Name(margin->mode)) + ", ";
    text += margin->share > 0 ? MarginText(*margin)
                              : "at or beyond its limit, though not for long enough to count";
  }
  return text;
}

// The true distance from the plan's end, and the length that was left out.
std::string ArrivalText(const Arrival& how) {
  if (!how.off_m) return "";
  std::string text = LengthText(*how.off_m) + " from the plan's end";
  if (how.believed && *how.off_m > how.most_off_m) text += ", though it believed that it was there";
  constexpr double kNotable = 0.005;
  if (how.left_m && *how.left_m > kNotable * how.plan_m)
    text += "; " + LengthText(*how.left_m) + " of the plan left out";
  return text;
}

std::string Title(const Scenario& s) {
  const std::string plan =
      s.spec.planner_name.empty() ? s.spec.plan_file.filename().string() : s.spec.planner_name;
  return PictureTitle(s.world) + (plan.empty() ? "" : ", " + plan);
}

void AddCellDrive(const EpisodeRecord& record, double drive_s, FactTable& table) {
  const Metrics& m = record.metrics;
  table.Add({"Covered", fmt::format("{} of the cells, {} twice or more", PercentText(m.coverage),
                                    PercentText(m.revisited))});
  table.Add({"Drive", fmt::format("{}, {}; in {}", CountText(record.steps - 1, "move"),
                                  LengthText(m.path_length_m), TimeText(drive_s))});
}

void AddPhysicsDrive(const EpisodeRecord& record, double drive_s, FactTable& table) {
  const Metrics& m = record.metrics;
  table.Add({"Covered", PercentText(m.coverage) + " of the floor that the tool can reach"});
  table.Add(
      {"Drive", fmt::format("{}, {}, {}; simulated in {}, {} times as fast", TimeText(m.duration_s),
                            LengthText(m.path_length_m), EnergyText(m.energy_j), TimeText(drive_s),
                            NumberText(m.duration_s / drive_s, 2))});
  const double off_m = m.max_cross_track_m;
  table.Add({"Off the path",
             (off_m < 1 ? FixedText(1000 * off_m, 0) + " mm" : LengthText(off_m)) + " at most"});
  if (const std::string text = record.arrival ? ArrivalText(*record.arrival) : ""; !text.empty())
    table.Add({"At the end", text});
  if (const std::string text = MarginsText(record); !text.empty())
    table.Add({"Nearest to failing", text});
}

}  // namespace

FactTable DriveTable(const Scenario& s, const PlanResult& plan, const EpisodeRecord& record,
                     double drive_s) {
  FactTable table;
  table.SetTitle(Title(s));
  AddVerdict(s.world, record, table);
  if (s.spec.episode.drive == "cells")
    AddCellDrive(record, drive_s, table);
  else
    AddPhysicsDrive(record, drive_s, table);
  AddSupervision(record, table);
  if (record.audit) table.Add({"Audit", AuditText(s.world, plan, *record.audit)});
  return table;
}

}  // namespace floorproof

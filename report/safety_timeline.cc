// SPDX-License-Identifier: Apache-2.0
#include "report/safety_timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/quantity.h"
#include "base/words.h"
#include "report/pictures.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

// Okabe & Ito's palette: the colour-blind tell them apart.
constexpr Rgb kBlue = {0, 114, 178}, kSky = {86, 180, 233}, kGreen = {0, 158, 115},
              kYellow = {240, 228, 66}, kOrange = {230, 159, 0}, kRed = {213, 94, 0},
              kPurple = {204, 121, 167}, kBroken = {90, 96, 104};

Rgb ColourOf(DecisionState state) {
  constexpr Rgb kColours[] = {kGreen, kOrange, kSky, kBlue, kRed};
  return kColours[static_cast<int>(state)];
}
Rgb ColourOf(SafetyLevel level) {
  constexpr Rgb kColours[] = {kGreen, kSky, kYellow, kOrange, kRed};
  return kColours[static_cast<int>(level)];
}

// A value from each change on, as spans; the last of those at one time counts.
template <class T>
std::vector<TimelineSpan> Spans(const std::vector<std::pair<double, T>>& changes, double end_s) {
  std::vector<TimelineSpan> spans;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const double to_s = i + 1 < changes.size() ? changes[i + 1].first : end_s;
    if (to_s <= changes[i].first) continue;
    if (i > 0 && !spans.empty() && spans.back().text == Words(Name(changes[i].second)))
      spans.back().to_s = to_s;
    else
      spans.push_back(
          {changes[i].first, to_s, ColourOf(changes[i].second), Words(Name(changes[i].second))});
  }
  return spans;
}

// What breaks, and of what.
std::string NameOf(const ScheduledFault& fault) {
  std::string name = Words(fault.id.empty() ? fault.type : fault.id);
  if (!fault.fault || !fault.id.empty()) return name;
  for (const ParamDoc& doc : DocumentParams(*fault.fault))
    if (doc.name == "wheel" || doc.name == "sensor") name += ", " + doc.default_text;
  return name;
}

// When it truly was there, whatever the robot noticed.
std::vector<TimelineSpan> Broken(const ScheduledFault& fault, double end_s) {
  std::vector<TimelineSpan> spans;
  const FaultTiming& timing = fault.timing;
  const double last_s = std::min(end_s, timing.onset_s + timing.duration_s.value_or(end_s));
  const double period_s = timing.period_s.value_or(last_s + 1);
  const double each_s = timing.period_s ? timing.duty * period_s : period_s;
  constexpr std::size_t kMost = 2000;  // more cannot be told apart
  for (double from_s = timing.onset_s; from_s < last_s && spans.size() < kMost; from_s += period_s)
    spans.push_back({from_s, std::min(last_s, from_s + each_s), kBroken, Words(fault.type)});
  return spans;
}

// Wheels that it has done without, each from then on.
TimelineRow Without(const EpisodeRecord& record, double end_s) {
  TimelineRow row{"driven without", {}, true};
  std::string wheels;
  for (const SafetyRow& change : record.safety) {
    const std::string_view reason = change.reason;
    if (!reason.starts_with(kDrivenWithout)) continue;
    if (!row.spans.empty()) row.spans.back().to_s = change.t_s;
    wheels += (wheels.empty() ? "" : " ") + std::string(reason.substr(kDrivenWithout.size()));
    row.spans.push_back({change.t_s, end_s, kBlue, wheels});
  }
  return row;
}

std::vector<TimelineSpan> Speed(const std::vector<SpeedShare>& shares, double end_s) {
  std::vector<TimelineSpan> spans;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double to_s = i + 1 < shares.size() ? shares[i + 1].t_s : end_s;
    const double share = shares[i].share;
    spans.push_back({shares[i].t_s, to_s,
                     share == 0  ? kRed
                     : share < 1 ? kOrange
                                 : kGreen,
                     share == 0  ? "stands"
                     : share < 1 ? PercentText(share)
                                 : "full speed"});
  }
  return spans;
}

}  // namespace

Timeline SafetyTimeline(const Scenario& s, const EpisodeRecord& record) {
  const double end_s = record.metrics.duration_s;
  Timeline timeline;
  timeline.title = PictureTitle(s.world) + ": what was broken, noticed and done";
  timeline.notes = {fmt::format("{} after {}{}", Words(Name(record.outcome)), TimeText(end_s),
                                record.message.empty() ? "" : ": " + record.message)};
  timeline.end_s = end_s;
  for (const ScheduledFault& fault : s.world.faults)
    timeline.rows.push_back({"broken: " + NameOf(fault), Broken(fault, end_s), true});
  for (const RaisedAlarm& alarm : record.alarms) {
    const std::string name = "alarm: " + Words(alarm.monitor);
    auto row = std::ranges::find(timeline.rows, name, &TimelineRow::name);
    if (row == timeline.rows.end()) row = timeline.rows.insert(row, {name, {}, false});
    row->spans.push_back({alarm.t_s, alarm.until_s.value_or(end_s), kPurple, alarm.wheel});
  }
  const std::string& mission = s.spec.safety->mission.nodes[0].name;
  std::vector<std::pair<double, DecisionState>> machine = {{0, DecisionState::kNormal}};
  std::vector<std::pair<double, SafetyLevel>> level = {{0, SafetyLevel::kHigh}};
  TimelineCurve curve;
  curve.name = "safety state R";
  curve.steps = {{0, 0}};
  curve.most = 120;
  curve.colour = kBroken;
  std::vector<std::pair<double, double>> sums = {{0, 0}};
  bool adds_up = false;  // several skills of one time have failures
  for (const SafetyRow& row : record.safety) {
    machine.emplace_back(row.t_s, row.machine);
    if (row.node != mission && !(mission.empty() && row.node == "mission")) continue;
    level.emplace_back(row.t_s, row.level);
    curve.steps.emplace_back(row.t_s, row.safety_state);
    sums.emplace_back(row.t_s, row.sum);
    adds_up |= row.sum > row.safety_state;
    curve.most = std::max({curve.most, row.safety_state, row.sum});
  }
  const LevelLimits& limits = s.spec.safety->mission.levels;
  curve.levels = {{limits.high, ""},
                  {limits.medium, "weak above"},
                  {limits.weak, "serious above"},
                  {limits.serious, "fatal above"}};
  timeline.rows.push_back({"state machine", Spans(machine, end_s), true});
  timeline.rows.push_back({"safety level", Spans(level, end_s), true});
  if (const TimelineRow without = Without(record, end_s); !without.spans.empty())
    timeline.rows.push_back(without);
  timeline.rows.push_back({"speed", Speed(record.speed_shares, end_s), true});
  if (adds_up) {
    curve.behind = std::move(sums);
    curve.behind_colour = kPurple;
    timeline.legend.emplace_back("sum of R", kPurple);
  }
  timeline.curve = std::move(curve);
  for (const DecisionState state :
       {DecisionState::kNormal, DecisionState::kFaultMode, DecisionState::kAssessment,
        DecisionState::kReconfiguring, DecisionState::kAbort})
    timeline.legend.emplace_back(Words(Name(state)), ColourOf(state));
  for (const SafetyLevel of : {SafetyLevel::kHigh, SafetyLevel::kMedium, SafetyLevel::kWeak,
                               SafetyLevel::kSerious, SafetyLevel::kFatal})
    timeline.legend.emplace_back("level " + std::string(Name(of)), ColourOf(of));
  return timeline;
}

void WriteSafetyTimeline(const Scenario& s, const EpisodeRecord& record,
                         const std::filesystem::path& png) {
  WritePng(png, DrawTimeline(SafetyTimeline(s, record)));
}

}  // namespace floorproof

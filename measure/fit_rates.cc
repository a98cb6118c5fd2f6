// SPDX-License-Identifier: Apache-2.0
#include "measure/fit_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "base/round.h"
#include "env/geometry/geometry.h"
#include "measure/constant_rate.h"
#include "measure/penalised_rates.h"
#include "measure/rate_axes.h"
#include "measure/shared_frailty.h"

namespace floorproof {
namespace {

using Meetings = std::vector<const Encounter*>;

bool IsExposure(std::string_view type) { return type == kWallBeside || type == kFreeFloor; }

std::vector<double> CovariatesOf(const std::vector<RateAxis>& axes, bool mirrored,
                                 const Encounter& e) {
  Covariates covariates(axes, mirrored, e.size);
  const std::span<const double> x = covariates.Of(e.at);
  return {x.begin(), x.end()};
}

// All others are about a hazard, or how far the way along it is.
bool IsOfExposures(const ApproachColumn& column) {
  constexpr double Approach::*kOfExposures[] = {
      &Approach::speed_mps,         &Approach::wall_m,      &Approach::friction,
      &Approach::mass_kg,           &Approach::clearance_m, &Approach::estimate_error_m,
      &Approach::estimate_error_rad};
  return std::ranges::find(kOfExposures, column.member) != std::end(kOfExposures);
}

constexpr std::string_view kLead = "lead_rad";

std::vector<RateAxis> AxesOf(const Meetings& met, Manner manner, const RateFitOptions& options) {
  std::vector<RateAxis> axes;
  for (const auto& first : met.front()->size) {
    const std::string& key = first.first;
    const bool stated = std::all_of(met.begin(), met.end(), [&](const Encounter* e) {
      return std::any_of(e->size.begin(), e->size.end(),
                         [&](const auto& entry) { return entry.first == key; });
    });
    if (!stated) continue;
    axes.emplace_back();
    axes.back().name = key;
    axes.back().of_hazard = true;
  }
  const bool exposed = IsExposure(met.front()->type);
  for (const ApproachColumn& column : kApproach) {
    if (exposed && !IsOfExposures(column)) continue;
    if (!options.holonomic && column.name == kLead) continue;
    if (manner == Manner::kStraight && column.member == &Approach::turn_rad) continue;
    if (manner != Manner::kTurning && column.member == &Approach::turn_gap_m) continue;
    axes.emplace_back();
    axes.back().name = column.name;
  }
  std::vector<std::vector<double>> x;
  for (const Encounter* e : met) x.push_back(CovariatesOf(axes, options.mirrored, *e));
  for (std::size_t a = 0; a < axes.size(); ++a) {
    std::vector<double> values;
    for (const std::vector<double>& row : x) values.push_back(row[a]);
    const bool turns = !axes[a].of_hazard && axes[a].name == kLead;
    axes[a] = MakeRateAxis(axes[a].name, axes[a].of_hazard, std::move(values), turns ? 2 * kPi : 0);
  }
  return axes;
}

// Of a meeting, what one that was censored had of it. Where another hazard's failure ends it, to
// leave it out would leave out what was being cleared.
constexpr double kCensored = 0.5;

std::string StreamName(const KindRates& kind) {
  return fmt::format("risk_model.{}.{}.{}", kind.type, Name(kind.passage), Name(kind.manner));
}

// Meetings, or way. Of a meeting that failed half.
double ExposureOf(const KindRates& kind) {
  return kind.per_metre ? kind.way_m : kind.encounters - kind.censored - kind.any.events / 2.0;
}

// Where nothing failed it stays empty: SetUnseen sets it.
void SetAny(const std::vector<RateRow>& rows, KindRates& kind) {
  const std::string name = StreamName(kind) + ".any";
  const int n = static_cast<int>(rows.size());
  kind.any.events = static_cast<int>(std::ranges::count(rows, true, &RateRow::happened));
  if (kind.any.events == 0) return;
  if (kind.any.events < kLeastEvents)
    SetConstantRate(ExposureOf(kind), kind.any.events / ExposureOf(kind), name, kind.any);
  else if (!kind.per_metre && n - kind.any.events < kLeastEvents)
    SetConstantShare(n, name, kind.any);  // whose odds are eta, of meetings
  else
    kind.any = FitPredictor(rows, kind.per_metre, name, kind.axes);
}

// `failures` has the modes as numbers beside it.
void SetSplits(std::vector<RateRow> failures, std::vector<int> modes, KindRates& kind) {
  std::vector<int> order(kNumFailureModes);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](int mode) { return std::ranges::count(modes, mode); });
  for (std::size_t k = 0; k < kind.splits.size(); ++k) {
    const int mode = order[k], n = static_cast<int>(failures.size());
    const std::string name = StreamName(kind) + "." + std::string(Name(FailureMode(mode)));
    kind.splits[k].mode = FailureMode(mode);
    LinearPredictor& of = kind.splits[k].of;
    for (int i = 0; i < n; ++i) of.events += failures[i].happened = modes[i] == mode;
    if (n == 0)
      SetShare(1.0 / static_cast<double>(kNumFailureModes - k), of);
    else if (std::min(of.events, n - of.events) < kLeastEvents)
      SetConstantShare(n, name, of);
    else
      of = FitPredictor(failures, false, name, kind.axes);
    std::erase_if(failures, [](const RateRow& row) { return row.happened; });
    std::erase(modes, mode);
  }
}

// Of a kind that was measured; none where it was met too rarely.
std::optional<KindRates> FitKind(const Meetings& all, Manner manner, const RateFitOptions& options,
                                 UnmeasuredKind& unmeasured) {
  KindRates kind;
  kind.type = all.front()->type;
  kind.passage = all.front()->passage;
  kind.manner = manner;
  kind.per_metre = IsExposure(kind.type);
  kind.encounters = static_cast<int>(all.size());
  Meetings met;
  for (const Encounter* e : all) {
    kind.censored += e->outcome == Encounter::Outcome::kCensored;
    kind.cleared += e->outcome == Encounter::Outcome::kCleared;
    kind.way_m += e->way_m;
    if (!kind.per_metre || e->way_m > 0 || e->outcome == Encounter::Outcome::kFailed)
      met.push_back(e);
  }
  const int known = static_cast<int>(met.size()) - (kind.per_metre ? 0 : kind.censored);
  if (known < options.least_encounters) {
    unmeasured = {kind.type, kind.passage,
                  fmt::format("{} encounters with an outcome; at least {} are needed", known,
                              options.least_encounters)};
    return std::nullopt;
  }
  kind.axes = AxesOf(met, manner, options);
  std::vector<RateRow> rows, failures;
  std::vector<int> modes;
  for (const Encounter* e : met) {
    RateRow& row = rows.emplace_back();
    row.x = CovariatesOf(kind.axes, options.mirrored, *e);
    if (kind.per_metre)
      row.way_m = e->way_m;
    else if (e->outcome == Encounter::Outcome::kCensored)
      row.way_m = kCensored;
    row.happened = e->outcome == Encounter::Outcome::kFailed;
    if (!row.happened) continue;
    failures.push_back({row.x, 1, false});
    modes.push_back(static_cast<int>(e->mode));
  }
  kind.way_m = RoundedTo6(kind.way_m);
  SetAny(rows, kind);
  SetSplits(std::move(failures), std::move(modes), kind);
  return kind;
}

// Straight ones and turns each by themselves, where of both enough is known.
std::vector<std::pair<Manner, Meetings>> ByManner(const Meetings& met) {
  constexpr std::ptrdiff_t kEnough = 200;  // with an outcome
  std::vector<std::pair<Manner, Meetings>> parts;
  for (const Manner manner : {Manner::kStraight, Manner::kTurning}) {
    Meetings& of = parts.emplace_back(manner, Meetings()).second;
    for (const Encounter* e : met)
      if (MannerOf(e->at) == manner) of.push_back(e);
    const auto with = [&of](Encounter::Outcome outcome) {
      return std::ranges::count(of, outcome, [](const Encounter* e) { return e->outcome; });
    };
    const auto failed = with(Encounter::Outcome::kFailed);
    if (failed < kLeastEvents || failed + with(Encounter::Outcome::kCleared) < kEnough)
      return {{Manner::kAny, met}};
  }
  return parts;
}

// All kinds that never failed have together about as many failures to come, over as much exposure
// again, as there were kinds that failed once.
void SetUnseen(std::vector<KindRates>& kinds) {
  const auto times = [&](int events) {
    return static_cast<double>(
        std::ranges::count(kinds, events, [](const KindRates& kind) { return kind.any.events; }));
  };
  constexpr double kMostEvents = 0.5;  // of one kind, however many failed once
  const double events = std::min(kMostEvents, (times(1) + 0.5) / std::max(times(0), 1.0));
  for (KindRates& kind : kinds)
    if (kind.any.events == 0)
      SetConstantRate(ExposureOf(kind), events / ExposureOf(kind), StreamName(kind) + ".any",
                      kind.any);
}

}  // namespace

RiskModel FitRates(const std::vector<Encounter>& encounters, MeasuredRobot robot,
                   const RateFitOptions& options) {
  RiskModel model;
  model.robot = std::move(robot);
  model.robot.mass_kg = RoundedTo6(model.robot.mass_kg);
  model.robot.clearance_m = RoundedTo6(model.robot.clearance_m);
  model.mirrored = options.mirrored;
  model.encounters = static_cast<int>(encounters.size());
  // Only who got over a hazard meets it again: these say nothing of all that come.
  std::map<std::pair<std::string, Passage>, Meetings> by_kind;
  for (const std::vector<const Encounter*>& met : MeetingsOfDrives(encounters))
    by_kind[{met.front()->type, met.front()->passage}].push_back(met.front());
  for (const auto& [name, met] : by_kind)
    for (const auto& [manner, part] : ByManner(met)) {
      UnmeasuredKind unmeasured;
      if (std::optional<KindRates> kind = FitKind(part, manner, options, unmeasured))
        model.kinds.push_back(std::move(*kind));
      else
        model.unmeasured.push_back(std::move(unmeasured));
    }
  SetUnseen(model.kinds);
  SetSharedFrailty(encounters, model);
  return model;
}

}  // namespace floorproof

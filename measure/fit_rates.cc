// SPDX-License-Identifier: Apache-2.0
#include "measure/fit_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

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
  constexpr double Approach::*kOfExposures[] = {&Approach::speed_mps, &Approach::wall_m,
                                                &Approach::friction, &Approach::mass_kg,
                                                &Approach::clearance_m};
  return std::ranges::find(kOfExposures, column.member) != std::end(kOfExposures);
}

std::vector<RateAxis> AxesOf(const Meetings& met, bool mirrored) {
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
    axes.emplace_back();
    axes.back().name = column.name;
  }
  std::vector<std::vector<double>> x;
  for (const Encounter* e : met) x.push_back(CovariatesOf(axes, mirrored, *e));
  for (std::size_t a = 0; a < axes.size(); ++a) {
    std::vector<double> values;
    for (const std::vector<double>& row : x) values.push_back(row[a]);
    const bool turns = !axes[a].of_hazard && axes[a].name == "lead_rad";
    axes[a] = MakeRateAxis(axes[a].name, axes[a].of_hazard, std::move(values), turns ? 2 * kPi : 0);
  }
  return axes;
}

std::string StreamName(const KindRates& kind) {
  return fmt::format("risk_model.{}.{}", kind.type, Name(kind.passage));
}

// Of a kind that was measured; none where it was met too rarely.
std::optional<KindRates> FitKind(const Meetings& all, const RateFitOptions& options,
                                 UnmeasuredKind& unmeasured) {
  KindRates kind;
  kind.type = all.front()->type;
  kind.passage = all.front()->passage;
  kind.per_metre = IsExposure(kind.type);
  kind.encounters = static_cast<int>(all.size());
  Meetings met;
  for (const Encounter* e : all) {
    kind.censored += e->outcome == Encounter::Outcome::kCensored;
    kind.cleared += e->outcome == Encounter::Outcome::kCleared;
    kind.way_m += e->way_m;
    if (kind.per_metre ? e->way_m > 0 : e->outcome != Encounter::Outcome::kCensored)
      met.push_back(e);
  }
  if (static_cast<int>(met.size()) < options.least_encounters) {
    unmeasured = {kind.type, kind.passage,
                  fmt::format("{} encounters with an outcome; at least {} are needed", met.size(),
                              options.least_encounters)};
    return std::nullopt;
  }
  kind.axes = AxesOf(met, options.mirrored);
  std::vector<RateRow> rows;
  for (const Encounter* e : met) {
    RateRow& row = rows.emplace_back();
    row.x = CovariatesOf(kind.axes, options.mirrored, *e);
    if (kind.per_metre) row.way_m = e->way_m;
    if (e->outcome != Encounter::Outcome::kFailed) continue;
    row.mode = static_cast<int>(e->mode);
    ++kind.modes[row.mode].events;
  }
  kind.way_m = RoundedTo6(kind.way_m);
  FitKindRates(rows, StreamName(kind), kind);
  return kind;
}

double ExposureOf(const KindRates& kind) {
  return kind.per_metre ? kind.way_m : kind.encounters - kind.censored;
}

// All modes that never happened have together about as many failures to come, over as much
// exposure again, as there were modes that happened once.
void SetUnseen(std::vector<KindRates>& kinds) {
  double once = 0, never = 0;
  for (const KindRates& kind : kinds)
    for (const ModeRates& mode : kind.modes) {
      once += mode.events == 1;
      never += mode.events == 0;
    }
  constexpr double kMostEvents = 1.0 / 3;  // of one mode, however many happened once
  const double events = std::min(kMostEvents, (once + 0.5) / std::max(never, 1.0));
  for (KindRates& kind : kinds)
    for (int m = 0; m < kNumFailureModes; ++m)
      if (kind.modes[m].events == 0)
        SetConstantRate(ExposureOf(kind), events / ExposureOf(kind),
                        StreamName(kind) + "." + std::string(Name(FailureMode(m))), kind.modes[m]);
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
  for (const auto& [name, met] : by_kind) {
    UnmeasuredKind unmeasured;
    if (std::optional<KindRates> kind = FitKind(met, options, unmeasured))
      model.kinds.push_back(std::move(*kind));
    else
      model.unmeasured.push_back(std::move(unmeasured));
  }
  SetUnseen(model.kinds);
  model.theta = SharedFrailty(model, encounters);
  return model;
}

}  // namespace floorproof

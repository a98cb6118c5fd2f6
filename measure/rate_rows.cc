// SPDX-License-Identifier: Apache-2.0
#include "measure/rate_rows.h"

#include <algorithm>

#include "env/geometry/geometry.h"
#include "measure/rate_axes.h"

namespace floorproof {
namespace {

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

}  // namespace

int FailuresOf(const Meetings& met) {
  return static_cast<int>(std::ranges::count(met, Encounter::Outcome::kFailed,
                                             [](const Encounter* e) { return e->outcome; }));
}

std::vector<std::string> StatedByAll(const Meetings& met) {
  std::vector<std::string> keys;
  for (const auto& first : met.front()->size) {
    const std::string& key = first.first;
    const bool stated = std::all_of(met.begin(), met.end(), [&](const Encounter* e) {
      return std::any_of(e->size.begin(), e->size.end(),
                         [&](const auto& entry) { return entry.first == key; });
    });
    if (stated) keys.push_back(key);
  }
  return keys;
}

std::vector<RateAxis> AxesOf(const Meetings& met, const std::vector<std::string>& sizes,
                             Manner manner, const RateFitOptions& options) {
  std::vector<RateAxis> axes;
  for (const std::string& key : sizes) {
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
  if (!exposed) {
    const bool beside = met.front()->passage == Passage::kBeside;
    if (beside || options.holonomic) {
      axes.emplace_back();
      axes.back().name = beside ? kSureGap : kAskew;
    }
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

std::vector<RateRow> RowsOf(const Meetings& met, const std::vector<RateAxis>& axes, bool mirrored) {
  std::vector<RateRow> rows;
  for (const Encounter* e : met) {
    RateRow& row = rows.emplace_back();
    row.x = CovariatesOf(axes, mirrored, *e);
    row.way_m = AmountOf(*e);
    row.happened = e->outcome == Encounter::Outcome::kFailed;
  }
  return rows;
}

}  // namespace floorproof

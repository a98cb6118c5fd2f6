// SPDX-License-Identifier: Apache-2.0
#include "measure/fit_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "base/quantity.h"
#include "base/round.h"
#include "measure/constant_rate.h"
#include "measure/like_kinds.h"
#include "measure/penalised_rates.h"
#include "measure/rate_rows.h"
#include "measure/shared_frailty.h"

namespace floorproof {
namespace {

// Walls and free floor are failed at by robots that are lost, too seldom for rates to follow how
// lost they are, and whose way is of no plan that is predicted: these know their place.
constexpr double kKnowsItsPlace_m = 0.01;

std::string StreamName(const KindRates& kind) {
  return fmt::format("risk_model.{}.{}.{}", kind.type, Name(kind.passage), Name(kind.manner));
}

// Meetings, or way. Of a meeting that failed half.
double ExposureOf(const KindRates& kind) {
  return kind.per_metre ? kind.way_m : kind.encounters - kind.censored - kind.any.events / 2.0;
}

// `kind.any.events` is known. Where nothing failed the rest stays empty: SetUnseen sets it.
void SetAny(const std::vector<RateRow>& rows, KindRates& kind) {
  const std::string name = StreamName(kind) + ".any";
  const int n = static_cast<int>(rows.size());
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

// Of a kind that was measured; none where it was met too rarely. `like`: kinds that it is like;
// null: it has rates of its own.
std::optional<KindRates> FitKind(const Meetings& all, Manner manner, const LikeKinds* like,
                                 const RateFitOptions& options, UnmeasuredKind& unmeasured) {
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
                  fmt::format("{} with an outcome; at least {} are needed",
                              CountText(known, "encounter"), options.least_encounters)};
    return std::nullopt;
  }
  kind.axes = like != nullptr ? like->axes : AxesOf(met, StatedByAll(met), manner, options);
  const std::vector<RateRow> rows = RowsOf(met, kind.axes, options.mirrored);
  std::vector<RateRow> failures;
  std::vector<int> modes;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].happened) continue;
    failures.push_back({rows[i].x, 1, false});
    modes.push_back(static_cast<int>(met[i]->mode));
  }
  kind.way_m = RoundedTo6(kind.way_m);
  kind.any.events = static_cast<int>(failures.size());
  if (like != nullptr)
    SetLike(rows, *like, StreamName(kind) + ".any", kind.any);
  else
    SetAny(rows, kind);
  SetSplits(std::move(failures), std::move(modes), kind);
  return kind;
}

using Parts = std::vector<std::pair<Manner, Meetings>>;
Parts OfAnyManner(const Meetings& met) { return {{Manner::kAny, met}}; }

// Straight ones and turns each by themselves, where of both enough is known.
Parts ByManner(const Meetings& met) {
  constexpr std::ptrdiff_t kEnough = 200;  // with an outcome
  Parts parts;
  for (const Manner manner : {Manner::kStraight, Manner::kTurning}) {
    Meetings& of = parts.emplace_back(manner, Meetings()).second;
    for (const Encounter* e : met)
      if (MannerOf(e->at) == manner) of.push_back(e);
    const auto cleared = std::ranges::count(of, Encounter::Outcome::kCleared,
                                            [](const Encounter* e) { return e->outcome; });
    const int failed = FailuresOf(of);
    if (failed < kLeastEvents || failed + cleared < kEnough) return OfAnyManner(met);
  }
  return parts;
}

// All kinds that never failed and are like no other have together about as many failures to come,
// over as much exposure again, as there were such kinds that failed once.
void SetUnseen(std::vector<KindRates>& kinds, int once) {
  const auto is_unseen = [](const KindRates& kind) { return kind.any.coefficients.empty(); };
  const auto never = static_cast<double>(std::ranges::count_if(kinds, is_unseen));
  constexpr double kMostEvents = 0.5;  // of one kind, however many failed once
  const double events = std::min(kMostEvents, (once + 0.5) / std::max(never, 1.0));
  for (KindRates& kind : kinds)
    if (is_unseen(kind))
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
  ByKind by_kind;
  for (const std::vector<const Encounter*>& met : MeetingsOfDrives(encounters)) {
    const Encounter& front = *met.front();
    if (IsExposure(front.type) && front.at.estimate_error_m > kKnowsItsPlace_m) continue;
    by_kind[{front.type, front.passage}].push_back(&front);
  }
  const auto like_kinds = FitLikeKinds(by_kind, options);
  int once = 0;  // kinds that are like no other, and failed once
  for (const auto& [name, met] : by_kind) {
    const auto found = like_kinds.find(name);
    const LikeKinds* like = found == like_kinds.end() ? nullptr : found->second.get();
    for (const auto& [manner, part] : like ? OfAnyManner(met) : ByManner(met)) {
      UnmeasuredKind unmeasured;
      if (std::optional<KindRates> kind = FitKind(part, manner, like, options, unmeasured)) {
        once += like == nullptr && kind->any.events == 1;
        model.kinds.push_back(std::move(*kind));
      } else
        model.unmeasured.push_back(std::move(unmeasured));
    }
  }
  SetUnseen(model.kinds, once);
  SetSharedFrailty(encounters, model);
  return model;
}

}  // namespace floorproof

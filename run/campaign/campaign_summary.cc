// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include "base/quantity.h"
#include "env/geometry/grid.h"
#include "run/campaign/campaign_about.h"
#include "run/campaign/repetition.h"
#include "run/scenario/chance.h"
#include "stats/binomial.h"
#include "stats/poisson.h"
#include "stats/quantile.h"

namespace floorproof {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const GridFrame kPlaces{0, 0, 0.5, {}};  // squares of the world, whatever the site's own cells

// k events in so many km or thousand hours.
FailureRatePer RatePer(const std::string& name, int k, double exposure) {
  const Interval interval = GarwoodInterval(k, exposure, kReportedConfidence);
  return {name, k, exposure, exposure > 0 ? k / exposure : kNone, interval.lower, interval.upper};
}

// Of the driven episodes, in any order.
std::optional<MetricSpread> Spread(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  double sum = 0;
  for (const double value : values) sum += value;
  return MetricSpread{.mean = sum / static_cast<double>(values.size()),
                      .median = Quantile(values, 0.5),
                      .lower_quartile = Quantile(values, 0.25),
                      .upper_quartile = Quantile(values, 0.75),
                      .min = values.front(),
                      .max = values.back()};
}

// One variant's rows, added up.
struct Tally {
  int n = 0, driven = 0, any = 0;
  std::map<std::string, int> outcomes;
  std::array<int, kNumFailureModes> episodes{}, events{};  // by mode
  std::map<std::string, int> kinds, hazards;               // episodes with one or more
  std::map<std::pair<int, int>, int> places;               // the same, by square of the floor
  std::map<std::string, std::uint64_t> first;              // by mode: the first episode's number
  std::array<std::vector<double>, kMetrics.size()> metrics;
  double km = 0, hours = 0;
  std::string first_error;

  void Add(const EpisodeRow& row) {
    ++outcomes[row.outcome];
    if (row.outcome == "error" && first_error.empty())
      first_error = fmt::format("episode {}: {}", row.episode, row.message);
    if (!row.counts()) return;
    ++n;
    driven += row.driven();
    any += row.any_failure();
    km += row.metric(&Metrics::path_length_m).value_or(0) / 1e3;
    hours += row.metric(&Metrics::duration_s).value_or(0) / 3600;
    for (std::size_t i = 0; i < metrics.size(); ++i)
      if (row.metrics[i]) metrics[i].push_back(*row.metrics[i]);
    if (!row.any_failure()) return;
    if (row.events == "[]") ++kinds["coverage"];
    for (std::size_t m = 0; m < events.size(); ++m) {
      episodes[m] += row.events_of[m] > 0;
      events[m] += row.events_of[m];
      if (row.events_of[m] > 0)
        first.emplace(Name(static_cast<FailureMode>(m)), row.episode);  // rows come ascending
    }
    std::set<std::string> seen_kinds, seen_hazards;
    std::set<std::pair<int, int>> seen_places;
    for (const Event& event : EventsOf(row)) {
      seen_kinds.insert(std::string(Name(event.mode)) +
                        (event.kind.empty() ? "" : "/" + event.kind));
      if (!event.hazard.empty()) seen_hazards.insert(event.hazard);
      const Cell place = kPlaces.ToCell(Vec2(event.x_m, event.y_m));
      seen_places.emplace(place.ix, place.iy);
    }
    for (const std::string& kind : seen_kinds) ++kinds[kind];
    for (const std::string& hazard : seen_hazards) ++hazards[hazard];
    for (const auto& place : seen_places) ++places[place];
  }

  int count(const char* outcome) const {
    const auto found = outcomes.find(outcome);
    return found == outcomes.end() ? 0 : found->second;
  }
};

void AddRates(const Tally& tally, VariantSummary& out) {
  int events = 0;
  for (const int n : tally.events) events += n;
  if (const auto short_of = tally.kinds.find("coverage"); short_of != tally.kinds.end())
    events += short_of->second;
  const auto add = [&](const std::string& name, int failed, int happened) {
    out.failures.push_back(CountedRate(name, failed, tally.driven));
    out.per_km.push_back(RatePer(name, happened, tally.km));
    out.per_1000_h.push_back(RatePer(name, happened, tally.hours / 1000));
  };
  add("any_failure", tally.any, events);
  for (std::size_t m = 0; m < tally.events.size(); ++m)
    add(std::string(Name(static_cast<FailureMode>(m))), tally.episodes[m], tally.events[m]);
  const int unplanned = tally.count("not_planned");
  out.failures.push_back(CountedRate("not_success", tally.n - tally.count("success") + unplanned,
                                     tally.n + unplanned));
  for (const auto& [kind, k] : tally.kinds) out.kinds.push_back(CountedRate(kind, k, tally.driven));
  for (const auto& [hazard, k] : tally.hazards)
    out.hazards.push_back(CountedRate(hazard, k, tally.driven));
  out.place_m = kPlaces.cell_m;
  for (const auto& [place, k] : tally.places)
    out.places.push_back(
        {kPlaces.Center(place.first, place.second), CountedRate("", k, tally.driven)});
}

// A variant's rows; `one` holds the first that is no error alone.
VariantSummary SummaryOf(const std::string& name, const Tally& tally, const Tally& one,
                         bool repeated) {
  VariantSummary out{.name = name, .repeated = repeated, .n = tally.n};
  out.errors = tally.count("error");
  out.not_planned = tally.count("not_planned");
  out.first_error = tally.first_error;
  out.success = tally.count("success");
  out.failure = tally.count("failure");
  out.timeout = tally.count("timeout");
  out.aborted = tally.count("aborted");
  AddRates(repeated ? one : tally, out);
  for (std::size_t i = 0; i < tally.metrics.size(); ++i)
    out.metrics.push_back({std::string(kMetrics[i].name), Spread(tally.metrics[i])});
  out.first_episode.assign(tally.first.begin(), tally.first.end());
  return out;
}

std::optional<GateSummary> SummaryOf(const std::vector<GateState>& gate,
                                     const std::vector<Variant>& variants) {
  if (gate.empty()) return std::nullopt;
  const GateParams& params = gate.front().params();
  GateSummary out{params.metric, params.max_rate, params.confidence, params.mode, Overall(gate)};
  for (std::size_t v = 0; v < gate.size(); ++v)
    out.variants.push_back({variants[v].name, gate[v].Report(), 0});
  return out;
}

}  // namespace

FailureRate CountedRate(const std::string& name, int k, int n) {
  const Interval interval = ClopperPearson(k, n, kReportedConfidence);
  return {name, k, n, n > 0 ? static_cast<double>(k) / n : kNone, interval.lower, interval.upper};
}

CampaignSummary Summarise(const CampaignStore& store, const std::vector<Variant>& variants,
                          const std::vector<GateState>& gate, const std::string& unfinished) {
  CampaignSummary out{.campaign = store.about().id,
                      .episodes = store.asked(),
                      .unfinished = unfinished,
                      .gate = SummaryOf(gate, variants),
                      .versions = VersionsOf(store.about())};
  for (const Variant& variant : variants) {
    Tally tally, one;
    Repetition repetition;
    store.ForEach(variant.name, [&](const EpisodeRow& row) {
      tally.Add(row);
      if (row.outcome == "error") return;
      if (repetition.n() == 0) one.Add(row);
      repetition.Add(row.ResultHash());
    });
    out.variants.push_back(SummaryOf(variant.name, tally, one, repetition.repeated()));
  }
  out.TellGate();
  return out;
}

std::string AbortedText(const VariantSummary& v) {
  return v.aborted > 0 ? fmt::format(", {} stopped by themselves", v.aborted) : "";
}

std::string RepetitionText(const VariantSummary& variant) {
  if (!variant.repeated) return "";
  return fmt::format(
      "one episode, repeated: all {} came out the same, to the last bit, and say nothing of how "
      "often it fails; {}",
      variant.n + variant.not_planned, kHowToDiffer);
}

std::string Criterion(const GateSummary& gate) {
  return fmt::format("{} < {} at {}", gate.metric, PercentText(gate.max_rate, 4),
                     PercentText(gate.confidence, 4));
}

void CampaignSummary::TellGate() {
  if (!gate) return;
  for (VariantGate& variant : gate->variants)
    for (const VariantSummary& v : variants)
      if (v.name == variant.variant) variant.aborted = v.aborted;
}

std::string GateText(const GateSummary& gate, const VariantGate& variant) {
  std::string text = fmt::format("{} ({}): {}", GateVerdictName(variant.report.verdict),
                                 Criterion(gate), variant.report.text);
  if (variant.aborted > 0 && gate.metric != "not_success")
    text += fmt::format("; {} stopped by themselves, which not_success counts and {} does not",
                        CountText(static_cast<std::size_t>(variant.aborted), "more robot"),
                        gate.metric);
  return text;
}

}  // namespace floorproof

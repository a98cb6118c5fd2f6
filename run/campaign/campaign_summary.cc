// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/file_output.h"
#include "env/geometry/grid.h"
#include "run/campaign/campaign_junit.h"
#include "run/campaign/episodes_csv.h"
#include "stats/binomial.h"
#include "stats/poisson.h"
#include "stats/quantile.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

const GridFrame kPlaces{0, 0, 0.5, {}};  // squares of the world, whatever the site's own cells

// k episodes of n, with the exact interval.
Json Rate(int k, int n) {
  const Interval interval = ClopperPearson(k, n, kReportedConfidence);
  return {{"k", k},
          {"n", n},
          {"rate", n > 0 ? Json(static_cast<double>(k) / n) : Json(nullptr)},
          {"lower", interval.lower},
          {"upper", interval.upper},
          {"method", "clopper_pearson"},
          {"confidence", kReportedConfidence}};
}

// k events in so many km or thousand hours.
Json RatePer(int k, double exposure) {
  const Interval interval = GarwoodInterval(k, exposure, kReportedConfidence);
  return {{"k", k},
          {"exposure", exposure},
          {"rate", exposure > 0 ? Json(k / exposure) : Json(nullptr)},
          {"lower", interval.lower},
          {"upper", std::isfinite(interval.upper) ? Json(interval.upper) : Json(nullptr)},
          {"method", "garwood"},
          {"confidence", kReportedConfidence}};
}

// Of the driven episodes, in any order.
Json Spread(std::vector<double> values) {
  if (values.empty()) return nullptr;
  std::ranges::sort(values);
  double sum = 0;
  for (const double value : values) sum += value;
  return {{"mean", sum / static_cast<double>(values.size())},
          {"median", Quantile(values, 0.5)},
          {"lower_quartile", Quantile(values, 0.25)},
          {"upper_quartile", Quantile(values, 0.75)},
          {"min", values.front()},
          {"max", values.back()}};
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
    const Json events_met = Json::parse(row.events);
    for (const Json& event : events_met) {
      const auto text = [&](const char* key) { return event.value(key, std::string()); };
      seen_kinds.insert(text("mode") + (text("kind").empty() ? "" : "/" + text("kind")));
      if (!text("hazard").empty()) seen_hazards.insert(text("hazard"));
      const Cell place =
          kPlaces.ToCell(Vec2(event.at("x_m").get<double>(), event.at("y_m").get<double>()));
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

Json VariantJson(const Tally& tally) {
  Json failures = {{"any_failure", Rate(tally.any, tally.driven)}}, per_km, per_hour;
  Json kinds = Json::object(), hazards = Json::object(), places = Json::array(),
       metrics = Json::object(), first = Json::object();
  int events = 0;
  for (const int n : tally.events) events += n;
  if (const auto short_of = tally.kinds.find("coverage"); short_of != tally.kinds.end())
    events += short_of->second;
  per_km["any_failure"] = RatePer(events, tally.km);
  per_hour["any_failure"] = RatePer(events, tally.hours / 1000);
  for (std::size_t m = 0; m < tally.events.size(); ++m) {
    const std::string mode(Name(static_cast<FailureMode>(m)));
    failures[mode] = Rate(tally.episodes[m], tally.driven);
    per_km[mode] = RatePer(tally.events[m], tally.km);
    per_hour[mode] = RatePer(tally.events[m], tally.hours / 1000);
  }
  const int none = tally.count("not_planned");
  failures["not_success"] = Rate(tally.n - tally.count("success") + none, tally.n + none);
  for (const auto& [kind, k] : tally.kinds) kinds[kind] = Rate(k, tally.driven);
  for (const auto& [hazard, k] : tally.hazards) hazards[hazard] = Rate(k, tally.driven);
  for (const auto& [place, k] : tally.places) {
    const Vec2 centre = kPlaces.Center(place.first, place.second);
    Json rate = {{"x_m", centre.x()}, {"y_m", centre.y()}};
    rate.update(Rate(k, tally.driven));
    places.push_back(std::move(rate));
  }
  for (std::size_t i = 0; i < tally.metrics.size(); ++i)
    metrics[std::string(kMetrics[i].name)] = Spread(tally.metrics[i]);
  for (const auto& [mode, episode] : tally.first) first[mode] = episode;
  return {{"n", tally.n},
          {"n_error", tally.count("error")},
          {"n_not_planned", tally.count("not_planned")},
          {"first_error", tally.first_error.empty() ? Json(nullptr) : Json(tally.first_error)},
          {"outcomes",
           {{"success", tally.count("success")},
            {"failure", tally.count("failure")},
            {"timeout", tally.count("timeout")}}},
          {"failures", std::move(failures)},
          {"per_km", std::move(per_km)},
          {"per_1000_h", std::move(per_hour)},
          {"by_kind", std::move(kinds)},
          {"by_hazard", std::move(hazards)},
          {"by_place", {{"cell_m", kPlaces.cell_m}, {"places", std::move(places)}}},
          {"metrics", std::move(metrics)},
          {"first_episode", std::move(first)}};
}

Json SummaryJson(const CampaignStore& store, const std::vector<Variant>& variants,
                 const std::vector<GateState>& gate, const CampaignEnding& ending) {
  Json json = {{"campaign", store.about().id},
               {"episodes", store.asked()},
               {"unfinished", ending.unfinished.empty() ? Json(nullptr) : Json(ending.unfinished)},
               {"variants", Json::object()}};
  for (const Variant& variant : variants) {
    Tally tally;
    store.ForEach(variant.name, [&](const EpisodeRow& row) { tally.Add(row); });
    json["variants"][variant.name] = VariantJson(tally);
  }
  json["gate"] = nullptr;
  if (!gate.empty()) {
    json["gate"] = gate.front().CriterionJson();
    json["gate"]["verdict"] = GateVerdictName(Overall(gate));
    for (std::size_t v = 0; v < gate.size(); ++v)
      json["gate"]["variants"][variants[v].name] = gate[v].Json();
  }
  json["versions"] = Json::parse(store.about().versions);
  return json;
}

}  // namespace

Json WriteSummaryFiles(const CampaignStore& store, const std::vector<Variant>& variants,
                       const std::vector<GateState>& gate, const CampaignEnding& ending,
                       const std::string& scenario_name, const std::filesystem::path& folder) {
  Json summary = SummaryJson(store, variants, gate, ending);
  WriteFileWhole(folder / "episodes.csv", EpisodesCsv(store, variants));
  WriteFileWhole(folder / "junit.xml", JunitXml(summary, gate, ending.failed_fast, scenario_name));
  WriteFileWhole(folder / "summary.json", summary.dump(2) + "\n");
  return summary;
}

}  // namespace floorproof

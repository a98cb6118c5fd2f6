// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/summary_json.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/input_file.h"
#include "run/episode/json_file.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json Text(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

double NumberOr(const JsonValue& value, double otherwise) {
  return value.is_null() ? otherwise : value.get<double>();
}
std::string TextOf(const JsonValue& value) {
  return value.is_null() ? "" : value.get<std::string>();
}

Json RateJson(const FailureRate& rate) {
  return {{"k", rate.k},
          {"n", rate.n},
          {"rate", Number(rate.rate)},
          {"lower", rate.lower},
          {"upper", rate.upper},
          {"method", "clopper_pearson"},
          {"confidence", kReportedConfidence}};
}

FailureRate ReadRate(const std::string& name, const JsonValue& json) {
  return {name,
          json.at("k"),
          json.at("n"),
          NumberOr(json.at("rate"), kNone),
          json.at("lower"),
          json.at("upper")};
}

Json RatesJson(const std::vector<FailureRate>& rates) {
  Json json = Json::object();
  for (const FailureRate& rate : rates) json[rate.name] = RateJson(rate);
  return json;
}

std::vector<FailureRate> ReadRates(const JsonValue& json) {
  std::vector<FailureRate> rates;
  for (const auto& [name, rate] : json.items()) rates.push_back(ReadRate(name, rate));
  return rates;
}

Json RatesPerJson(const std::vector<FailureRatePer>& rates) {
  Json json = Json::object();
  for (const FailureRatePer& rate : rates)
    json[rate.name] = {{"k", rate.k},
                       {"exposure", rate.exposure},
                       {"rate", Number(rate.rate)},
                       {"lower", rate.lower},
                       {"upper", Number(rate.upper)},
                       {"method", "garwood"},
                       {"confidence", kReportedConfidence}};
  return json;
}

std::vector<FailureRatePer> ReadRatesPer(const JsonValue& json) {
  std::vector<FailureRatePer> rates;
  for (const auto& [name, rate] : json.items())
    rates.push_back({name, rate.at("k"), rate.at("exposure"), NumberOr(rate.at("rate"), kNone),
                     rate.at("lower"),
                     NumberOr(rate.at("upper"), std::numeric_limits<double>::infinity())});
  return rates;
}

Json PlacesJson(const VariantSummary& variant) {
  Json places = Json::array();
  for (const FailurePlace& place : variant.places) {
    Json json = {{"x_m", place.p_W.x()}, {"y_m", place.p_W.y()}};
    json.update(RateJson(place.rate));
    places.push_back(std::move(json));
  }
  return {{"cell_m", variant.place_m}, {"places", std::move(places)}};
}

void ReadPlaces(const JsonValue& json, VariantSummary& variant) {
  variant.place_m = json.at("cell_m");
  for (const JsonValue& place : json.at("places").elements()) {
    const double x_m = place.at("x_m"), y_m = place.at("y_m");
    variant.places.push_back({{x_m, y_m}, ReadRate("", place)});
  }
}

Json MetricsJson(const std::vector<MetricSummary>& metrics) {
  Json json = Json::object();
  for (const auto& [name, spread] : metrics) {
    json[name] = nullptr;
    if (spread)
      json[name] = {{"mean", spread->mean},
                    {"median", spread->median},
                    {"lower_quartile", spread->lower_quartile},
                    {"upper_quartile", spread->upper_quartile},
                    {"min", spread->min},
                    {"max", spread->max}};
  }
  return json;
}

std::vector<MetricSummary> ReadMetrics(const JsonValue& json) {
  std::vector<MetricSummary> metrics;
  for (const auto& [name, spread] : json.items()) {
    const MetricColumn* column = FindMetric(name);
    metrics.push_back({column == nullptr ? name : std::string(column->name)});
    if (spread.is_null()) continue;
    metrics.back().spread =
        MetricSpread{spread.at("mean"),           spread.at("median"), spread.at("lower_quartile"),
                     spread.at("upper_quartile"), spread.at("min"),    spread.at("max")};
  }
  return metrics;
}

Json VariantJson(const VariantSummary& v) {
  Json first = Json::object();
  for (const auto& [mode, episode] : v.first_episode) first[mode] = episode;
  return {{"n", v.n},
          {"one_episode_repeated", v.repeated},
          {"n_error", v.errors},
          {"n_not_planned", v.not_planned},
          {"first_error", Text(v.first_error)},
          {"outcomes",
           {{"success", v.success},
            {"failure", v.failure},
            {"timeout", v.timeout},
            {"aborted", v.aborted}}},
          {"failures", RatesJson(v.failures)},
          {"per_km", RatesPerJson(v.per_km)},
          {"per_1000_h", RatesPerJson(v.per_1000_h)},
          {"by_kind", RatesJson(v.kinds)},
          {"by_hazard", RatesJson(v.hazards)},
          {"by_place", PlacesJson(v)},
          {"metrics", MetricsJson(v.metrics)},
          {"first_episode", std::move(first)}};
}

VariantSummary ReadVariant(const std::string& name, const JsonValue& json) {
  VariantSummary v{
      .name = name, .repeated = json.value("one_episode_repeated", false), .n = json.at("n")};
  v.errors = json.at("n_error");
  v.not_planned = json.at("n_not_planned");
  v.success = json.at("outcomes").at("success");
  v.failure = json.at("outcomes").at("failure");
  v.timeout = json.at("outcomes").at("timeout");
  v.aborted = json.at("outcomes").value("aborted", 0);  // files of earlier versions have none
  v.failures = ReadRates(json.at("failures"));
  v.kinds = ReadRates(json.at("by_kind"));
  v.hazards = ReadRates(json.at("by_hazard"));
  ReadPlaces(json.at("by_place"), v);
  v.per_km = ReadRatesPer(json.at("per_km"));
  v.per_1000_h = ReadRatesPer(json.at("per_1000_h"));
  v.metrics = ReadMetrics(json.at("metrics"));
  v.first_error = TextOf(json.at("first_error"));
  for (const auto& [mode, episode] : json.at("first_episode").items())
    v.first_episode.emplace_back(mode, episode.get<std::uint64_t>());
  return v;
}

bool IsSequential(const GateSummary& gate) { return gate.mode == "sequential"; }

Json GateJson(const GateSummary& gate) {
  Json variants = Json::object();
  for (const auto& [name, report, aborted] : gate.variants) {
    Json& json = variants[name];
    json = {{"verdict", GateVerdictName(report.verdict)},
            {"n", report.n},
            {"k", report.k},
            {"lower", report.rate.lower},
            {"upper", report.rate.upper},
            {"text", report.text}};
    if (!IsSequential(gate)) continue;
    json["log_e_pass"] = report.log_e_pass;
    json["log_e_fail"] = report.log_e_fail;
  }
  return {{"metric", gate.metric},
          {"max_rate", gate.max_rate},
          {"confidence", gate.confidence},
          {"mode", gate.mode},
          {"verdict", GateVerdictName(gate.verdict)},
          {"variants", std::move(variants)}};
}

GateVerdict ReadVerdict(const JsonValue& json) {
  const std::string name = json;
  for (const GateVerdict verdict : {GateVerdict::kPassed, GateVerdict::kFailed})
    if (name == GateVerdictName(verdict)) return verdict;
  return GateVerdict::kUndecided;
}

std::optional<GateSummary> ReadGate(const JsonValue& json) {
  if (json.is_null()) return std::nullopt;
  GateSummary gate{json.at("metric"), json.at("max_rate"), json.at("confidence"), json.at("mode"),
                   ReadVerdict(json.at("verdict"))};
  for (const auto& [variant, state] : json.at("variants").items()) {
    GateReport report;
    report.text = state.at("text").get<std::string>();
    report.verdict = ReadVerdict(state.at("verdict"));
    report.n = state.at("n");
    report.k = state.at("k");
    report.rate = {state.at("lower"), state.at("upper")};
    if (IsSequential(gate)) {
      report.log_e_pass = state.at("log_e_pass");
      report.log_e_fail = state.at("log_e_fail");
    }
    gate.variants.push_back({variant, std::move(report), 0});
  }
  return gate;
}

}  // namespace

Json SummaryJson(const CampaignSummary& summary) {
  Json variants = Json::object(), versions = Json::object();
  for (const VariantSummary& variant : summary.variants)
    variants[variant.name] = VariantJson(variant);
  for (const auto& [name, version] : summary.versions) versions[name] = version;
  return {{"campaign", summary.campaign},
          {"episodes", summary.episodes},
          {"unfinished", Text(summary.unfinished)},
          {"variants", std::move(variants)},
          {"gate", summary.gate ? GateJson(*summary.gate) : Json(nullptr)},
          {"versions", std::move(versions)}};
}

CampaignSummary ReadSummary(const std::filesystem::path& file) {
  if (const std::string why = WhyUnreadable(file, kMaxResultBytes); !why.empty())
    throw InputError({file.string(), 0}, "", "",
                     why + ": not the folder of a finished `campaign` (--resume finishes one)");
  const JsonValue json = ReadJsonFile(file, "a campaign's summary", kMaxResultBytes);
  CampaignSummary summary;
  summary.campaign = json.at("campaign").get<std::string>();
  summary.unfinished = TextOf(json.at("unfinished"));
  for (const auto& [name, variant] : json.at("variants").items())
    summary.variants.push_back(ReadVariant(name, variant));
  summary.gate = ReadGate(json.at("gate"));
  summary.TellGate();
  for (const auto& [name, version] : json.at("versions").items())
    summary.versions.emplace_back(name, version);
  summary.episodes = json.at("episodes");
  return summary;
}

}  // namespace floorproof

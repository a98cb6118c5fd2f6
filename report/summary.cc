// SPDX-License-Identifier: Apache-2.0
#include "report/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/input_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kMaxBytes = 64u << 20;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double NumberOr(const Json& value, double otherwise) {
  return value.is_null() ? otherwise : value.get<double>();
}

ReportRate ReadRate(const std::string& name, const Json& rate) {
  return {name,
          rate.at("k"),
          rate.at("n"),
          NumberOr(rate.at("rate"), kNone),
          rate.at("lower"),
          rate.at("upper")};
}

std::vector<ReportRate> ReadRates(const Json& json) {
  std::vector<ReportRate> rates;
  for (const auto& [name, rate] : json.items()) rates.push_back(ReadRate(name, rate));
  return rates;
}

// The worst first; `name` says where.
ReportPlaces ReadPlaces(const Json& json) {
  ReportPlaces places{.cell_m = json.at("cell_m")};
  for (const Json& place : json.at("places")) {
    const double x_m = place.at("x_m"), y_m = place.at("y_m");
    places.rates.push_back(
        {{x_m, y_m}, ReadRate(fmt::format("x {:.2f}, y {:.2f} m", x_m, y_m), place)});
  }
  std::ranges::stable_sort(places.rates, std::greater(),
                           [](const ReportPlace& place) { return place.rate.k; });
  return places;
}

std::vector<ReportRatePer> ReadRatesPer(const Json& json) {
  std::vector<ReportRatePer> rates;
  for (const auto& [name, rate] : json.items())
    rates.push_back({name, rate.at("k"), rate.at("exposure"), NumberOr(rate.at("rate"), kNone),
                     rate.at("lower"),
                     NumberOr(rate.at("upper"), std::numeric_limits<double>::infinity())});
  return rates;
}

// path_length_m -> "path length [m]"
std::string MetricName(const std::string& key) {
  static const std::map<std::string, std::string> kUnits = {
      {"m", "m"}, {"s", "s"}, {"j", "J"}, {"ah", "Ah"}, {"v", "V"}, {"ns", "N s"}};
  const std::size_t at = key.rfind('_');
  const auto unit = at == std::string::npos ? kUnits.end() : kUnits.find(key.substr(at + 1));
  std::string name = unit == kUnits.end() ? key : key.substr(0, at) + " [" + unit->second + "]";
  std::ranges::replace(name, '_', ' ');
  return name;
}

ReportVariant ReadVariant(const std::string& name, const Json& json) {
  ReportVariant v;
  v.name = name;
  v.n = json.at("n");
  v.errors = json.at("n_error");
  v.not_planned = json.at("n_not_planned");
  v.success = json.at("outcomes").at("success");
  v.failure = json.at("outcomes").at("failure");
  v.timeout = json.at("outcomes").at("timeout");
  v.failures = ReadRates(json.at("failures"));
  v.kinds = ReadRates(json.at("by_kind"));
  v.hazards = ReadRates(json.at("by_hazard"));
  v.places = ReadPlaces(json.at("by_place"));
  v.per_km = ReadRatesPer(json.at("per_km"));
  v.per_1000_h = ReadRatesPer(json.at("per_1000_h"));
  for (const auto& [metric, spread] : json.at("metrics").items())
    if (!spread.is_null())
      v.metrics.push_back({MetricName(metric), spread.at("mean"), spread.at("median"),
                           spread.at("min"), spread.at("max")});
  return v;
}

std::optional<ReportGate> ReadGate(const Json& json) {
  if (json.is_null()) return std::nullopt;
  ReportGate gate;
  gate.metric = json.at("metric");
  gate.max_rate = json.at("max_rate");
  gate.confidence = json.at("confidence");
  gate.mode = json.at("mode");
  const std::string verdict = json.at("verdict");
  gate.verdict = verdict == "passed"   ? ReportGate::Verdict::kPassed
                 : verdict == "failed" ? ReportGate::Verdict::kFailed
                                       : ReportGate::Verdict::kUndecided;
  for (const auto& [variant, state] : json.at("variants").items())
    gate.texts.emplace_back(variant, state.at("text").get<std::string>());
  return gate;
}

}  // namespace

void ReadSummary(const fs::path& file, Report& report) {
  if (const std::string why = WhyUnreadable(file, kMaxBytes); !why.empty())
    throw InputError({file.string(), 0}, "", "",
                     why + ": not the folder of a finished `campaign` (--resume finishes one)");
  try {
    const Json json = Json::parse(ReadInputFile(file, kMaxBytes));
    report.campaign = json.at("campaign");
    if (!json.at("unfinished").is_null()) report.unfinished = json.at("unfinished");
    for (const auto& [name, variant] : json.at("variants").items())
      report.variants.push_back(ReadVariant(name, variant));
    report.gate = ReadGate(json.at("gate"));
    for (const auto& [name, version] : json.at("versions").items())
      report.versions.emplace_back(name, version);
  } catch (const nlohmann::json::exception& e) {
    throw InputError({file.string(), 0}, "", "",
                     fmt::format("is no campaign's summary ({})", e.what()));
  }
}

}  // namespace floorproof

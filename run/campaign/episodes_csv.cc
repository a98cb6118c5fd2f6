// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/episodes_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/printable.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

std::string Field(const Json& value) {
  if (value.is_null()) return "";
  return CsvField(value.is_string() ? value.get<std::string>() : value.dump());
}

// Which plan.*, drawn.* and timeout.* columns there are, in the order first met.
struct CsvColumns {
  std::vector<std::string> plan, drawn, timeout;
  void See(const EpisodeRow& row) {
    SeeKeys(row.plan, plan);
    SeeKeys(row.drawn, drawn);
    SeeKeys(row.timeout, timeout);
  }

 private:
  static void SeeKeys(const std::string& text, std::vector<std::string>& names) {
    const Json json = Json::parse(text);
    for (const auto& [key, value] : json.items())
      if (std::ranges::find(names, key) == names.end()) names.push_back(key);
  }
};

}  // namespace

std::string EpisodesCsv(const CampaignStore& store, const std::vector<Variant>& variants) {
  CsvColumns columns;
  for (const Variant& variant : variants)
    store.ForEach(variant.name, [&](const EpisodeRow& row) { columns.See(row); });
  std::string csv = "variant,episode,outcome,message";
  for (int m = 0; m < kNumFailureModes; ++m)
    csv += "," + std::string(Name(static_cast<FailureMode>(m)));
  for (const MetricColumn& metric : kMetrics) csv += "," + std::string(metric.name);
  for (const std::string& name : columns.plan) csv += ",plan." + CsvField(name);
  for (const std::string& name : columns.drawn) csv += ",drawn." + CsvField(name);
  for (const std::string& name : columns.timeout) csv += ",timeout." + name;
  csv += "\n";
  for (const Variant& variant : variants)
    store.ForEach(variant.name, [&](const EpisodeRow& row) {
      csv += fmt::format("{},{},{},{}", CsvField(row.variant), row.episode, row.outcome,
                         CsvField(row.message));
      for (const int n : row.events_of) csv += fmt::format(",{}", n);
      for (const auto& value : row.metrics) csv += value ? fmt::format(",{}", *value) : ",";
      const Json plan = Json::parse(row.plan), drawn = Json::parse(row.drawn);
      Json timeout = Json::parse(row.timeout);
      if (timeout.is_null()) timeout = Json::object();
      for (const std::string& name : columns.plan) csv += "," + Field(plan.value(name, Json()));
      for (const std::string& name : columns.drawn) csv += "," + Field(drawn.value(name, Json()));
      for (const std::string& name : columns.timeout)
        csv += "," + Field(timeout.value(name, Json()));
      csv += "\n";
    });
  return csv;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/dependence_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/printable.h"
#include "base/quantity.h"
#include "stats/outward.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

const char* ShapeName(InfluenceShape shape) {
  switch (shape) {
    case InfluenceShape::kLower:
      return "lower";
    case InfluenceShape::kHigher:
      return "higher";
    case InfluenceShape::kEnds:
      return "ends";
    case InfluenceShape::kMiddle:
      return "middle";
    case InfluenceShape::kNone:
      break;
  }
  return "none";
}

std::string WhereText(const ValueDependence& value) {
  if (!value.is_number)
    return fmt::format("{} failures with {}", value.choice_fails_more ? "more" : "fewer",
                       Printable(value.choice));
  switch (value.shape) {
    case InfluenceShape::kLower:
      return "failures at lower values";
    case InfluenceShape::kHigher:
      return "failures at higher values";
    case InfluenceShape::kEnds:
      return "failures at both ends of the values";
    case InfluenceShape::kMiddle:
      return "failures in the middle of the values";
    case InfluenceShape::kNone:
      break;
  }
  return "an influence";
}

std::string PText(double p) {
  constexpr double kLeast = 0.0001;
  return p < kLeast ? "p < 0.0001" : "p = " + NumberText(p, 2);
}

// An edge is told so that no value beyond it is claimed.
std::string UpToText(double edge) { return NumberText(RoundedOutward({edge, edge}).lower); }
std::string FromText(double edge) { return NumberText(RoundedOutward({edge, edge}).upper); }

std::string OfText(const Stretch& stretch) { return fmt::format("{} of {}", stretch.k, stretch.n); }

std::string PartText(const SafeRange& safe) {
  if (safe.answer == SafeAnswer::kWhole)
    return fmt::format("over the whole range drawn ({} failed)", OfText(safe.whole));
  std::string text;
  if (safe.up_to)
    text = fmt::format("up to {} ({} failed)", UpToText(safe.up_to->edge), OfText(*safe.up_to));
  if (safe.from)
    text += fmt::format("{}from {} on ({} failed)", text.empty() ? "" : " and ",
                        FromText(safe.from->edge), OfText(*safe.from));
  return text;
}

// What is claimed of each part by itself.
std::string EachText(const SafeRange& safe) {
  if (safe.parts < 2) return "";
  if (!safe.each_up_to && !safe.each_from) return "; no part at either end is by itself";
  std::string text;
  if (safe.each_up_to) {
    if (safe.each_up_to->edge == safe.whole.edge) return "; and in each part by itself";
    text = "up to " + UpToText(safe.each_up_to->edge);
  }
  if (safe.each_from)
    text +=
        fmt::format("{}from {} on", text.empty() ? "" : " and ", FromText(safe.each_from->edge));
  return "; in each part by itself only " + text;
}

std::string NotShownText(const SafeRange& safe) {
  if (safe.first_low.n == 0 || safe.first_high.n == 0)
    return fmt::format("{} failed", OfText(safe.whole));
  return fmt::format("of the lowest {} values {} failed, of the highest {} values {}",
                     safe.first_low.n, safe.first_low.k, safe.first_high.n, safe.first_high.k);
}

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json Text(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json BinJson(const ValueBin& bin) {
  Json json = Json::object();
  if (std::isnan(bin.low))
    json["choice"] = bin.rate.name;
  else
    json = {{"low", bin.low}, {"high", bin.high}};
  json.update(Json{{"n", bin.rate.n},
                   {"k", bin.rate.k},
                   {"rate", Number(bin.rate.rate)},
                   {"lower", bin.rate.lower},
                   {"upper", bin.rate.upper}});
  return json;
}

Json BinsJson(const std::vector<ValueBin>& bins) {
  Json json = Json::array();
  for (const ValueBin& bin : bins) json.push_back(BinJson(bin));
  return json;
}

Json StretchJson(const std::optional<Stretch>& stretch) {
  if (!stretch) return nullptr;
  return {{"edge", stretch->edge}, {"n", stretch->n}, {"k", stretch->k}};
}

const char* AnswerName(SafeAnswer answer) {
  switch (answer) {
    case SafeAnswer::kTooFew:
      return "too_few";
    case SafeAnswer::kNotShown:
      return "not_shown";
    case SafeAnswer::kPart:
      return "part";
    case SafeAnswer::kWhole:
      break;
  }
  return "whole";
}

Json SafeJson(const ValueDependence& value, const SafeRangeSettings& limit) {
  if (!value.safe) return nullptr;
  return {{"answer", AnswerName(value.safe->answer)},
          {"needed", value.safe->needed},
          {"up_to", StretchJson(value.safe->up_to)},
          {"from", StretchJson(value.safe->from)},
          {"each_up_to", StretchJson(value.safe->each_up_to)},
          {"each_from", StretchJson(value.safe->each_from)},
          {"text", SafeText(value, limit)}};
}

Json ValueJson(const ValueDependence& value, const VariantDependence& variant) {
  const bool tested = value.bins.size() > 1;
  return {{"key", value.key},
          {"kind", value.is_number ? "number" : "choice"},
          {"n", value.n},
          {"k", value.k},
          {"p", tested ? Json(value.p) : Json(nullptr)},
          {"p_holm", tested ? Json(value.p_holm) : Json(nullptr)},
          {"telling", value.telling()},
          {"shape", tested && value.is_number ? Json(ShapeName(value.shape)) : Json(nullptr)},
          {"text", tested ? Json(InfluenceText(value, variant.looked_at)) : Json(nullptr)},
          {"bins", BinsJson(value.bins)},
          {"safe", SafeJson(value, variant.limit)}};
}

Json PairJson(const PairDependence& pair) {
  Json cells = Json::array();
  for (const PairCell& cell : pair.cells)
    cells.push_back({{"x", cell.x},
                     {"y", cell.y},
                     {"n", cell.rate.n},
                     {"k", cell.rate.k},
                     {"rate", Number(cell.rate.rate)},
                     {"lower", cell.rate.lower},
                     {"upper", cell.rate.upper}});
  return {{"x_key", pair.x_key},
          {"y_key", pair.y_key},
          {"x_bins", BinsJson(pair.x_bins)},
          {"y_bins", BinsJson(pair.y_bins)},
          {"cells", std::move(cells)}};
}

Json VariantJson(const VariantDependence& v) {
  Json values = Json::array(), pairs = Json::array();
  for (const ValueDependence& value : v.values) values.push_back(ValueJson(value, v));
  for (const PairDependence& pair : v.pairs) pairs.push_back(PairJson(pair));
  return {{"n", v.n},
          {"k", v.k},
          {"note", Text(v.note)},
          {"values_looked_at", v.looked_at},
          {"limit", {{"max_rate", v.limit.max_rate}, {"confidence", v.limit.confidence}}},
          {"values", std::move(values)},
          {"pairs", std::move(pairs)}};
}

}  // namespace

std::string BinText(const ValueBin& bin) {
  if (std::isnan(bin.low)) return Printable(bin.rate.name);
  if (bin.low == bin.high) return NumberText(bin.low);
  return NumberText(bin.low) + " to " + NumberText(bin.high);
}

std::string InfluenceText(const ValueDependence& value, int looked_at) {
  return fmt::format("{} ({}{})", value.telling() ? WhereText(value) : "no influence shown",
                     PText(value.p_holm),
                     looked_at > 1 ? fmt::format(" after Holm for {} values", looked_at) : "");
}

std::string SafeText(const ValueDependence& value, const SafeRangeSettings& limit) {
  if (!value.safe) return "";
  const SafeRange& safe = *value.safe;
  const std::string below = fmt::format("below {} at {}", PercentText(limit.max_rate, 4),
                                        PercentText(limit.confidence, 4));
  switch (safe.answer) {
    case SafeAnswer::kTooFew:
      return fmt::format(
          "{} too few to say up to which value failures are {}: it takes {}, "
          "without a failure",
          safe.whole.n == 1 ? "1 episode is" : CountText(safe.whole.n, "episode") + " are", below,
          safe.needed);
    case SafeAnswer::kNotShown:
      return fmt::format("not shown to be safe ({}) at either end: {}", below, NotShownText(safe));
    case SafeAnswer::kPart:
    case SafeAnswer::kWhole:
      break;
  }
  return fmt::format("safe on average ({}) {}{}", below, PartText(safe), EachText(safe));
}

std::vector<std::string> DependenceText(const VariantDependence& v, std::size_t most) {
  std::vector<std::string> lines;
  if (v.looked_at == 0) return lines;
  for (const ValueDependence& value : v.values) {
    if (!value.telling() || lines.size() == most) break;
    std::string line = fmt::format("{}: {}", value.key, InfluenceText(value, v.looked_at));
    if (const std::string safe = SafeText(value, v.limit); !safe.empty()) line += "; " + safe;
    lines.push_back(std::move(line));
  }
  if (lines.empty() && v.note.empty())
    lines.push_back(
        fmt::format("nothing drawn shows an influence on failures (the least {}{})",
                    PText(v.values.front().p_holm),
                    v.looked_at > 1 ? fmt::format(" after Holm for {} values", v.looked_at) : ""));
  return lines;
}

Json DependenceJson(const std::vector<VariantDependence>& variants) {
  Json json = Json::object();
  for (const VariantDependence& variant : variants) json[variant.variant] = VariantJson(variant);
  return {{"method", "clopper_pearson"},
          {"confidence", kReportedConfidence},
          {"variants", std::move(json)}};
}

std::string DependenceCsv(const std::vector<VariantDependence>& variants) {
  std::string csv = "variant,value,low,high,n,k,rate,lower,upper\n";
  for (const VariantDependence& variant : variants)
    for (const ValueDependence& value : variant.values)
      for (const ValueBin& bin : value.bins) {
        const auto edge = [&](double number) {
          return value.is_number ? fmt::format("{}", number) : CsvField(bin.rate.name);
        };
        csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", CsvField(variant.variant),
                           CsvField(value.key), edge(bin.low), edge(bin.high), bin.rate.n,
                           bin.rate.k, bin.rate.rate, bin.rate.lower, bin.rate.upper);
      }
  return csv;
}

}  // namespace floorproof

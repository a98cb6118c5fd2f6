// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/dependence_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/key_name.h"
#include "base/printable.h"
#include "base/quantity.h"
#include "stats/outward.h"

namespace floorproof {
namespace {

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

// The greatest value, whatever its sign.
double MostOf(const std::vector<ValueBin>& bins, double edge) {
  double most = std::abs(edge);
  for (const ValueBin& bin : bins)
    if (!std::isnan(bin.low)) most = std::max({most, std::abs(bin.low), std::abs(bin.high)});
  return most;
}

std::string PText(double p) {
  constexpr double kLeast = 0.0001;
  return p < kLeast ? "p < 0.0001" : "p = " + NumberText(p, 2);
}

// An edge is told so that no value beyond it is claimed.
std::string UpToText(double edge, const KeyScale& scale) {
  return scale.Of(NumberText(RoundedOutward({scale.per * edge, scale.per * edge}).lower));
}
std::string FromText(double edge, const KeyScale& scale) {
  return scale.Of(NumberText(RoundedOutward({scale.per * edge, scale.per * edge}).upper));
}

std::string OfText(const Stretch& stretch) { return fmt::format("{} of {}", stretch.k, stretch.n); }

std::string PartText(const SafeRange& safe, const KeyScale& scale) {
  if (safe.answer == SafeAnswer::kWhole)
    return fmt::format("over the whole range drawn ({} failed)", OfText(safe.whole));
  std::string text;
  if (safe.up_to)
    text =
        fmt::format("up to {} ({} failed)", UpToText(safe.up_to->edge, scale), OfText(*safe.up_to));
  if (safe.from)
    text += fmt::format("{}from {} on ({} failed)", text.empty() ? "" : " and ",
                        FromText(safe.from->edge, scale), OfText(*safe.from));
  return text;
}

// Of which values the claim of each part by itself holds: "up to 13.1 mm", "all", "none"; empty:
// there are no parts.
std::string EachPart(const SafeRange& safe, const KeyScale& scale) {
  if (safe.parts < 2) return "";
  if (!safe.each_up_to && !safe.each_from) return "none";
  std::string text;
  if (safe.each_up_to) {
    if (safe.each_up_to->edge == safe.whole.edge) return "all";
    text = "up to " + UpToText(safe.each_up_to->edge, scale);
  }
  if (safe.each_from)
    text += fmt::format("{}from {} on", text.empty() ? "" : " and ",
                        FromText(safe.each_from->edge, scale));
  return text;
}

std::string EachText(const SafeRange& safe, const KeyScale& scale) {
  const std::string each = EachPart(safe, scale);
  if (each.empty()) return "";
  if (each == "none") return "; no part at either end is by itself";
  if (each == "all") return "; and in each part by itself";
  return "; in each part by itself only " + each;
}

KeyScale SafeScale(const ValueDependence& value) {
  return ScaleOf(NameOfKey(value.key), MostOf(value.bins, value.safe->whole.edge));
}

std::string NotShownText(const SafeRange& safe) {
  if (safe.whole.k == safe.whole.n) return "every one failed, " + CountText(safe.whole.n, "drive");
  if (safe.first_low.n == 0 || safe.first_high.n == 0)
    return fmt::format("{} failed", OfText(safe.whole));
  return fmt::format("of the lowest {} values {} failed, of the highest {} values {}",
                     safe.first_low.n, safe.first_low.k, safe.first_high.n, safe.first_high.k);
}

}  // namespace

KeyScale BinScale(const std::string& key, const std::vector<ValueBin>& bins) {
  return ScaleOf(NameOfKey(key), MostOf(bins, 0));
}

std::string BinText(const ValueBin& bin, const KeyScale& scale) {
  if (std::isnan(bin.low)) return Printable(bin.rate.name);
  const std::string low = NumberText(scale.per * bin.low);
  return scale.Of(bin.low == bin.high ? low : low + " to " + NumberText(scale.per * bin.high));
}

std::string InfluenceText(const ValueDependence& value, int looked_at) {
  return fmt::format("{} ({}{})", value.telling() ? WhereText(value) : "no influence shown",
                     PText(value.p_holm),
                     looked_at > 1 ? fmt::format(" after Holm for {} values", looked_at) : "");
}

std::string SafeText(const ValueDependence& value, const SafeRangeSettings& limit,
                     std::string_view metric) {
  if (!value.safe) return "";
  const SafeRange& safe = *value.safe;
  const std::string below = fmt::format("{} below {} at {}", metric, PercentText(limit.max_rate, 4),
                                        PercentText(limit.confidence, 4));
  switch (safe.answer) {
    case SafeAnswer::kTooFew:
      if (safe.whole.k == safe.whole.n && safe.whole.n > 0)
        return fmt::format("not shown to be safe ({}): {}", below, NotShownText(safe));
      return fmt::format(
          "{} too few to say up to which value {} holds: it takes {}, "
          "without a failure",
          safe.whole.n == 1 ? "1 episode is" : CountText(safe.whole.n, "episode") + " are", below,
          safe.needed);
    case SafeAnswer::kNotShown:
      return fmt::format("not shown to be safe ({}) at either end: {}", below, NotShownText(safe));
    case SafeAnswer::kPart:
    case SafeAnswer::kWhole:
      break;
  }
  const KeyScale scale = SafeScale(value);
  return fmt::format("safe on average ({}) {}{}", below, PartText(safe, scale),
                     EachText(safe, scale));
}

SafeClauses SafeClausesOf(const ValueDependence& value) {
  if (!value.safe) return {};
  const SafeRange& safe = *value.safe;
  const bool all_failed = safe.whole.n > 0 && safe.whole.k == safe.whole.n;
  if (safe.answer == SafeAnswer::kTooFew && !all_failed)
    return {fmt::format("too few: it takes {}, without a failure", safe.needed), ""};
  if (safe.answer == SafeAnswer::kTooFew || safe.answer == SafeAnswer::kNotShown)
    return {"not shown: " + NotShownText(safe), ""};
  const KeyScale scale = SafeScale(value);
  return {PartText(safe, scale), EachPart(safe, scale)};
}

std::vector<std::string> DependenceText(const VariantDependence& v, std::size_t most) {
  std::vector<std::string> lines;
  if (v.looked_at == 0) return lines;
  for (const ValueDependence& value : v.values) {
    if (!value.telling() || lines.size() == most) break;
    const std::string name = NameOfKey(value.key).name;
    std::string line =
        fmt::format("{}: {}", name == value.key ? name : name + " (" + value.key + ")",
                    InfluenceText(value, v.looked_at));
    if (const std::string safe = SafeText(value, v.limit, v.metric); !safe.empty())
      line += "; " + safe;
    lines.push_back(std::move(line));
  }
  if (lines.empty() && v.note.empty())
    lines.push_back(
        fmt::format("nothing drawn shows an influence on failures (the least {}{})",
                    PText(v.values.front().p_holm),
                    v.looked_at > 1 ? fmt::format(" after Holm for {} values", v.looked_at) : ""));
  return lines;
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

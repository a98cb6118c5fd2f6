// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/distribution.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>

#include "base/json_schema.h"
#include "base/params.h"
#include "base/quantity.h"

namespace floorproof {
namespace {

constexpr double kLeastMass = 0.01;  // of a bounded normal: else redrawing would go on for ever
// Of choices and ranges. A campaign reads the scenario once for each choice before it begins.
constexpr std::size_t kMaxValues = 1'000;
constexpr int kMaxRedraws = 10'000;  // 0.99^10000 = 2e-44 that none of them keeps the bounds

double Cumulative(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }
double InverseCumulative(double p) { return -std::sqrt(2.0) * boost::math::erfc_inv(2 * p); }

// How likely a draw of a normal or lognormal distribution lies below x, its bounds aside.
double Below(const Distribution& d, double x) {
  if (d.kind == Distribution::Kind::kNormal) return Cumulative((x - d.a) / d.b);
  return x <= 0 ? 0.0 : Cumulative(std::log(x / d.a) / d.b);
}

// How likely a draw keeps its bounds.
double Mass(const Distribution& d) { return Below(d, d.max) - Below(d, d.min); }

// Of a normal or lognormal distribution that is cut off at its bounds.
double BoundedQuantile(const Distribution& d, double probability) {
  if (d.b == 0) return d.a;
  constexpr double kLeast = std::numeric_limits<double>::min(), kMost = 1 - 0x1p-53;
  const double low = Below(d, d.min), high = Below(d, d.max);
  const double z = InverseCumulative(std::clamp(low + probability * (high - low), kLeast, kMost));
  const double x = d.kind == Distribution::Kind::kNormal ? d.a + d.b * z : d.a * std::exp(d.b * z);
  return std::clamp(x, d.min, d.max);
}

// [low, high], or a list of these.
std::vector<std::pair<double, double>> ReadSpans(const ConfigNode& values, const std::string& key) {
  const bool several = !values.items.empty() && values.items.front().IsList();
  std::vector<std::pair<double, double>> spans;
  const std::vector<ConfigNode> written = several ? values.items : std::vector<ConfigNode>{values};
  for (const ConfigNode& span : written) {
    if (!span.IsList() || span.items.size() != 2)
      throw InputError(span.mark, key, "",
                       several ? "must be a list of [low, high]" : "must be a list of two numbers");
    const double low = AsDouble(span.items[0], key), high = AsDouble(span.items[1], key);
    if (low > high)
      throw InputError(span.mark, key, FormatDouble(high),
                       "the upper bound must not be below the lower");
    if (several && low == high)
      throw InputError(span.mark, key, FormatDouble(low), "of several ranges none may be empty");
    if (!spans.empty() && low < spans.back().second)
      throw InputError(span.mark, key, FormatDouble(low),
                       "several ranges must not overlap, the lowest first");
    spans.emplace_back(low, high);
  }
  return spans;
}

// The place below which this share of the ranges lies.
double At(const std::vector<std::pair<double, double>>& spans, double share) {
  double whole = 0;
  for (const auto& [low, high] : spans) whole += high - low;
  double left = whole * share;
  for (const auto& [low, high] : spans) {
    if (left < high - low) return low + left;
    left -= high - low;
  }
  return spans.back().second;
}

}  // namespace

ConfigNode Distribution::Draw(Stream& stream) const {
  if (kind == Kind::kChoice) return choices[stream.Below(choices.size())];
  double value = 0;
  for (int i = 0; i < kMaxRedraws; ++i) {
    if (kind == Kind::kUniform) value = At(spans, stream.Uniform());
    if (kind == Kind::kNormal) value = a + b * stream.Normal();
    if (kind == Kind::kLognormal) value = a * std::exp(b * stream.Normal());
    if (value >= min && value <= max) break;
  }
  return ConfigNode::Scalar(FormatDouble(value));
}

ConfigNode Distribution::Quantile(double probability) const {
  if (kind == Kind::kChoice) {
    const auto n = static_cast<double>(choices.size());
    return choices[std::min(choices.size() - 1, static_cast<std::size_t>(probability * n))];
  }
  const double value =
      kind == Kind::kUniform ? At(spans, probability) : BoundedQuantile(*this, probability);
  return ConfigNode::Scalar(FormatDouble(value));
}

bool Distribution::varies() const {
  if (kind == Kind::kUniform) return spans.front().first < spans.back().second;
  if (kind != Kind::kChoice) return b > 0 && min < max;
  return std::ranges::any_of(
      choices, [&](const ConfigNode& c) { return WriteYaml(c) != WriteYaml(choices.front()); });
}

ConfigNode DistributionSchema(const MapSchema& others) {
  const ConfigNode number = NumberSchema(Any()), pair = ListSchema(number, 2, 2);
  const auto add = [&](const char* name, ConfigNode values, const char* help) -> MapSchema {
    return MapSchema(others).Key(name, std::move(values), help).Require(name);
  };
  const auto bounded = [&](MapSchema map) {
    return map.Key("min", number, "the least that is drawn")
        .Key("max", number, "the most that is drawn")
        .Node();
  };
  return AnyOf(
      {add("uniform", AnyOf({pair, ListSchema(pair, 1, kMaxValues)}),
           "[low, high], or a list of these")
           .Node(),
       bounded(add("normal", pair, "[mean, standard deviation]")),
       bounded(add("lognormal", pair, "[median, standard deviation of the logarithm]")),
       add("choice", ListSchema(AnythingSchema(), 1, kMaxValues), "one of these values").Node()});
}

Distribution ReadDistribution(const ConfigNode& node, const std::string& path,
                              const std::vector<std::string>& also_allowed) {
  const std::vector<std::string> kinds = {"uniform", "normal", "lognormal", "choice"};
  if (!node.IsMap())
    throw InputError(node.mark, path, node.scalar,
                     "must be {uniform: [low, high]}, {normal: [mean, deviation]}, {lognormal: "
                     "[median, deviation of the logarithm]} or {choice: [a, b, ..]}");
  std::vector<std::string> known = kinds;
  known.insert(known.end(), {"min", "max"});
  known.insert(known.end(), also_allowed.begin(), also_allowed.end());
  RefuseUnknownKeys(node, path + ".", known);
  Distribution d;
  const ConfigNode* values = nullptr;
  std::string name;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (const ConfigNode* found = node.Find(kinds[i])) {
      if (values != nullptr)
        throw InputError(node.mark, path, "",
                         "holds two distributions, " + name + " and " + kinds[i]);
      values = found;
      name = kinds[i];
      d.kind = static_cast<Distribution::Kind>(i);
    }
  if (values == nullptr)
    throw InputError(node.mark, path, "",
                     "names no distribution: uniform, normal, lognormal or choice");
  const std::string key = path + "." + name;
  if (!values->IsList()) throw InputError(values->mark, key, values->scalar, "must be a list");
  if (values->items.size() > kMaxValues)
    throw InputError(values->mark, key, CountText(values->items.size(), "value"),
                     "must be a list of at most " + std::to_string(kMaxValues) + " values");
  if (d.kind == Distribution::Kind::kChoice) {
    if (values->items.empty()) throw InputError(values->mark, key, "", "must hold a value or more");
    d.choices = values->items;
  } else if (d.kind == Distribution::Kind::kUniform) {
    d.spans = ReadSpans(*values, key);
  } else {
    if (values->items.size() != 2)
      throw InputError(values->mark, key, "", "must be a list of two numbers");
    d.a = AsDouble(values->items[0], key);
    d.b = AsDouble(values->items[1], key);
    if (!(d.b >= 0))
      throw InputError(values->mark, key, FormatDouble(d.b), "a deviation must be >= 0");
    if (d.kind == Distribution::Kind::kLognormal && !(d.a > 0))
      throw InputError(values->mark, key, FormatDouble(d.a), "a median must be > 0");
  }
  const ConfigNode *min = node.Find("min"), *max = node.Find("max");
  if (min == nullptr && max == nullptr) return d;
  if (d.kind != Distribution::Kind::kNormal && d.kind != Distribution::Kind::kLognormal)
    throw InputError((min ? min : max)->mark, path, "", "min and max are for normal and lognormal");
  if (min != nullptr) d.min = AsDouble(*min, path + ".min");
  if (max != nullptr) d.max = AsDouble(*max, path + ".max");
  const bool possible = d.b > 0 ? Mass(d) >= kLeastMass : d.a >= d.min && d.a <= d.max;
  if (!possible)
    throw InputError(node.mark, path, "", "fewer than one draw in a hundred keeps min and max");
  return d;
}

}  // namespace floorproof

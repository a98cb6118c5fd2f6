// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_comparison.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "run/campaign/campaign_gate.h"
#include "run/campaign/repetition.h"
#include "run/scenario/draws.h"
#include "stats/paired.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

// A row without its texts, of which a hundred thousand would not fit.
struct BriefRow {
  EpisodeRow row;
  std::string result;        // its hash
  std::vector<double> plan;  // its figures, in the order of PlanFigures; NaN: not there
};
struct Pair {
  BriefRow a, b;
};

// The numbers of plan.json, in the order first met.
class PlanFigures {
 public:
  std::vector<double> Read(const std::string& text) {
    std::vector<double> values(names_.size(), kNone);
    const Json json = Json::parse(text);
    for (const auto& [key, value] : json.items()) {
      if (!value.is_number()) continue;
      const std::size_t at = Find(key);
      if (at == names_.size()) names_.push_back(key);
      values.resize(names_.size(), kNone);
      values[at] = value.get<double>();
    }
    return values;
  }
  const std::vector<std::string>& names() const { return names_; }
  std::size_t Find(std::string_view name) const {
    return static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
  }
  static double Of(const BriefRow& row, std::size_t figure) {
    return figure < row.plan.size() ? row.plan[figure] : kNone;
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> names_;
};

// What two episodes drew that differs, in words; empty: nothing.
std::string DifferentDraws(const std::string& text_a, const std::string& text_b) {
  constexpr int kShown = 3;
  if (text_a == text_b) return "";
  const Json a = Json::parse(text_a), b = Json::parse(text_b);
  const auto shown = [](const Json& value) {
    return value.is_structured() ? std::string(kValueInParts)
           : value.is_string()   ? value.get<std::string>()
                                 : value.dump();
  };
  std::string text;
  int different = 0;
  const auto add = [&](const std::string& difference) {
    if (++different <= kShown) text += (text.empty() ? "" : ", ") + difference;
  };
  for (const auto& [key, value] : a.items())
    if (!b.contains(key))
      add(key + " in a alone");
    else if (b[key] != value)
      add(key + " " + shown(value) + " in a and " + shown(b[key]) + " in b");
  for (const auto& [key, value] : b.items())
    if (!a.contains(key)) add(key + " in b alone");
  if (different > kShown) text += " and " + std::to_string(different - kShown) + " more";
  return text;
}

bool Counts(const Pair& pair) { return pair.a.row.counts() && pair.b.row.counts(); }

// Pairs of all episodes but errors. Counts the episodes that one side alone has.
std::vector<Pair> Pairs(const CampaignStore& a, const CampaignStore& b, PlanFigures& figures,
                        Comparison& out) {
  const auto brief = [&](EpisodeRow row) {
    BriefRow kept{std::move(row), {}, {}};
    kept.result = kept.row.ResultHash();
    kept.plan = figures.Read(kept.row.plan);
    kept.row.plan.clear();
    kept.row.events.clear();
    return kept;
  };
  std::map<std::uint64_t, BriefRow> rows;
  a.ForEach(out.a, [&](const EpisodeRow& row) {
    out.only_a += row.counts();
    if (CountsBy(kNotSuccess, row)) rows.emplace(row.episode, brief(row));
  });
  std::vector<Pair> pairs;
  b.ForEach(out.b, [&](const EpisodeRow& row) {
    out.only_b += row.counts();
    const auto found = rows.find(row.episode);
    if (found == rows.end() || !CountsBy(kNotSuccess, row)) return;
    if (const std::string differs = DifferentDraws(found->second.row.drawn, row.drawn);
        !differs.empty())
      throw InputError({}, "episode", std::to_string(row.episode),
                       "drew " + differs +
                           ": a paired comparison needs the same draws, of the same `seed` and "
                           "the same `randomise`");
    pairs.push_back({std::move(found->second), brief(row)});
    pairs.back().a.row.drawn.clear();
    pairs.back().b.row.drawn.clear();
  });
  const auto both = static_cast<int>(std::ranges::count_if(pairs, Counts));
  out.only_a -= both;
  out.only_b -= both;
  return pairs;
}

// Pairs that came out the same on both sides are one pair, driven again.
void JoinRepeated(std::vector<Pair>& pairs, Comparison& out) {
  Repetition repetition;
  for (const Pair& pair : pairs) repetition.Add(pair.a.result + pair.b.result);
  if (!repetition.repeated()) return;
  out.repeats = static_cast<int>(pairs.size());
  pairs.resize(1);
}

// What sums of numbers as large as these may have by rounding where they should have nothing.
double Rounding(const std::vector<Pair>& pairs, std::size_t figure) {
  double largest = 1;
  for (const Pair& pair : pairs)
    for (const BriefRow* row : {&pair.a, &pair.b})
      if (const double value = PlanFigures::Of(*row, figure); !std::isnan(value))
        largest = std::max(largest, std::abs(value));
  return 1e-12 * largest;
}

// -1 where b is lower than a, 0 where they are the same but for rounding, 1 where it is higher;
// none: one of them is not there.
std::optional<int> Order(double a, double b, double rounding) {
  constexpr double kSame = 1e-9;
  if (std::isnan(a) || std::isnan(b)) return std::nullopt;
  const double same = std::max(kSame * std::abs(a), rounding);
  return b - a < -same ? -1 : b - a > same ? 1 : 0;
}

ComparedPlanFigure ComparePlans(const std::string& name, std::size_t figure,
                                const std::vector<Pair>& pairs) {
  ComparedPlanFigure out;
  out.figure = name;
  std::vector<double> a, b, change;
  const double rounding = Rounding(pairs, figure);
  for (const Pair& pair : pairs) {
    const double of_a = PlanFigures::Of(pair.a, figure), of_b = PlanFigures::Of(pair.b, figure);
    const std::optional<int> order = Order(of_a, of_b, rounding);
    if (!order) continue;
    a.push_back(of_a);
    b.push_back(of_b);
    if (std::abs(of_a) > rounding) change.push_back((of_b - of_a) / of_a);
    ++(*order < 0 ? out.lower : *order > 0 ? out.higher : out.same);
  }
  out.n = static_cast<int>(a.size());
  if (out.n == 0) return out;
  if (change.size() == a.size()) out.change = QuartilesOf(std::move(change));
  out.a = QuartilesOf(std::move(a));
  out.b = QuartilesOf(std::move(b));
  return out;
}

ComparedPlans CompareRiskAndLength(const PlanFigures& figures, const std::vector<Pair>& pairs) {
  const std::size_t risk = figures.Find("cumulative_risk"), length = figures.Find("length_m");
  const double risk_rounding = Rounding(pairs, risk), length_rounding = Rounding(pairs, length);
  ComparedPlans out;
  for (const Pair& pair : pairs) {
    const auto order = [&](std::size_t figure, double rounding) {
      return Order(PlanFigures::Of(pair.a, figure), PlanFigures::Of(pair.b, figure), rounding);
    };
    const std::optional<int> by_risk = order(risk, risk_rounding),
                             by_length = order(length, length_rounding);
    if (!by_risk || !by_length) continue;
    ++out.n;
    out.both_lower += *by_risk < 0 && *by_length < 0;
    out.none_higher += *by_risk <= 0 && *by_length <= 0;
    out.same += *by_risk == 0 && *by_length == 0;
  }
  return out;
}

template <class Fails>
ComparedFailure CompareFailures(const std::string& mode, const std::vector<Pair>& pairs,
                                Fails&& fails) {
  ComparedFailure out;
  out.mode = mode;
  for (const Pair& pair : pairs) {
    const bool a = fails(pair.a.row), b = fails(pair.b.row);
    ++(a && b ? out.both : a ? out.only_a : b ? out.only_b : out.neither);
  }
  const PairedCounts counts{out.both, out.only_b, out.only_a, out.neither};  // b first: b - a
  out.difference = counts.n() > 0 ? static_cast<double>(out.only_b - out.only_a) / counts.n()
                                  : std::numeric_limits<double>::quiet_NaN();
  out.interval = PairedRateDifference(counts, kReportedConfidence);
  out.p = McNemarExact(out.only_a, out.only_b);
  return out;
}

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json QuartilesJson(const Quartiles& q) {
  return {{"lower_quartile", q.lower}, {"median", q.median}, {"upper_quartile", q.upper}};
}

Json DifferenceJson(const PairedDifference& difference) {
  return {{"estimate", Number(difference.estimate)},
          {"lower", Number(difference.interval.lower)},
          {"upper", Number(difference.interval.upper)}};
}

}  // namespace

Comparison CompareVariants(const CampaignStore& a, const std::string& variant_a,
                           const CampaignStore& b, const std::string& variant_b) {
  PlanFigures figures;
  Comparison out;
  out.a = variant_a;
  out.b = variant_b;
  std::vector<Pair> pairs = Pairs(a, b, figures, out);
  JoinRepeated(pairs, out);
  ComparedFailure not_success =
      CompareFailures(std::string(kNotSuccess), pairs,
                      [](const EpisodeRow& row) { return FailsBy(kNotSuccess, row); });
  // All other rates are of drives: one that was repeated counts once, whatever had no plan.
  std::erase_if(pairs, std::not_fn(Counts));
  JoinRepeated(pairs, out);
  out.n = static_cast<int>(pairs.size());
  out.failures.push_back(CompareFailures("any_failure", pairs,
                                         [](const EpisodeRow& row) { return row.any_failure(); }));
  for (std::size_t m = 0; m < kNumFailureModes; ++m)
    out.failures.push_back(
        CompareFailures(std::string(Name(static_cast<FailureMode>(m))), pairs,
                        [m](const EpisodeRow& row) { return row.events_of[m] > 0; }));
  out.failures.push_back(std::move(not_success));
  for (std::size_t i = 0; i < kMetrics.size(); ++i) {
    ComparedMetric compared{std::string(kMetrics[i].name), kMetrics[i].needs_success, {}, {}};
    std::vector<double> differences;
    for (const Pair& pair : pairs) {
      const EpisodeRow &row_a = pair.a.row, &row_b = pair.b.row;
      const bool succeed = row_a.outcome == "success" && row_b.outcome == "success";
      if (row_a.metrics[i] && row_b.metrics[i] && (succeed || !compared.successes_only))
        differences.push_back(*row_b.metrics[i] - *row_a.metrics[i]);
    }
    if (differences.empty()) continue;
    compared.mean = MeanDifference(differences, kReportedConfidence);
    compared.median = MedianDifference(differences, kReportedConfidence);
    out.metrics.push_back(std::move(compared));
  }
  for (std::size_t i = 0; i < figures.names().size(); ++i)
    if (auto compared = ComparePlans(figures.names()[i], i, pairs); compared.n > 0)
      out.plans.push_back(std::move(compared));
  out.risk_and_length = CompareRiskAndLength(figures, pairs);
  return out;
}

Json ComparisonJson(const Comparison& c) {
  Json failures = Json::object(), metrics = Json::object(), plans = Json::object();
  for (const ComparedFailure& f : c.failures)
    failures[f.mode] = {{"a", f.both + f.only_a},
                        {"b", f.both + f.only_b},
                        {"only_a", f.only_a},
                        {"only_b", f.only_b},
                        {"difference", Number(f.difference)},
                        {"lower", f.interval.lower},
                        {"upper", f.interval.upper},
                        {"p", f.p}};
  for (const ComparedMetric& m : c.metrics)
    metrics[m.metric] = {{"n", m.mean.n},
                         {"successes_only", m.successes_only},
                         {"mean", DifferenceJson(m.mean)},
                         {"median", DifferenceJson(m.median)}};
  for (const ComparedPlanFigure& f : c.plans)
    plans[f.figure] = {{"n", f.n},
                       {"a", QuartilesJson(f.a)},
                       {"b", QuartilesJson(f.b)},
                       {"change", f.change ? QuartilesJson(*f.change) : Json(nullptr)},
                       {"lower", f.lower},
                       {"same", f.same},
                       {"higher", f.higher}};
  return {{"a", c.a},
          {"b", c.b},
          {"n", c.n},
          {"repeats", c.repeats},
          {"only_a", c.only_a},
          {"only_b", c.only_b},
          {"confidence", kReportedConfidence},
          {"failures", std::move(failures)},
          {"metrics", std::move(metrics)},
          {"plans", std::move(plans)},
          {"risk_and_length",
           {{"n", c.risk_and_length.n},
            {"both_lower", c.risk_and_length.both_lower},
            {"none_higher", c.risk_and_length.none_higher},
            {"same", c.risk_and_length.same}}}};
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/dependence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <utility>

#include "base/params.h"
#include "base/quantity.h"
#include "run/campaign/campaign_gate.h"
#include "stats/binomial.h"
#include "stats/equal_bins.h"
#include "stats/holm.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostBins = 8, kFewestOfBin = 10;   // shown; more only where there are episodes
constexpr int kMostGrid = 6, kFewestOfCell = 10;  // a side of a pair's grid
constexpr int kTestGroups = 32;         // of the test, which sees more than eight bins show
constexpr std::size_t kMostPaired = 3;  // numbers of which pairs are made

// What a key drew in each counted episode.
struct Column {
  std::string key;
  std::vector<double> numbers;  // NaN: no number, or not drawn
  std::vector<int> texts;       // -1: no text; else which of `labels`
  std::map<std::string, int> labels;

  void Resize(std::size_t episodes) {
    numbers.resize(episodes, kNone);
    texts.resize(episodes, -1);
  }
  void Add(const Json& value) {
    if (value.is_number()) {
      numbers.back() = value.get<double>();
      return;
    }
    const std::string label = value.is_string() ? value.get<std::string>() : value.dump();
    texts.back() = labels.emplace(label, static_cast<int>(labels.size())).first->second;
  }
  // Whoever draws numbers and texts draws choices.
  bool is_number() const { return labels.empty(); }
};

// A variant's counted episodes, column by column.
struct Table {
  std::string metric{};
  std::vector<Column> columns{};  // in the order first met
  std::vector<bool> failed{};

  void Add(const EpisodeRow& row) {
    failed.push_back(FailsBy(metric, row));
    for (Column& column : columns) column.Resize(failed.size());
    const Json drawn = Json::parse(row.drawn);
    std::size_t at = 0;  // episodes draw the same keys in the same order, as a rule
    for (const auto& [key, value] : drawn.items()) {
      if (at >= columns.size() || columns[at].key != key)
        at = static_cast<std::size_t>(std::ranges::find(columns, key, &Column::key) -
                                      columns.begin());
      if (at == columns.size()) {
        columns.push_back({key, {}, {}, {}});
        columns.back().Resize(failed.size());
      }
      columns[at++].Add(value);
    }
  }
  int failures() const { return static_cast<int>(std::ranges::count(failed, true)); }
};

std::vector<DrawnOutcome> Ascending(const Column& column, const std::vector<bool>& failed) {
  std::vector<DrawnOutcome> outcomes;
  for (std::size_t i = 0; i < failed.size(); ++i)
    if (std::isfinite(column.numbers[i])) outcomes.push_back({column.numbers[i], failed[i]});
  std::ranges::sort(outcomes, {}, &DrawnOutcome::value);
  return outcomes;
}

std::vector<double> ValuesOf(const std::vector<DrawnOutcome>& outcomes) {
  std::vector<double> values;
  values.reserve(outcomes.size());
  for (const DrawnOutcome& outcome : outcomes) values.push_back(outcome.value);
  return values;
}

// The outcomes in at most so many bins of equal counts.
std::vector<ValueBin> Bins(const std::vector<DrawnOutcome>& ascending, int most) {
  std::vector<ValueBin> bins;
  std::size_t begin = 0;
  for (const std::size_t end : EqualBins(ValuesOf(ascending), most)) {
    const std::span<const DrawnOutcome> within(&ascending[begin], end - begin);
    const auto k = static_cast<int>(std::ranges::count(within, true, &DrawnOutcome::failed));
    bins.push_back({within.front().value, within.back().value,
                    CountedRate("", k, static_cast<int>(within.size()))});
    begin = end;
  }
  return bins;
}

int BinsOf(std::size_t episodes) {
  return std::clamp(static_cast<int>(episodes) / kFewestOfBin, 2, kMostBins);
}

std::vector<GroupCounts> Counts(const std::vector<ValueBin>& bins) {
  std::vector<GroupCounts> counts;
  for (const ValueBin& bin : bins) counts.push_back({bin.rate.n, bin.rate.k});
  return counts;
}

void Count(ValueDependence& value) {
  for (const ValueBin& bin : value.bins) value.n += bin.rate.n, value.k += bin.rate.k;
}

ValueDependence DependenceOfChoice(const Column& column, const std::vector<bool>& failed) {
  ValueDependence out{.key = column.key, .is_number = false};
  std::vector<std::string> names(column.labels.size());
  for (const auto& [label, at] : column.labels) names[static_cast<std::size_t>(at)] = label;
  std::map<std::string, GroupCounts> counts;
  for (std::size_t i = 0; i < failed.size(); ++i) {
    const bool is_text = column.texts[i] >= 0;
    if (!is_text && !std::isfinite(column.numbers[i])) continue;
    GroupCounts& group = counts[is_text ? names[static_cast<std::size_t>(column.texts[i])]
                                        : FormatDouble(column.numbers[i])];
    ++group.n;
    group.k += failed[i];
  }
  for (const auto& [name, group] : counts)
    out.bins.push_back({kNone, kNone, CountedRate(name, group.k, group.n)});
  const ChoiceInfluence found = TestChoices(Counts(out.bins));
  out.p = found.p;
  out.choice = out.bins.empty() ? "" : out.bins[found.choice].rate.name;
  out.choice_fails_more = found.z > 0;
  out.z = std::abs(found.z);
  Count(out);
  return out;
}

PairDependence Pair(const Column& x, const Column& y, const std::vector<bool>& failed) {
  PairDependence out{x.key, y.key, {}, {}, {}};
  std::vector<DrawnOutcome> of_x, of_y;  // of episodes that drew both
  for (std::size_t i = 0; i < failed.size(); ++i)
    if (std::isfinite(x.numbers[i]) && std::isfinite(y.numbers[i])) {
      of_x.push_back({x.numbers[i], failed[i]});
      of_y.push_back({y.numbers[i], failed[i]});
    }
  const int side = std::clamp(
      static_cast<int>(std::sqrt(static_cast<double>(of_x.size()) / kFewestOfCell)), 2, kMostGrid);
  const auto bins = [side](std::vector<DrawnOutcome> outcomes) {
    std::ranges::sort(outcomes, {}, &DrawnOutcome::value);
    return Bins(outcomes, side);
  };
  out.x_bins = bins(of_x);
  out.y_bins = bins(of_y);
  const std::size_t width = out.x_bins.size();
  std::vector<GroupCounts> counts(width * out.y_bins.size());
  const auto bin_of = [](const std::vector<ValueBin>& of, double value) {
    return static_cast<std::size_t>(std::ranges::lower_bound(of, value, {}, &ValueBin::high) -
                                    of.begin());
  };
  for (std::size_t i = 0; i < of_x.size(); ++i) {
    GroupCounts& cell =
        counts[bin_of(out.y_bins, of_y[i].value) * width + bin_of(out.x_bins, of_x[i].value)];
    ++cell.n;
    cell.k += of_x[i].failed;
  }
  for (std::size_t c = 0; c < counts.size(); ++c)
    out.cells.push_back({c % width, c / width, CountedRate("", counts[c].k, counts[c].n)});
  return out;
}

// The two most telling numbers; a third where it is telling.
// `columns`: of the table, which one each value is of.
void AddPairs(const Table& table, const std::vector<std::size_t>& columns, VariantDependence& out) {
  std::vector<const Column*> paired;
  for (std::size_t i = 0; i < out.values.size() && paired.size() < kMostPaired; ++i) {
    const ValueDependence& value = out.values[i];
    if (value.is_number && value.differs() && (paired.size() < 2 || value.telling()))
      paired.push_back(&table.columns[columns[i]]);
  }
  for (std::size_t y = 1; y < paired.size(); ++y)
    for (std::size_t x = 0; x < y; ++x)
      out.pairs.push_back(Pair(*paired[x], *paired[y], table.failed));
}

// Returns where each value stood before.
std::vector<std::size_t> OrderAndCorrect(VariantDependence& out) {
  const std::vector<std::size_t> order = MostTellingFirst(out.values);
  std::vector<ValueDependence> values;
  for (const std::size_t i : order) values.push_back(std::move(out.values[i]));
  out.values = std::move(values);
  out.looked_at = CorrectByHolm(out.values);
  return order;
}

std::string WhyNoBins(const VariantDependence& v, bool repeated) {
  if (repeated) return "all episodes came out the same: nothing can be told apart";
  if (v.n < kFewestToDepend)
    return fmt::format("{}: from {} on the rates are told apart by what was drawn",
                       CountText(v.n, "episode"), kFewestToDepend);
  if (v.k == 0) return "no episode failed: there is nothing that failures depend on";
  if (v.k == v.n) return "every episode failed, whatever was drawn";
  return "";
}

VariantDependence Depend(const Table& table, const VariantSummary& variant,
                         const SafeRangeSettings& limit) {
  VariantDependence out{.variant = variant.name,
                        .metric = table.metric,
                        .n = static_cast<int>(table.failed.size()),
                        .k = table.failures(),
                        .limit = limit};
  out.note = WhyNoBins(out, variant.repeated);
  for (const Column& column : table.columns)
    out.values.push_back(
        column.is_number() ? DependenceOfNumber(column.key, Ascending(column, table.failed), limit)
                           : DependenceOfChoice(column, table.failed));
  const std::vector<std::size_t> columns = OrderAndCorrect(out);
  if (out.note.empty()) {
    AddPairs(table, columns, out);
    return out;
  }
  out.looked_at = 0;
  for (ValueDependence& value : out.values)
    value = {.key = value.key,
             .is_number = value.is_number,
             .n = value.n,
             .k = value.k,
             .safe = variant.repeated ? std::nullopt : value.safe};
  return out;
}

}  // namespace

std::vector<std::size_t> MostTellingFirst(const std::vector<ValueDependence>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    if (values[a].differs() != values[b].differs()) return values[a].differs();
    if (values[a].p != values[b].p) return values[a].p < values[b].p;
    return values[a].z > values[b].z;
  });
  return order;
}

int CorrectByHolm(std::vector<ValueDependence>& values) {
  std::vector<double> p;
  for (const ValueDependence& value : values)
    if (value.differs()) p.push_back(value.p);
  const std::vector<double> adjusted = HolmAdjusted(p);
  auto next = adjusted.begin();
  for (ValueDependence& value : values)
    if (value.differs()) value.p_holm = *next++;
  return static_cast<int>(p.size());
}

ValueDependence DependenceOfNumber(const std::string& key,
                                   const std::vector<DrawnOutcome>& ascending,
                                   const SafeRangeSettings& limit) {
  ValueDependence out{.key = key};
  out.bins = Bins(ascending, BinsOf(ascending.size()));
  const OrderedInfluence found = TestOrdered(Counts(Bins(ascending, kTestGroups)));
  out.p = found.p;
  out.z = std::abs(found.z);
  out.shape = found.shape;
  out.safe = FindSafeRange(ascending, limit);
  Count(out);
  return out;
}

std::vector<VariantDependence> DependenceOf(const CampaignStore& store,
                                            const CampaignSummary& summary) {
  SafeRangeSettings limit;
  if (summary.gate)
    limit = {summary.gate->max_rate, summary.gate->confidence, summary.gate->mode == "sequential"};
  std::vector<VariantDependence> out;
  for (const VariantSummary& variant : summary.variants) {
    Table table{.metric = summary.gate ? summary.gate->metric : VariantDependence{}.metric};
    store.ForEach(variant.name, [&](const EpisodeRow& row) {
      // Without a drive the only question is whether there is a plan.
      if (CountsBy(table.metric, row) && (row.driven() || table.metric == kNotSuccess))
        table.Add(row);
    });
    out.push_back(Depend(table, variant, limit));
  }
  return out;
}

}  // namespace floorproof

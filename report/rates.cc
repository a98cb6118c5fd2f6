// SPDX-License-Identifier: Apache-2.0
#include "report/rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "base/quantity.h"
#include "base/words.h"
#include "report/html.h"
#include "report/rates_table.h"
#include "report/verdict.h"
#include "run/episode/metrics.h"

namespace floorproof {
namespace {

std::string IntervalText(const std::string& lower, const std::string& upper) {
  return lower + " to " + upper;
}

// The axis that all plots of a page share, so that they compare.
double ReachOf(const Report& report) {
  double most = report.summary.gate ? report.summary.gate->max_rate : 0;
  for (const VariantSummary& variant : report.summary.variants)
    for (const auto* rates : {&variant.failures, &variant.kinds, &variant.hazards})
      for (const FailureRate& rate : *rates) most = std::max(most, rate.upper);
  return AxisEnd(most);
}

RatesPlot PlotOf(const Report& report) {
  if (!report.summary.gate) return {ReachOf(report)};
  return {ReachOf(report), report.summary.gate->max_rate, report.summary.gate->metric};
}

std::vector<std::string> RowNames(const std::vector<FailureRate>& rates, bool as_words) {
  std::vector<std::string> names;
  for (const FailureRate& rate : rates) names.push_back(as_words ? Words(rate.name) : rate.name);
  return names;
}

std::string Outcomes(const VariantSummary& v) {
  struct Part {
    const char* name;
    int count;
    const char* tone;
  };
  const std::array<Part, 6> parts = {{{"success", v.success, "good"},
                                      {"failure", v.failure, "bad"},
                                      {"timeout", v.timeout, "warn"},
                                      {"stopped by itself", v.aborted, "halted"},
                                      {"error", v.errors, "broken"},
                                      {"without a plan", v.not_planned, "idle"}}};
  std::string bar, key;
  for (const Part& part : parts) {
    if (part.count > 0)
      bar +=
          fmt::format("<span class=\"{}\" style=\"flex-grow:{}\"></span>", part.tone, part.count);
    key += fmt::format("<li{}><i class=\"{}\"></i>{} {}</li>",
                       part.count > 0 ? "" : " class=\"nil\"", part.tone, part.count, part.name);
  }
  return fmt::format(
      "<div class=\"outcomes\" aria-hidden=\"true\">{}</div><ul class=\"key\">{}</ul>\n", bar, key);
}

// Rates by distance and time, each where so much was driven that it says something: of half an hour
// a rate per 1,000 h would be a guess two thousand times as long as what was seen.
std::string PerTable(const VariantSummary& v) {
  constexpr double kLeast_km = 1, kLeast_1000_h = 0.01;  // ten hours
  if (v.per_km.empty() || v.per_1000_h.empty()) return "";
  struct Column {
    const char* heading;
    const std::vector<FailureRatePer>& rates;
  };
  std::vector<Column> columns;
  std::string left_out;
  if (v.per_km.front().exposure >= kLeast_km)
    columns.push_back({"Per km", v.per_km});
  else
    left_out += " Too little way for rates per km: they need 1 km.";
  if (v.per_1000_h.front().exposure >= kLeast_1000_h)
    columns.push_back({"Per 1,000 h", v.per_1000_h});
  else
    left_out += " Too little time for rates per 1,000 h: they need 10 h.";
  std::string html = fmt::format(
      "<h4>Events by distance and time</h4>\n<p class=\"note\">Driven: {} km in {} h.{}{}</p>\n",
      NumberText(v.per_km.front().exposure), NumberText(1000 * v.per_1000_h.front().exposure),
      columns.empty() ? "" : " " + PercentText(kReportedConfidence) + " intervals (Garwood).",
      left_out);
  if (columns.empty()) return html;
  html +=
      "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th scope=\"col\">Failure</th><th "
      "scope=\"col\" "
      "class=\"num\">Events</th>";
  for (const Column& column : columns)
    html += fmt::format(
        "<th scope=\"col\" class=\"num\">{}</th><th scope=\"col\" class=\"num\">Interval</th>",
        column.heading);
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < std::min(v.per_km.size(), v.per_1000_h.size()); ++i) {
    html += fmt::format("<tr{}><th scope=\"row\">{}</th><td class=\"num\">{}</td>",
                        i == 0 ? " class=\"total\"" : "", MarkupText(Words(v.per_km[i].name)),
                        v.per_km[i].k);
    for (const Column& column : columns) {
      const FailureRatePer& rate = column.rates[i];
      html +=
          fmt::format("<td class=\"num\">{}</td><td class=\"num\">{}</td>", NumberText(rate.rate),
                      IntervalText(NumberText(rate.lower), NumberText(rate.upper)));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

// path_length_m -> "path length [m]"
std::string MetricLabel(const std::string& name) {
  const MetricColumn* column = FindMetric(name);
  if (column == nullptr || column->unit.empty()) return Words(name);
  return fmt::format("{} [{}]", Words(name.substr(0, name.rfind('_'))), column->unit);
}

std::string MetricsTable(const VariantSummary& v) {
  std::string rows;
  for (const auto& [name, spread] : v.metrics)
    if (spread)
      rows += fmt::format(
          "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num\">{}</td><td "
          "class=\"num\">{}</td><td class=\"num\">{}</td></tr>\n",
          MarkupText(MetricLabel(name)), NumberText(spread->mean), NumberText(spread->median),
          NumberText(spread->min), NumberText(spread->max));
  if (rows.empty()) return "";
  return "<details><summary>Metrics of an episode</summary>\n<div class=\"scroll\" "
         "tabindex=\"0\"><table><thead>"
         "<tr><th scope=\"col\">Metric</th><th scope=\"col\" class=\"num\">Mean</th><th "
         "scope=\"col\" class=\"num\">Median</th><th scope=\"col\" class=\"num\">Least</th><th "
         "scope=\"col\" class=\"num\">Greatest</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div></details>\n";
}

std::string Signed(double value, bool percent) {
  const std::string text = NumberText(percent ? 100 * value : value);
  return (value > 0 && std::isfinite(value) ? "+" : "") + text;
}

std::string SignedBetween(double lower, double upper, bool percent) {
  if (std::isfinite(lower) && std::isfinite(upper))
    return IntervalText(Signed(lower, percent), Signed(upper, percent));
  return "too few pairs";
}

std::string PairSentence(const ReportPair& pair) {
  const std::string b = MarkupText(pair.b), a = MarkupText(pair.a);
  if (pair.n() == 0)
    return fmt::format("<b>{}</b> and <b>{}</b> share no episode that counts.", b, a);
  // By the exact test: with few pairs the score interval can leave out 0 where it does not.
  if (pair.repeats > 0)
    return fmt::format(
        "<b>{}</b> against <b>{}</b>: one pair of episodes, repeated: all {} came out the same, to "
        "the last bit.",
        b, a, pair.repeats);
  const bool clear = pair.p <= 1 - kReportedConfidence;
  const std::string verdict = !clear                ? "no clear difference"
                              : pair.difference > 0 ? fmt::format("<b>{}</b> fails more often", b)
                                                    : fmt::format("<b>{}</b> fails less often", b);
  return fmt::format(
      "<b>{}</b> against <b>{}</b> over {}: {} (difference of the failure rates {} "
      "percentage points, {} interval {}; exact McNemar p = {}).",
      b, a, CountText(pair.n(), "shared episode"), verdict, Signed(pair.difference, true),
      PercentText(kReportedConfidence), SignedBetween(pair.lower, pair.upper, true),
      NumberText(pair.p));
}

std::string PairTable(const ReportPair& pair) {
  std::string html = fmt::format(
      "<p>{}</p>\n<ul class=\"key\"><li>{} failed in both</li><li>{} in {} only</li><li>{} in {} "
      "only</li><li>{} in neither</li></ul>\n",
      PairSentence(pair), pair.both, pair.only_a, MarkupText(pair.a), pair.only_b,
      MarkupText(pair.b), pair.neither);
  if (pair.metrics.empty()) return html;
  html += fmt::format(
      "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th scope=\"col\">Difference</th><th "
      "scope=\"col\">"
      "Pairs</th><th scope=\"col\" class=\"num\">Mean</th><th scope=\"col\" class=\"num\">{0} "
      "interval</th><th scope=\"col\" class=\"num\">Median</th><th scope=\"col\" class=\"num\">{0} "
      "interval</th></tr></thead><tbody>\n",
      PercentText(kReportedConfidence));
  for (const ReportDifference& d : pair.metrics)
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{} {}</td><td class=\"num\">{}</td><td "
        "class=\"num\">{}</td><td class=\"num\">{}</td><td class=\"num\">{}</td></tr>\n",
        MarkupText(d.name), d.n, MarkupText(d.pairs), Signed(d.mean, false),
        SignedBetween(d.mean_lower, d.mean_upper, false), Signed(d.median, false),
        SignedBetween(d.median_lower, d.median_upper, false));
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string VariantsTable(const Report& report) {
  const std::string_view metric = JudgedMetric(report.summary);
  std::vector<std::string> names;
  std::vector<FailureRate> rates;
  for (const VariantSummary& variant : report.summary.variants) {
    const auto rate = std::ranges::find(variant.failures, metric, &FailureRate::name);
    if (rate == variant.failures.end()) continue;
    names.push_back(variant.name);
    rates.push_back(*rate);
  }
  return RatesTable(PlotOf(report), "By variant: " + MarkupText(Words(metric)), names, rates);
}

std::string VariantRates(const Report& report, const VariantSummary& v) {
  std::string html = Outcomes(v);
  if (v.repeated) html += "<p class=\"note\">" + MarkupText(RepetitionText(v)) + ".</p>\n";
  html += RatesTable(PlotOf(report), "Failure", RowNames(v.failures, true), v.failures, true);
  html += PerTable(v);
  if (!v.kinds.empty())
    html +=
        "<h4>By kind</h4>\n" + RatesTable(PlotOf(report), "Kind", RowNames(v.kinds, true), v.kinds);
  if (!v.hazards.empty())
    html += "<h4>By hazard met</h4>\n" +
            RatesTable(PlotOf(report), "Hazard", RowNames(v.hazards, false), v.hazards);
  return html + MetricsTable(v);
}

std::string PlaceRates(const Report& report, const VariantSummary& v) {
  constexpr std::size_t kShown = 10;
  std::vector<const FailurePlace*> worst_first;
  for (const FailurePlace& place : v.places) worst_first.push_back(&place);
  std::ranges::stable_sort(worst_first, std::greater(),
                           [](const FailurePlace* place) { return place->rate.k; });
  std::vector<std::string> names;
  std::vector<FailureRate> rates;
  for (std::size_t i = 0; i < std::min(kShown, worst_first.size()); ++i) {
    const FailurePlace& place = *worst_first[i];
    names.push_back(fmt::format("x {:.2f}, y {:.2f} m", place.p_W.x(), place.p_W.y()));
    rates.push_back(place.rate);
  }
  if (rates.empty()) return "";
  std::string html = RatesTable(
      PlotOf(report), fmt::format("Square of {} m around", NumberText(v.place_m)), names, rates);
  if (v.places.size() > kShown)
    html +=
        fmt::format("<p class=\"note\">{} more squares stand in <code>summary.json</code>.</p>\n",
                    v.places.size() - kShown);
  return html;
}

std::string PairedTables(const Report& report) {
  std::string html;
  for (const ReportPair& pair : report.pairs) html += PairTable(pair);
  return html;
}

}  // namespace floorproof

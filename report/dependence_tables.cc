// SPDX-License-Identifier: Apache-2.0
#include "report/dependence_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/html.h"
#include "report/rates_table.h"
#include "run/campaign/dependence_text.h"

namespace floorproof {
namespace {

// Of all rates by value, so that these compare among each other. They reach far above the page's
// other rates, which an axis in common would press together.
RatesPlot PlotOf(const Report& report) {
  double most = 0;
  for (const VariantDependence& variant : report.dependence) {
    most = std::max(most, variant.limit.max_rate);
    for (const ValueDependence& value : variant.values)
      for (const ValueBin& bin : value.bins) most = std::max(most, bin.rate.upper);
  }
  return {AxisEnd(most)};
}

std::string Sentence(const std::string& text) {
  if (text.empty()) return "";
  std::string sentence = text;
  if (sentence[0] >= 'a' && sentence[0] <= 'z') sentence[0] = static_cast<char>(sentence[0] - 32);
  return "<p>" + MarkupText(sentence) + ".</p>\n";
}

std::string ValueTable(const RatesPlot& plot, const VariantDependence& variant,
                       const ValueDependence& value) {
  std::vector<std::string> names;
  std::vector<FailureRate> rates;
  const KeyScale scale = BinScale(value.key, value.bins);
  for (const ValueBin& bin : value.bins) {
    names.push_back(BinText(bin, scale));
    rates.push_back(bin.rate);
  }
  return Sentence(SafeText(value, variant.limit, variant.metric)) +
         RatesTable({plot.reach, variant.limit.max_rate}, value.is_number ? "Values" : "Choice",
                    names, rates);
}

// "step height", and the key that it is.
std::string KeyHtml(const std::string& key) {
  const std::string name = NameOfKey(key).name;
  if (name == key) return MarkupText(key);
  return fmt::format("{} <code>{}</code>", MarkupText(name), MarkupText(key));
}

// Telling values stand open; the others fold away.
std::string Value(const RatesPlot& plot, const VariantDependence& variant,
                  const ValueDependence& value) {
  const std::string key = KeyHtml(value.key), table = ValueTable(plot, variant, value);
  if (!value.differs())
    return fmt::format("<p class=\"note\">{} has one value in all episodes.</p>\n", key);
  const std::string influence = InfluenceText(value, variant.looked_at);
  if (value.telling()) return "<h4>" + key + "</h4>\n" + Sentence(influence) + table;
  return fmt::format("<details><summary>{}: {}</summary>\n{}</details>\n", key,
                     MarkupText(influence), table);
}

std::string Cell(const FailureRate& rate) {
  if (rate.n == 0) return "<td>–</td>";
  return fmt::format(
      "<td style=\"--share:{:.0f}%\">{}<small>{} of {}</small><small>{}</small></td>",
      100 * rate.rate, PercentText(rate.rate, 2), rate.k, rate.n,
      PercentText(Interval{rate.lower, rate.upper}));
}

// x to the right, y upwards.
std::string Pair(const PairDependence& pair) {
  const KeyScale x_scale = BinScale(pair.x_key, pair.x_bins),
                 y_scale = BinScale(pair.y_key, pair.y_bins);
  std::string html = fmt::format(
      "<h4>{0} and {1}</h4>\n<div class=\"scroll\" tabindex=\"0\"><table "
      "class=\"grid\"><thead><tr><th "
      "scope=\"col\">{1} ↑ {0} →</th>",
      MarkupText(NameOfKey(pair.x_key).name), MarkupText(NameOfKey(pair.y_key).name));
  for (const ValueBin& bin : pair.x_bins)
    html += "<th scope=\"col\">" + MarkupText(BinText(bin, x_scale)) + "</th>";
  html += "</tr></thead><tbody>\n";
  const std::size_t width = pair.x_bins.size();
  for (std::size_t y = pair.y_bins.size(); y-- > 0;) {
    html += "<tr><th scope=\"row\">" + MarkupText(BinText(pair.y_bins[y], y_scale)) + "</th>";
    for (std::size_t x = 0; x < width; ++x) html += Cell(pair.cells[y * width + x].rate);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

// Where rates by value say nothing, what is known of the whole ranges.
std::string Ranges(const VariantDependence& variant) {
  std::string list;
  for (const ValueDependence& value : variant.values)
    if (const std::string safe = SafeText(value, variant.limit, variant.metric); !safe.empty())
      list += "<li>" + KeyHtml(value.key) + ": " + MarkupText(safe) + "</li>";
  return list.empty() ? "" : "<ul>" + list + "</ul>\n";
}

std::string OfVariant(const RatesPlot& plot, const VariantDependence& variant) {
  if (variant.values.empty()) return "<p class=\"note\">Nothing was drawn.</p>\n";
  if (!variant.note.empty()) return Sentence(variant.note) + Ranges(variant);
  std::string html;
  if (!variant.values.front().telling())
    for (const std::string& line : DependenceText(variant)) html += Sentence(line);
  for (const ValueDependence& value : variant.values) html += Value(plot, variant, value);
  for (const PairDependence& pair : variant.pairs) html += Pair(pair);
  return html;
}

}  // namespace

std::string DependenceTables(const Report& report) {
  const auto drew = [](const VariantDependence& v) { return !v.values.empty(); };
  if (std::ranges::none_of(report.dependence, drew)) return "";
  const RatesPlot plot = PlotOf(report);
  std::string html;
  for (const VariantDependence& variant : report.dependence)
    html +=
        fmt::format("<article class=\"card\">{}{}</article>\n",
                    report.dependence.size() > 1 ? "<h3>" + MarkupText(variant.variant) + "</h3>\n"
                                                 : "<h3 class=\"off\">All episodes</h3>\n",
                    OfVariant(plot, variant));
  return html +
         fmt::format(
             "<p class=\"note\">Any failure, by what was drawn, the most telling first; groups of "
             "values hold nearly as many episodes each. Bars: two-sided {} Clopper-Pearson "
             "intervals, each by itself, on one axis in this part; dashed: {}. p: tests for "
             "a trend and for failures at both ends or in the middle; of choices, Fisher's. What "
             "is "
             "called safe is the mean over the values driven there, all else as drawn, not the "
             "rate "
             "at its edge; each answer by itself. The numbers stand in "
             "<code>dependence.csv</code>.</p>\n",
             PercentText(kReportedConfidence),
             report.summary.gate ? std::string("the gate's limit")
                                 : PercentText(report.dependence.front().limit.max_rate) +
                                       ", the limit where a scenario states no gate");
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/compare_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/quantity.h"
#include "report/comparison_tables.h"
#include "report/html.h"
#include "report/html_page.h"
#include "report/pairs.h"
#include "report/rates.h"
#include "report/verdict.h"
#include "run/campaign/summary_json.h"

namespace floorproof {
namespace {

VariantSummary SummaryOf(const ComparedSide& side) {
  const std::filesystem::path file = side.folder / "summary.json";
  const CampaignSummary summary = ReadSummary(file);
  const auto found = std::ranges::find(summary.variants, side.variant, &VariantSummary::name);
  if (found == summary.variants.end())
    throw InputError({file.string(), 0}, "variants." + side.variant, "", "is not in it");
  VariantSummary variant = *found;
  variant.name = side.name;
  return variant;
}

}  // namespace

std::string ComparePage(const ComparedSide& a, const ComparedSide& b,
                        const Comparison& comparison) {
  Report report;
  report.summary.variants = {SummaryOf(a), SummaryOf(b)};
  report.pairs = {ShownPair(comparison)};
  report.pairs[0].a = a.name;
  report.pairs[0].b = b.name;
  HtmlPage page;
  page.over = "Floorproof compare";
  page.title = b.name + " against " + a.name;
  page.about = "paired";
  page.verdict = "<div class=\"verdict\"><p>" + MarkupText(VerdictText(report)) + "</p></div>\n";
  page.sections.push_back(
      {"pairs", "Paired comparison",
       fmt::format("<div class=\"card\">{}<p class=\"note\">{} in both, with the same draws. "
                   "Differences are {} less {}. Rates: Tango's score interval; means: Student's t; "
                   "medians: sign test.</p></div>\n",
                   PairedTables(report), CountText(comparison.n, "episode"), MarkupText(b.name),
                   MarkupText(a.name))});
  for (const ComparisonPart& part : ComparisonParts(comparison)) {
    std::string html = "<div class=\"card\">" + TableHtml(part.table);
    for (const std::string& note : part.notes)
      html += "<p class=\"note\">" + MarkupText(note) + "</p>\n";
    html += fmt::format("<p class=\"note\">a is {}, b is {}.</p></div>\n", MarkupText(a.name),
                        MarkupText(b.name));
    page.sections.push_back({part.id, part.title, html});
  }
  std::string rates = "<div class=\"card\">" + VariantsTable(report) + "</div>\n";
  for (const VariantSummary& variant : report.summary.variants)
    rates += "<article class=\"card\"><h3>" + MarkupText(variant.name) + "</h3>\n" +
             VariantRates(report, variant) + "</article>\n";
  page.sections.push_back({"rates", "Failure rates", rates});
  page.footer =
      "<p class=\"note\">Rates are of all episodes of each, pairs of those that both "
      "have. The campaigns' own pages show where and how they failed.</p>";
  return page.Html();
}

}  // namespace floorproof

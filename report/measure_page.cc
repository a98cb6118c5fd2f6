// SPDX-License-Identifier: Apache-2.0
#include "report/measure_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "base/input_file.h"
#include "base/shell_word.h"
#include "base/words.h"
#include "measure/kind_findings.h"
#include "measure/risk_files.h"
#include "measure/shared_frailty.h"
#include "report/experts_table.h"
#include "report/html.h"
#include "report/html_page.h"
#include "report/rate_chart.h"
#include "report/rates_table.h"
#include "report/recorded_campaign.h"
#include "report/settings_section.h"
#include "run/campaign/dependence_text.h"
#include "run/scenario/risk_model_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMeasureStyle = R"css(
.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(16rem, 1fr)); gap: 0 1.5rem; }
.charts figure { break-inside: avoid; }
.chart text { font-size: 11px; fill: var(--soft); } .chart .grid { stroke: var(--line); }
.chart .bar { stroke: var(--mark); stroke-width: 1.6; } .chart .point { fill: var(--mark); }
.chart .none { fill: var(--card); stroke: var(--mark); stroke-width: 1.6; }
.chart .rates-line { fill: none; stroke: var(--driven); stroke-width: 1.8; stroke-dasharray: 5 3; }
.key .line { width: 1.3rem; height: 0; border-radius: 0; border-top: 2px dashed var(--driven);
  vertical-align: middle; }
.grid small.apart { font-weight: 700; }
)css";

// Enough of a kind to ask what its failures depend on.
constexpr int kFewestFailures = 10;
constexpr std::size_t kCharts = 4;  // of a kind

struct Measurement {
  CampaignSummary summary;
  MeasuredEncounters met;
  std::vector<Encounter> first;
  std::shared_ptr<const RiskModel> model;
  std::vector<KindFinding> kinds;
  SafeRangeSettings limit;
  SafeSizes sizes;
};

Measurement Read(const fs::path& folder) {
  const fs::path rates = folder / "risk_model.json";
  RecordedCampaign campaign = ReadRecordedCampaign(folder);
  Measurement m;
  m.summary = std::move(campaign.summary);
  m.met = AllEncounters(campaign.store);
  m.model = ReadRiskModel(rates);
  if (m.model->encounters != static_cast<int>(m.met.encounters.size()))
    throw InputError({rates.string(), 0}, "encounters", std::to_string(m.model->encounters),
                     fmt::format("is not of the {} that campaign.sqlite holds: `measure --resume` "
                                 "fits them anew",
                                 CountText(m.met.encounters.size(), "encounter")));
  m.first = FirstMeetings(m.met.encounters);
  m.kinds = FindKinds(*m.model, m.first);
  m.sizes = FindSafeSizes(m.first, m.limit);
  return m;
}

// "ramp, turning"; `where`: also whether it is passed, "ramp, over it, turning".
std::string KindText(const KindRates& kind, bool where = true) {
  std::string text = Words(kind.type);
  if (where) text += kind.passage == Passage::kOver ? ", over it" : ", past it";
  if (kind.manner == Manner::kStraight) text += ", straight";
  if (kind.manner == Manner::kTurning) text += ", turning";
  return text;
}

FailureRate RateOf(const KindFinding& found) { return CountedRate("", found.failures(), found.n); }

// Of the kinds that are passed so, the one that fails most often.
const KindFinding* Worst(const Measurement& m, Passage passage) {
  const KindFinding* worst = nullptr;
  for (const KindFinding& found : m.kinds)
    if (found.kind->passage == passage && found.n > 0 &&
        (worst == nullptr || RateOf(found).rate > RateOf(*worst).rate))
      worst = &found;
  return worst;
}

std::string Verdict(const Measurement& m) {
  int met = 0;
  std::set<std::string> types;
  for (const KindFinding& found : m.kinds) {
    met += found.n;
    if (found.n > 0) types.insert(found.kind->type);
  }
  std::string text =
      fmt::format("{} in {} with {} of hazard, of the sizes drawn", m.model->robot.name,
                  CountText(met, "meeting"), CountText(types.size(), "type"));
  const auto add = [&](Passage passage, const char* how) {
    const KindFinding* worst = Worst(m, passage);
    if (worst == nullptr) return;
    const FailureRate rate = RateOf(*worst);
    text += rate.k == 0 ? fmt::format("; {} nothing failed", how)
                        : fmt::format("; {}, most often at: {}, {} ({})", how,
                                      KindText(*worst->kind, false), PercentText(rate.rate),
                                      PercentText(Interval{rate.lower, rate.upper}));
  };
  add(Passage::kOver, "over them");
  add(Passage::kBeside, "past them");
  text += '.';
  if (const CarryOver& plans = m.model->carry_over; plans.plans > 0)
    text +=
        fmt::format(" Of {} over whole plans its rates had {} fail; {} did.",
                    CountText(plans.drives, "drive"), FixedText(plans.expected, 0), plans.failed);
  return text;
}

std::string KindsTable(const Measurement& m, Passage passage, const char* heading) {
  std::vector<std::string> names;
  std::vector<FailureRate> rates;
  std::vector<const KindFinding*> kinds;
  for (const KindFinding& found : m.kinds)
    if (found.kind->passage == passage && found.n > 0) kinds.push_back(&found);
  if (kinds.empty()) return "";
  std::ranges::stable_sort(kinds, std::greater(),
                           [](const KindFinding* found) { return RateOf(*found).rate; });
  double most = 0;
  std::string ends =
      "<details><summary>How they fail</summary><table class=\"grid\"><thead><tr><th "
      "scope=\"col\">Meeting</th>";
  for (int mode = 0; mode < kNumFailureModes; ++mode)
    ends += "<th scope=\"col\">" + Words(Name(static_cast<FailureMode>(mode))) + "</th>";
  ends +=
      "<th scope=\"col\">by the rates</th><th scope=\"col\">without an outcome</th></tr></thead>"
      "<tbody>\n";
  for (const KindFinding* found : kinds) {
    names.push_back(KindText(*found->kind, false));
    rates.push_back(RateOf(*found));
    most = std::max(most, rates.back().upper);
    ends += "<tr><th scope=\"row\">" + MarkupText(names.back()) + "</th>";
    for (const int failed : found->failed)
      ends += fmt::format("<td style=\"--share:{:.0f}%\">{}</td>", 100.0 * failed / found->n,
                          failed > 0 ? fmt::format("{}", failed) : "–");
    ends += fmt::format("<td>{} of {}</td><td>{}</td></tr>\n", FixedText(found->expected, 1),
                        found->failures(), found->censored);
  }
  RatesPlot plot{AxisEnd(most)};
  plot.counted = "Meetings";
  return fmt::format("<div class=\"card\"><h3>{}</h3>\n{}{}</tbody></table></details></div>\n",
                     heading, RatesTable(plot, "Meeting", names, rates), ends);
}

// What is not met but driven along, and drives that say nothing.
std::string Besides(const Measurement& m) {
  int drives = 0, errors = 0;
  for (const VariantSummary& variant : m.summary.variants) {
    drives += variant.n;
    errors += variant.errors;
  }
  std::string text = CountText(drives, "drive");
  if (errors > 0) text += fmt::format(", {} more ended in an error", errors);
  for (const auto& [type, where] :
       {std::pair(kFreeFloor, "on free floor"), std::pair(kWallBeside, "beside walls")}) {
    const auto failed = std::ranges::count_if(m.first, [type = type](const Encounter& e) {
      return e.type == type && e.outcome == Encounter::Outcome::kFailed;
    });
    text += fmt::format("; {} failed {}", failed, where);
  }
  return text;
}

std::string Kinds(const Measurement& m) {
  std::string html = KindsTable(m, Passage::kOver, "Over them") +
                     KindsTable(m, Passage::kBeside, "Past them, within 0.1 m");
  html += "<p class=\"note\">" + MarkupText(Besides(m)) + ".";
  std::string unmeasured;
  for (const UnmeasuredKind& kind : m.model->unmeasured)
    unmeasured += fmt::format("{}{} {}: {}", unmeasured.empty() ? "" : "; ", Words(kind.type),
                              Name(kind.passage), kind.why);
  if (!unmeasured.empty()) html += " Without rates: " + MarkupText(unmeasured) + ".";
  return html +
         "</p>\n<p class=\"note\">Shares of what was drawn, of no building: another range of sizes "
         "gives other shares. Counted are first meetings with an outcome; bars: two-sided 95 % "
         "Clopper-Pearson intervals. What the rates expect counts meetings without one, cut short "
         "by a failure elsewhere, by half. Robots that are to pass a hazard are often wrong about "
         "their place, by design, and some so come over it. <code>floorproof predict</code> says "
         "what the rates come to on a floor of yours.</p>\n";
}

std::string Sizes(const Measurement& m) {
  if (m.sizes.shown.empty())
    return "<p class=\"note\">No size of what plans led over varied.</p>\n";
  const std::string below =
      "below " + PercentText(m.limit.max_rate) + " at " + PercentText(m.limit.confidence);
  std::string html =
      "<div class=\"card scroll\" tabindex=\"0\"><table><thead><tr><th "
      "scope=\"col\">Hazard</th><th "
      "scope=\"col\">Size</th><th scope=\"col\">Driven</th><th scope=\"col\">Each part by itself " +
      below + "</th><th scope=\"col\">The mean " + below +
      "</th><th scope=\"col\">Failed nearest to that end</th></tr></thead><tbody>\n";
  for (const SizeFinding& size : m.sizes.shown) {
    ValueBin range = size.of.bins.front();
    range.high = size.of.bins.back().high;
    std::string name = NameOfKey(size.key).name;
    if (size.way != SizeFinding::Way::kOnly)
      name += size.way == SizeFinding::Way::kUp ? ", up" : ", down";
    const SafeClauses safe = SafeClausesOf(size.of);
    const std::string edge = size.at_edge.n == 0
                                 ? "–"
                                 : fmt::format("{} of {} ({})", size.at_edge.k, size.at_edge.n,
                                               PercentText(size.at_edge.rate, 2));
    html += fmt::format(
        "<tr><th "
        "scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        MarkupText(Words(size.type)), MarkupText(name),
        MarkupText(BinText(range, BinScale(size.of.key, size.of.bins))),
        MarkupText(safe.each_part.empty() ? "none" : safe.each_part), MarkupText(safe.on_average),
        edge);
  }
  return html +
         fmt::format(
             "</tbody></table></div>\n<p class=\"note\">Of plans that led over it, driven by "
             "robots "
             "that knew their place to a centimetre; all else as drawn: floors from slippery to "
             "grippy, straight and turning, square on and askew. Parts hold as many meetings each. "
             "The mean over all sizes up to an end is no promise for a hazard of that size: mild "
             "ones were drawn more often (half of them in the mildest three tenths), and what the "
             "50 or more nearest to the end came to stands beside. Shown, of {} sizes and "
             "directions, are those that failures go with; each answer holds by itself at 95 "
             "%.</p>\n",
             m.sizes.looked_at);
}

std::string GroupsTable(const KindFinding& found, const std::vector<AxisFinding>& axes) {
  std::string html =
      "<details><summary>The numbers</summary><table class=\"list\"><thead><tr><th "
      "scope=\"col\">By</th><th scope=\"col\">Values</th><th scope=\"col\">Failed</th><th "
      "scope=\"col\">Rate</th><th scope=\"col\">95 % interval</th><th scope=\"col\">By the "
      "rates</th></tr></thead><tbody>\n";
  for (const AxisFinding& axis : axes) {
    const KeyScale scale = AxisScale(axis);
    for (const AxisGroup& group : axis.groups)
      html += fmt::format(
          "<tr><th scope=\"row\">{}</th><td>{}</td><td>{} of {}</td><td>{}</td><td>{}</td><td>{}"
          "</td></tr>\n",
          MarkupText(AxisTitle(found.kind->type, axis)),
          MarkupText(BinText({group.low, group.high, group.counted}, scale)), group.counted.k,
          group.counted.n, PercentText(group.counted.rate),
          PercentText(Interval{group.counted.lower, group.counted.upper}),
          PercentText(group.expected));
  }
  return html + "</tbody></table></details>\n";
}

std::string Dependence(const Measurement& m) {
  std::string html =
      "<ul class=\"key\"><li><i style=\"background:var(--mark)\"></i>counted, with its 95 % "
      "interval</li><li><i class=\"line\"></i>as the rates have the same meetings</li></ul>\n";
  std::string seldom;
  for (const KindFinding& found : m.kinds) {
    const std::string name = KindText(*found.kind);
    if (found.failures() < kFewestFailures) {
      seldom += fmt::format("{}{} ({} of {})", seldom.empty() ? "" : "; ", name, found.failures(),
                            found.n);
      continue;
    }
    const std::vector<AxisFinding> axes(
        found.axes.begin(),
        found.axes.begin() + static_cast<std::ptrdiff_t>(std::min(kCharts, found.axes.size())));
    double most = 0;
    for (const AxisFinding& axis : axes)
      for (const AxisGroup& group : axis.groups) most = std::max(most, group.counted.upper);
    html += "<article class=\"card\"><h3>" + MarkupText(name) + "</h3>\n<div class=\"charts\">";
    for (const AxisFinding& axis : axes)
      html += RateChart(found.kind->type, axis, AxisEnd(most), name);
    html += "</div>\n" + GroupsTable(found, axes) + "</article>\n";
  }
  if (!seldom.empty())
    html += "<p class=\"note\">Too few failures to ask: " + MarkupText(seldom) + ".</p>\n";
  return html +
         "<p class=\"note\">What the rates tell apart most stands first: what failures go with, "
         "not always what causes them, since wide grooves, say, are also long ways. Groups hold "
         "nearly as many meetings each. The rates were fitted to these meetings; what plans came "
         "to "
         "says more of them.</p>\n";
}

std::string Plans(const CarryOver& plans) {
  constexpr int kFewPlans = 40;
  if (plans.plans == 0)
    return "<p class=\"note\">The rates are held against no whole plan: none was driven, or none "
           "that they say anything of.</p>\n";
  std::string html = fmt::format(
      "<div class=\"card scroll\" tabindex=\"0\"><p>{} over small floors, {}: the rates had {} "
      "fail, {} did{}. By what these floors came to <code>floorproof predict</code> corrects a "
      "plan:</p>\n<table><tbody><tr><th scope=\"row\">The rates alone come to</th>",
      CountText(plans.plans, "plan"), CountText(plans.drives, "drive"),
      FixedText(plans.expected, 1), plans.failed,
      plans.plans < kFewPlans ? " (few: that says little)" : "");
  constexpr double kShares[] = {0.01, 0.03, 0.1, 0.3, 0.6, 0.9};
  for (const double p : kShares) html += "<td class=\"num\">" + PercentText(p) + "</td>";
  html += "</tr>\n<tr><th scope=\"row\">Plans fail in</th>";
  for (const double p : kShares)
    html += "<td class=\"num\">" + PercentText(plans.Of(p), 2) + "</td>";
  return html + "</tr></tbody></table></div>\n";
}

// Of each kind and mode the failure that the rates held for the least likely.
std::string Unlikeliest(const Measurement& m, const std::string& named) {
  std::string rows;
  for (const KindFinding& found : m.kinds)
    for (std::size_t mode = 0; mode < found.unlikeliest.size(); ++mode) {
      const UnlikelyFailure& least = found.unlikeliest[mode];
      if (least.met == nullptr) continue;
      const MeasuredDrive& drive = m.met.drives.at(least.met->drive);
      rows += fmt::format(
          "<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"num\">{} of {}</td><td "
          "class=\"num\">{}</td><td><code>{}</code></td></tr>\n",
          MarkupText(KindText(*found.kind)), Words(Name(static_cast<FailureMode>(mode))),
          found.failed[mode], found.n, PercentText(least.p, 2),
          MarkupText(fmt::format("floorproof replay {} --episode {} --variant {} --video",
                                 ShellWord(named), drive.episode, ShellWord(drive.variant))));
    }
  if (rows.empty()) return "<p>Nothing failed.</p>\n";
  return "<p class=\"note\">Of each meeting and mode the failure that the rates held for the least "
         "likely to go so. Each command drives it again, exactly, and films it.</p>\n<div "
         "class=\"card\"><table class=\"list\"><thead><tr><th scope=\"col\">Meeting</th><th "
         "scope=\"col\">Failure</th><th scope=\"col\" class=\"num\">Such failures</th><th "
         "scope=\"col\" class=\"num\">Held likely</th><th scope=\"col\">Film it</th></tr></thead>"
         "<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

}  // namespace

bool HoldsMeasurement(const fs::path& folder) {
  std::error_code none;
  return fs::exists(folder / "campaign.sqlite", none) &&
         fs::exists(folder / "risk_model.json", none) &&
         fs::exists(folder / "fmea_measured.yaml", none);
}

WrittenReport WriteMeasureReport(const fs::path& folder, const std::string& named) {
  const Measurement m = Read(folder);
  const std::string verdict = Verdict(m);
  HtmlPage page;
  page.over = "Floorproof measure";
  page.title = "What " + m.model->robot.name + " fails at";
  page.about = "measured risk";
  page.extra_style = kMeasureStyle;
  page.verdict = "<div class=\"verdict\"><p>" + MarkupText(verdict) + "</p></div>\n";
  page.sections = {{"kinds", "How often it fails", Kinds(m)},
                   {"sizes", "How large a hazard may be", Sizes(m)},
                   {"dependence", "What it depends on", Dependence(m)},
                   {"plans", "What that comes to in plans", Plans(m.model->carry_over)},
                   {"experts", "Beside the experts' tables",
                    ExpertsTables(folder / "fmea_measured.yaml", m.model->robot.name)},
                   {"unlikeliest", "Failures to look at", Unlikeliest(m, named)},
                   SettingsSection(m.summary, ReadPlainFile(folder / "scenario.resolved.yaml",
                                                            kMaxResultBytes))};
  page.footer =
      "<p class=\"note\">This page is complete in itself: everything it shows stands in this one "
      "file.</p>";
  return WritePage(folder / "report.html",
                   {"page", [](std::string_view name) { return name == "report.html"; }}, verdict,
                   page.Html());
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string_view>

#include "base/quantity.h"
#include "base/words.h"
#include "report/campaign_words.h"
#include "report/html.h"
#include "report/rates.h"
#include "run/scenario/scenario.h"
#include "stats/outward.h"

namespace floorproof {
namespace {

// Whether a variant sets one of these keys.
bool Differ(const std::vector<Variant>& variants, std::initializer_list<std::string_view> keys) {
  for (const Variant& variant : variants)
    for (const auto& [key, value] : variant.overrides)
      if (std::ranges::find(keys, key) != keys.end()) return true;
  return false;
}

std::string PlanOf(const ScenarioSpec& spec) {
  if (!spec.planner_name.empty()) return spec.planner_name + " plan";
  if (!spec.mission_file.empty()) return "mission " + spec.mission_file.filename().string();
  if (spec.plan_command) return "plan by a program";
  return "plan " + spec.plan_file.filename().string();
}

// The rate that is judged. None: no episode counts.
const FailureRate* JudgedRate(const VariantSummary& v, std::string_view metric) {
  auto found = std::ranges::find(v.failures, metric, &FailureRate::name);
  if (found == v.failures.end()) found = v.failures.begin();
  return found == v.failures.end() || found->n == 0 ? nullptr : &*found;
}

// What is no failure and no success either.
std::string OtherEnds(const VariantSummary& v) {
  std::string text;
  if (v.timeout > 0) text += fmt::format(", {} ran out of time", FixedText(v.timeout, 0));
  if (v.aborted > 0) text += fmt::format(", {} stopped by themselves", FixedText(v.aborted, 0));
  if (v.not_planned > 0) text += fmt::format(", {} had no plan", FixedText(v.not_planned, 0));
  return text;
}

// "3 failures in 1,000 drives (0.3 %), 0.06 % to 0.87 % at 95 %"
std::string RateText(const VariantSummary& v, std::string_view metric) {
  const FailureRate* rate = JudgedRate(v, metric);
  if (rate == nullptr) return "no drive that counts";
  const bool any = rate->name == "any_failure";
  if (v.repeated)
    return fmt::format("{}{} in its one drive, repeated {} times", rate->k == 0 ? "no " : "",
                       any ? "failure" : Words(rate->name), v.n);
  std::string text =
      any ? fmt::format("{} in {}",
                        rate->k == 0 ? "no failure"
                                     : CountText(static_cast<std::size_t>(rate->k), "failure"),
                        CountText(static_cast<std::size_t>(rate->n), "drive"))
          : fmt::format("{} in {} of {}", Words(rate->name), FixedText(rate->k, 0),
                        CountText(static_cast<std::size_t>(rate->n), "drive"));
  if (rate->k > 0) text += " (" + PercentText(rate->rate) + ")";
  text += fmt::format(", {} at {}", PercentText(Interval{rate->lower, rate->upper}),
                      PercentText(kReportedConfidence));
  return rate->name == "not_success" ? text : text + OtherEnds(v);
}

// The least and the most often failing of several variants.
std::string Extremes(const Report& report, std::string_view metric) {
  const auto& variants = report.summary.variants;
  const auto rate = [&](const VariantSummary& v) {
    const FailureRate* judged = JudgedRate(v, metric);
    return judged == nullptr ? 2.0 : judged->rate;
  };
  const auto text = [&](const VariantSummary& v) { return RateText(v, metric); };
  const auto least = std::ranges::min_element(
      variants, [&](const auto& a, const auto& b) { return rate(a) < rate(b); });
  if (rate(*least) > 1) return "no robot drove: the episodes are plans only, or none counts";
  auto most = least;
  for (auto v = variants.begin(); v != variants.end(); ++v)
    if (rate(*v) <= 1 && rate(*v) > rate(*most)) most = v;
  if (rate(*most) == rate(*least))
    return fmt::format(
        "{} failed equally often, {}: {}",
        variants.size() == 2 ? "both variants" : fmt::format("all {} variants", variants.size()),
        least->name, text(*least));
  if (variants.size() == 2)
    return fmt::format("{}: {}; {}: {}", least->name, text(*least), most->name, text(*most));
  return fmt::format("least often {}: {}; most often {}: {}", least->name, text(*least), most->name,
                     text(*most));
}

// "gate < 1 %: passed, at most 0.87 %". A gate asks for a bound on one side only: it may pass where
// the interval, which has two, reaches beyond the limit.
std::string GateWords(const GateSummary& gate, std::size_t variants) {
  const bool any = gate.metric == "any_failure";
  std::string text = fmt::format(
      "gate{} < {}{}: {}", any ? "" : " on " + Words(gate.metric), PercentText(gate.max_rate, 4),
      variants > 1 ? " in each variant" : "", GateVerdictName(gate.verdict));
  if (variants == 1 && gate.verdict == GateVerdict::kPassed && gate.variants.size() == 1)
    text += fmt::format(", at most {} with {} confidence",
                        PercentText(RoundedOutward(gate.variants[0].report.rate).upper),
                        PercentText(gate.confidence, 4));
  return text;
}

// Without a gate: good is that every drive succeeded, bad that one failed.
std::string PlainTone(const Report& report) {
  int driven = 0, failed = 0, other = 0;
  for (const VariantSummary& v : report.summary.variants)
    if (!v.failures.empty()) {
      driven += v.failures.front().n;
      failed += v.failures.front().k;
      other += v.timeout + v.aborted + v.not_planned;
    }
  return driven == 0 ? "" : failed > 0 ? "failed" : other > 0 ? "undecided" : "passed";
}

}  // namespace

std::string SubjectOf(const Scenario& scenario, const std::vector<Variant>& variants) {
  std::string subject;
  const auto add = [&](const std::string& part) {
    if (!part.empty()) subject += (subject.empty() ? "" : ", ") + part;
  };
  if (!Differ(variants, {"robot", "robot.model"})) add(scenario.world.robot.spec.name);
  if (!Differ(variants, {"plan", "plan.planner", "plan.file", "plan.command", "mission"}))
    add(PlanOf(scenario.spec));
  if (!Differ(variants, {"site"})) add(scenario.world.site.map.name);
  return subject;
}

std::string_view JudgedMetric(const CampaignSummary& summary) {
  if (summary.gate) return summary.gate->metric;
  const auto differ = [&](std::string_view metric) {
    std::set<double> rates;
    for (const VariantSummary& v : summary.variants)
      if (const FailureRate* rate = JudgedRate(v, metric)) rates.insert(rate->rate);
    return rates.size() > 1;
  };
  return !differ("any_failure") && differ("not_success") ? "not_success" : "any_failure";
}

std::string VerdictText(const Report& report) {
  const auto& variants = report.summary.variants;
  const auto& gate = report.summary.gate;
  if (variants.empty()) return "No variant was driven.";
  if (const std::string errors = ErrorsText(report.summary); !errors.empty())
    return (report.subject.empty() ? "" : report.subject + ": ") + errors +
           ". No failure rate is given.";
  const std::string_view metric = JudgedMetric(report.summary);
  const std::string rates =
      variants.size() == 1 ? RateText(variants.front(), metric) : Extremes(report, metric);
  std::string text = report.subject.empty() ? "" : report.subject + ": ";
  // Of several variants the gate's word on all of them comes first.
  if (gate && variants.size() > 1)
    text += GateWords(*gate, variants.size()) + "; " + rates;
  else
    text += gate ? rates + "; " + GateWords(*gate, 1) : rates;
  return text + ".";
}

std::string VerdictBox(const Report& report) {
  const auto& gate = report.summary.gate;
  std::string list;
  if (gate)
    for (const auto& [variant, found, aborted] : gate->variants)
      list += "<li>" +
              MarkupText(gate->variants.size() > 1 ? variant + ": " + found.text : found.text) +
              "</li>";
  if (!report.summary.unfinished.empty())
    list += "<li>The campaign is not whole: " + MarkupText(report.summary.unfinished) + ".</li>";
  int errors = 0, not_planned = 0, driven = 0;
  for (const VariantSummary& v : report.summary.variants) {
    errors += v.errors;
    driven += v.n;
    not_planned += v.not_planned;
  }
  if (not_planned > 0)
    list += fmt::format("<li>For {} there was no plan; no robot drove.</li>",
                        CountText(static_cast<std::size_t>(not_planned), "episode"));
  if (errors > 0)
    list += fmt::format("<li>The table below is of the {} that came to an end.</li>",
                        CountText(static_cast<std::size_t>(driven), "episode"));
  return fmt::format("<div class=\"verdict {}\"><p>{}</p>{}</div>\n",
                     errors > 0 ? "undecided"
                     : gate     ? GateVerdictName(gate->verdict)
                                : PlainTone(report),
                     MarkupText(VerdictText(report)), list.empty() ? "" : "<ul>" + list + "</ul>");
}

}  // namespace floorproof

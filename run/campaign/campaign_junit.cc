// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_junit.h"

#include <fmt/format.h>

#include "base/markup.h"
#include "base/quantity.h"

namespace floorproof {
namespace {

// What a variant did, in a few lines for people.
std::string VariantText(const VariantSummary& v) {
  std::string text =
      fmt::format("{}: {} success, {} failure, {} timeout{}; {}, {} without a plan\n",
                  CountText(v.n, "episode"), v.success, v.failure, v.timeout, AbortedText(v),
                  CountText(v.errors, "error"), v.not_planned);
  if (v.repeated) text += RepetitionText(v) + "\n";
  for (const FailureRate& rate : v.failures)
    text += rate.n == 0 ? fmt::format("{}: nothing was driven\n", rate.name)
                        : fmt::format("{}: {} of {}, {} (95 %: {} to {})\n", rate.name, rate.k,
                                      rate.n, PercentText(rate.rate), NumberText(100 * rate.lower),
                                      PercentText(rate.upper));
  return text;
}

double SimulatedTime(const VariantSummary& v) {
  for (const auto& [name, spread] : v.metrics)
    if (name == kMetrics[MetricIndex(&Metrics::duration_s)].name && spread)
      return spread->mean * v.n;
  return 0;
}

struct Suite {
  std::string xml;
  int tests = 0, failures = 0, errors = 0, skipped = 0;
};

std::string Case(const std::string& name, const std::string& criterion, double time_s,
                 const std::string& verdict, const std::string& text) {
  return fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">\n{}      "
      "<system-out>{}</system-out>\n    </testcase>\n",
      MarkupText(name), MarkupText(criterion), time_s, verdict, MarkupText(text));
}

// Its case of the gate.
std::string GateCase(const std::string& name, const GateSummary& gate, const VariantGate& variant,
                     double time_s, const std::string& rates, Suite& suite) {
  const std::string said = GateText(gate, variant), text = MarkupText(said);
  const bool failed = variant.report.verdict == GateVerdict::kFailed,
             undecided = variant.report.verdict == GateVerdict::kUndecided;
  ++suite.tests;
  suite.failures += failed;
  suite.skipped += undecided;
  std::string verdict;
  if (failed) verdict = fmt::format("      <failure message=\"{0}\">{0}</failure>\n", text);
  if (undecided) verdict = fmt::format("      <skipped message=\"{}\"/>\n", text);
  return Case(name, Criterion(gate), time_s, verdict, said + "\n" + rates);
}

Suite VariantSuite(const std::string& name, std::size_t v, const CampaignSummary& summary,
                   bool failed_fast) {
  const VariantSummary& variant = summary.variants[v];
  Suite suite;
  suite.tests = 1;
  suite.errors = variant.errors > 0;
  std::string ran;
  if (variant.errors > 0) {
    ran = fmt::format("      <error message=\"{0} ended in error\">{1}</error>\n",
                      CountText(variant.errors, "episode"), MarkupText(variant.first_error));
  } else if (!summary.unfinished.empty()) {
    ran = fmt::format("      <{} message=\"{}\"/>\n", failed_fast ? "failure" : "skipped",
                      MarkupText(summary.unfinished));
    ++(failed_fast ? suite.failures : suite.skipped);
  }
  const double time_s = SimulatedTime(variant);
  const std::string rates = VariantText(variant);
  std::string cases = Case(name, "every episode ran", time_s, ran, rates);
  if (summary.gate && v < summary.gate->variants.size())
    cases += GateCase(name, *summary.gate, summary.gate->variants[v], time_s, rates, suite);
  suite.xml = fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
      "skipped=\"{}\" time=\"{:.3f}\">\n{}  </testsuite>\n",
      MarkupText(name), suite.tests, suite.failures, suite.errors, suite.skipped, time_s, cases);
  return suite;
}

}  // namespace

std::string JunitXml(const CampaignSummary& summary, bool failed_fast,
                     const std::string& scenario_name) {
  Suite all;
  for (std::size_t v = 0; v < summary.variants.size(); ++v) {
    const Suite suite =
        VariantSuite(scenario_name + "." + summary.variants[v].name, v, summary, failed_fast);
    all.xml += suite.xml;
    all.tests += suite.tests;
    all.failures += suite.failures;
    all.errors += suite.errors;
    all.skipped += suite.skipped;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\" skipped=\"{}\">\n{}</testsuites>\n",
      all.tests, all.failures, all.errors, all.skipped, all.xml);
}

}  // namespace floorproof

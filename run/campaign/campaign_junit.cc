// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_junit.h"

#include <fmt/format.h>

#include "base/markup.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

// What a variant did, in a few lines for people.
std::string VariantText(const Json& summary) {
  std::string text = fmt::format(
      "{} episodes: {} success, {} failure, {} timeout; {} errors, {} without a plan\n",
      summary["n"].get<int>(), summary["outcomes"]["success"].get<int>(),
      summary["outcomes"]["failure"].get<int>(), summary["outcomes"]["timeout"].get<int>(),
      summary["n_error"].get<int>(), summary["n_not_planned"].get<int>());
  for (const auto& [mode, rate] : summary["failures"].items())
    text += rate["rate"].is_null()
                ? fmt::format("{}: nothing was driven\n", mode)
                : fmt::format("{}: {} of {}, {:.3g} % (95 %: {:.3g} to {:.3g} %)\n", mode,
                              rate["k"].get<int>(), rate["n"].get<int>(),
                              100 * rate["rate"].get<double>(), 100 * rate["lower"].get<double>(),
                              100 * rate["upper"].get<double>());
  return text;
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

// `gate` may be nullptr.
Suite VariantSuite(const std::string& name, const Json& variant, const Json& unfinished,
                   bool failed_fast, const GateState* gate) {
  Suite suite;
  const Json& duration = variant["metrics"]["duration_s"];
  const double time_s =
      duration.is_null() ? 0.0 : duration["mean"].get<double>() * variant["n"].get<int>();
  const int broken = variant["n_error"].get<int>();
  suite.errors = broken > 0;
  suite.tests = gate == nullptr ? 1 : 2;
  std::string ran;
  if (broken > 0) {
    const std::string why = MarkupText(variant["first_error"].get<std::string>());
    ran = fmt::format("      <error message=\"{0} episodes ended in error\">{1}</error>\n", broken,
                      why);
  } else if (!unfinished.is_null()) {
    ran = fmt::format("      <{} message=\"{}\"/>\n", failed_fast ? "failure" : "skipped",
                      MarkupText(unfinished.get<std::string>()));
    ++(failed_fast ? suite.failures : suite.skipped);
  }
  const std::string rates = VariantText(variant);
  std::string cases = Case(name, "every episode ran", time_s, ran, rates);
  if (gate != nullptr) {
    const std::string text = MarkupText(gate->Text());
    std::string verdict;
    if (gate->verdict() == GateVerdict::kFailed)
      verdict = fmt::format("      <failure message=\"{0}\">{0}</failure>\n", text);
    if (gate->verdict() == GateVerdict::kUndecided)
      verdict = fmt::format("      <skipped message=\"{}\"/>\n", text);
    suite.skipped += gate->verdict() == GateVerdict::kUndecided;
    cases += Case(name, gate->Criterion(), time_s, verdict, gate->Text() + "\n" + rates);
    suite.failures += gate->verdict() == GateVerdict::kFailed;
  }
  suite.xml = fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
      "skipped=\"{}\" time=\"{:.3f}\">\n{}  </testsuite>\n",
      MarkupText(name), suite.tests, suite.failures, suite.errors, suite.skipped, time_s, cases);
  return suite;
}

}  // namespace

std::string JunitXml(const Json& summary, const std::vector<GateState>& gate, bool failed_fast,
                     const std::string& scenario_name) {
  Suite all;
  std::size_t v = 0;
  for (const auto& [name, variant] : summary["variants"].items()) {
    const Suite suite = VariantSuite(scenario_name + "." + name, variant, summary["unfinished"],
                                     failed_fast, v < gate.size() ? &gate[v] : nullptr);
    all.xml += suite.xml;
    all.tests += suite.tests;
    all.failures += suite.failures;
    all.errors += suite.errors;
    all.skipped += suite.skipped;
    ++v;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\" skipped=\"{}\">\n{}</testsuites>\n",
      all.tests, all.failures, all.errors, all.skipped, all.xml);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/suite.h"

#include <algorithm>

#include "base/interrupt.h"
#include "run/scenario/scenario.h"
#include "stats/binomial.h"
#include "stats/demonstration.h"
#include "validate/suite/method_search.h"

namespace floorproof {
namespace {

// What a film shows.
std::size_t ShownRun(const MethodResult& result) {
  const auto best = [&](auto&& better) {
    std::size_t found = 0;
    for (std::size_t i = 1; i < result.runs.size(); ++i)
      if (better(result.runs[i], result.runs[found])) found = i;
    return found;
  };
  // The failure at the easiest size that failed; else the first pass at the size found.
  const auto harder = [&](double a, double b) {
    return result.sizes && result.sizes->smaller_is_harder() ? a < b : a > b;
  };
  if (std::ranges::any_of(result.runs, [](const SuiteRun& r) { return !r.verdict.passed; }))
    return best([&](const SuiteRun& a, const SuiteRun& b) {
      if (a.verdict.passed != b.verdict.passed) return !a.verdict.passed;
      return !a.verdict.passed && harder(b.size, a.size);
    });
  if (result.measures)
    return best([](const SuiteRun& a, const SuiteRun& b) {
      return a.verdict.figure.value_or(0) > b.verdict.figure.value_or(0);
    });
  return best([&](const SuiteRun& a, const SuiteRun& b) { return harder(a.size, b.size); });
}

}  // namespace

std::string_view VerdictWord(const MethodResult& result) {
  if (!result.not_applicable.empty()) return "not applicable";
  if (!result.passed()) return "failed";
  return result.sizes ? "limit found" : "passed";
}

void CheckMethod(const PluginEntry<Method>& entry, const RobotModel& robot, const std::string& name,
                 const SuiteOptions& options) {
  const auto method = entry.make();
  if (!method->WhyNot(robot).empty()) return;
  const SuiteDrive drive(entry, name, robot, options);
  const auto sizes = method->sizes(robot);
  drive.Read(drive.Draw(0, sizes ? sizes->Size(sizes->rungs.first) : 0));
}

std::optional<MethodResult> RunMethod(
    const PluginEntry<Method>& entry, const RobotModel& robot, const std::string& name,
    const SuiteOptions& options, const std::function<void(const SuiteProgress&)>& on_progress) {
  const int n = RunsToDemonstrate(options.reliability, options.confidence);
  const auto method = entry.make();
  MethodResult result;
  result.method = entry.name;
  result.not_applicable = method->WhyNot(robot);
  result.sizes = method->sizes(robot);
  result.measures = method->figure();
  if (!result.not_applicable.empty()) return result;

  const SuiteDrive drive(entry, name, robot, options);
  MethodSearch search(drive, n, result, on_progress);
  int rung = 0;
  if (result.sizes) {
    if (!search.FindRung(rung)) return {};
    if (rung > 0) result.size = result.sizes->Size(rung);
  }
  // At a size that was found they are known; where there is none, all count at the easiest.
  const int at = result.sizes && rung == 0 ? result.sizes->rungs.first : rung;
  const auto counted = search.DriveAll(at);
  if (Interrupted()) return {};
  for (const SuiteRun* run : counted) {
    ++result.n;
    result.failures += !run->verdict.passed;
    if (run->verdict.figure)
      result.figure = std::max(result.figure.value_or(0), *run->verdict.figure);
  }
  if (result.failures > 0) result.figure.reset();  // a drive that failed was cut short
  result.reliability_lower =
      ClopperPearsonLower(result.n - result.failures, result.n, options.confidence);
  if (result.size)
    result.easier = static_cast<int>(std::ranges::count_if(result.runs, [&](const SuiteRun& run) {
      return !result.sizes->Reaches(run.size, *result.size);
    }));
  result.shown = ShownRun(result);
  return result;
}

}  // namespace floorproof

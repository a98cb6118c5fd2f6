// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/robot_suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/params.h"
#include "base/quantity.h"

namespace floorproof {
namespace {

std::string SizeText(const SizeLadder& sizes, double size) {
  return fmt::format("{} {}", NumberText(size), sizes.unit);
}

// Rounded down: what is claimed holds.
std::string AtLeastPercent(double share) {
  constexpr double kDigits = 1000;
  return PercentText(std::floor(share * kDigits + 1e-9) / kDigits);
}

const SuiteRun* EasiestFailure(const MethodResult& result) {
  const SuiteRun* found = nullptr;
  for (const SuiteRun& run : result.runs) {
    if (run.verdict.passed) continue;
    const bool easier =
        found == nullptr ||
        (result.sizes->smaller_is_harder() ? run.size > found->size : run.size < found->size);
    if (easier) found = &run;
  }
  return found;
}

}  // namespace

SuiteRequirement ReadRequirement(const std::string& text) {
  const auto refuse = [&](const std::string& rule) {
    throw InputError({"--require", 0}, "", text, rule);
  };
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    refuse("must be METHOD=VALUE, as in --require step=10");
  SuiteRequirement required{text.substr(0, equals), 0};
  const std::string value = text.substr(equals + 1);
  char* end = nullptr;
  required.value = std::strtod(value.c_str(), &end);
  if (value.empty() || *end != '\0' || !(required.value > 0) || required.value > 1e9)
    refuse("the value must be a number above 0");
  const auto method = MakePlugin(Methods(), required.method, "--require");
  // Whether there are sizes is the same for all robots.
  const RobotModel any = ReadRobot(FindRobotFile(std::string(Robots().front().name), {}));
  if (!method->sizes(any) && !method->figure())
    refuse("the method " + required.method + " has neither sizes nor a figure: it passes or fails");
  return required;
}

void RefuseBeyondLadders(std::span<const SuiteRequirement> required, const RobotModel& robot) {
  for (const SuiteRequirement& r : required) {
    const auto sizes = MakePlugin(Methods(), r.method, "--require")->sizes(robot);
    if (!sizes) continue;
    const double hardest = sizes->Size(sizes->rungs.last);
    if (!sizes->Reaches(hardest, r.value))
      throw InputError({"--require", 0}, r.method, FormatDouble(r.value),
                       "its sizes for " + robot.spec.name + " end at " + SizeText(*sizes, hardest));
  }
}

std::optional<double> FailsAt(const MethodResult& result) {
  if (!result.sizes) return {};
  const SuiteRun* failed = EasiestFailure(result);
  return failed == nullptr ? std::nullopt : std::optional(failed->size);
}

std::string WithdrawnText(const MethodResult& result) {
  if (!result.withdrawn) return "";
  return fmt::format("also fails at an easier size: {}; so {}, which all runs pass, does not count",
                     SizeText(*result.sizes, *FailsAt(result)),
                     SizeText(*result.sizes, *result.withdrawn));
}

std::string WhyMissed(const MethodResult& result, std::span<const SuiteRequirement> required) {
  if (!result.not_applicable.empty()) {
    const bool asked = std::ranges::any_of(
        required, [&](const SuiteRequirement& r) { return r.method == result.method; });
    return asked ? "not applicable: " + result.not_applicable : "";
  }
  const std::string withdrawn = result.withdrawn ? "; " + WithdrawnText(result) : "";
  if (!result.passed()) {
    return fmt::format("{} of {} failed{}{}", result.failures, result.n,
                       result.sizes ? " at the easiest size" : "", withdrawn);
  }
  for (const SuiteRequirement& r : required) {
    if (r.method != result.method) continue;
    if (result.sizes && !result.sizes->Reaches(*result.size, r.value))
      return fmt::format("{}, {} is required{}", SizeText(*result.sizes, *result.size),
                         SizeText(*result.sizes, r.value), withdrawn);
    if (result.measures && result.figure && *result.figure > r.value)
      return fmt::format("{} {}, {} at most is required", NumberText(*result.figure),
                         result.measures->unit, NumberText(r.value));
  }
  return "";
}

std::string ResultText(const MethodResult& result) {
  if (!result.not_applicable.empty()) return "not applicable";
  if (result.sizes) {
    if (!result.size) return "none";
    return SizeText(*result.sizes, *result.size) +
           (result.above_all ? result.sizes->smaller_is_harder() ? " or less" : " or more" : "");
  }
  const std::string count = fmt::format("{} of {}", result.n - result.failures, result.n);
  if (result.measures && result.figure && result.failures == 0)
    return fmt::format("{} {} at most", NumberText(*result.figure), result.measures->unit);
  return (result.failures == 0 ? "passed, " : "failed, ") + count;
}

std::string ResultSentence(const MethodResult& result, const SuiteOptions& options) {
  if (!result.not_applicable.empty()) return "Not applicable: " + result.not_applicable + ".";
  const std::string sure = PercentText(options.confidence) + " confidence";
  const std::string at =
      !result.sizes ? ""
                    : fmt::format(" at {} {}", result.sizes->what,
                                  SizeText(*result.sizes, result.size.value_or(result.sizes->Size(
                                                              result.sizes->rungs.first))));
  std::string text = fmt::format("{} of {} runs passed{}: at least {} of such runs do, at {}.",
                                 result.n - result.failures, result.n, at,
                                 AtLeastPercent(result.reliability_lower), sure);
  if (result.measures && result.figure)
    text += fmt::format(" The {} was {} {} at most: {} of such runs keep below that, at {}.",
                        result.measures->what, NumberText(*result.figure), result.measures->unit,
                        PercentText(options.reliability), sure);
  if (result.easier > 0)
    text += fmt::format(" None of {} at easier sizes failed.", CountText(result.easier, "run"));
  if (result.sizes && result.size && !result.above_all)
    if (const SuiteRun* failed = EasiestFailure(result))
      text += fmt::format(" At {} run {} failed: {}.", SizeText(*result.sizes, failed->size),
                          failed->run, failed->verdict.why);
  if (result.withdrawn) text += " It " + WithdrawnText(result) + ".";
  if (result.above_all) text += " Nothing harder was tried.";
  return text;
}

}  // namespace floorproof

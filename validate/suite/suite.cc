// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/suite.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/interrupt.h"
#include "stats/binomial.h"
#include "stats/demonstration.h"
#include "validate/suite/suite_drive.h"

namespace floorproof {
namespace {

// One method's runs, each driven once, and the search over its sizes.
class MethodSearch {
 public:
  MethodSearch(const SuiteDrive& drive, int n, MethodResult& result,
               const std::function<void(const SuiteProgress&)>& on_progress)
      : drive_(drive), result_(result), on_progress_(on_progress), order_(n) {
    std::iota(order_.begin(), order_.end(), 0);
    std::ranges::stable_sort(order_, {},
                             [&](int run) { return drive_.Draw(run, 0).draw.friction; });
  }

  // The hardest rung that all pass, 0: none. False when interrupted.
  bool FindRung(int& rung) {
    const SizeLadder& ladder = *result_.sizes;
    int weakest = order_.front();
    auto limit = FindLimit(ladder.rungs, [&](double size) {
      return Passes(static_cast<int>(std::lround(size * ladder.rungs.per_unit)), weakest);
    });
    if (!limit) return false;
    rung = static_cast<int>(std::lround(limit->size * ladder.rungs.per_unit));
    result_.above_all = limit->above_all;
    while (rung > 0) {
      const std::vector<const SuiteRun*> driven = Drive(rung, order_, false);
      if (Interrupted()) return false;
      if (driven.back()->verdict.passed) return true;
      weakest = driven.back()->run;
      result_.above_all = false;
      rung = Down(rung, weakest);
      if (Interrupted()) return false;
    }
    return true;
  }

  // Of these runs at this rung, in order up to the first that fails, or all.
  std::vector<const SuiteRun*> Drive(int rung, const std::vector<int>& runs, bool all) {
    const double size = result_.sizes ? result_.sizes->Size(rung) : 0;
    std::vector<SuiteRun> missing;
    for (const int run : runs) {
      const auto known = known_.find({rung, run});
      if (known == known_.end()) missing.push_back(drive_.Draw(run, size));
      if (!all && known != known_.end() && !result_.runs[known->second].verdict.passed) break;
    }
    for (SuiteRun& run : drive_.Drive(std::move(missing), all)) {
      known_[{rung, run.run}] = result_.runs.size();
      result_.simulated_s += run.duration_s;
      result_.runs.push_back(std::move(run));
    }
    if (on_progress_) on_progress_({result_.method, static_cast<int>(result_.runs.size()), size});
    std::vector<const SuiteRun*> driven;
    for (const int run : runs) {
      const auto known = known_.find({rung, run});
      if (known == known_.end()) break;
      driven.push_back(&result_.runs[known->second]);
      if (!all && !driven.back()->verdict.passed) break;
    }
    return driven;
  }

  const std::vector<int>& order() const { return order_; }

 private:
  bool Passes(int rung, int run) {
    const auto driven = Drive(rung, {run}, true);
    return !driven.empty() && driven.front()->verdict.passed;
  }

  // The hardest rung below `failed` that this run passes, by bisection; 0: not the first.
  int Down(int failed, int run) {
    const int first = result_.sizes->rungs.first;
    if (failed == first || !Passes(first, run)) return 0;
    int passed = first;
    while (failed - passed > 1 && !Interrupted()) {
      const int middle = (passed + failed) / 2;
      (Passes(middle, run) ? passed : failed) = middle;
    }
    return passed;
  }

  const SuiteDrive& drive_;
  MethodResult& result_;
  const std::function<void(const SuiteProgress&)>& on_progress_;
  std::vector<int> order_;  // the slipperiest floor first: it mostly decides
  std::map<std::pair<int, int>, std::size_t> known_;  // (rung, run) -> place in result_.runs
};

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

void CheckMethod(const PluginEntry<Method>& entry, const std::string& robot_name,
                 const SuiteOptions& options) {
  const RobotModel robot = ReadRobot(FindRobotFile(robot_name, {}));
  const auto method = entry.make();
  if (!method->WhyNot(robot).empty()) return;
  const SuiteDrive drive(entry, robot_name, robot, options);
  const auto sizes = method->sizes(robot);
  drive.Read(drive.Draw(0, sizes ? sizes->Size(sizes->rungs.first) : 0));
}

std::optional<MethodResult> RunMethod(
    const PluginEntry<Method>& entry, const std::string& robot_name, const SuiteOptions& options,
    const std::function<void(const SuiteProgress&)>& on_progress) {
  const int n = RunsToDemonstrate(options.reliability, options.confidence);
  const RobotModel robot = ReadRobot(FindRobotFile(robot_name, {}));
  const auto method = entry.make();
  MethodResult result;
  result.method = entry.name;
  result.not_applicable = method->WhyNot(robot);
  result.sizes = method->sizes(robot);
  result.measures = method->figure();
  if (!result.not_applicable.empty()) return result;

  const SuiteDrive drive(entry, robot_name, robot, options);
  MethodSearch search(drive, n, result, on_progress);
  int rung = 0;
  if (result.sizes) {
    if (!search.FindRung(rung)) return {};
    if (rung > 0) result.size = result.sizes->Size(rung);
  }
  // At a size that was found they are known; where there is none, all count at the easiest.
  const int at = result.sizes && rung == 0 ? result.sizes->rungs.first : rung;
  const auto counted = search.Drive(at, search.order(), true);
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
  result.shown = ShownRun(result);
  return result;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// The suite: test methods over and over on one robot, until each has demonstrated what it can.
//
// n = RunsToDemonstrate(reliability, confidence) runs, each with its own draws. Of a method with
// sizes the largest is found that all n pass (method_search.h). That is the least of n draws' own
// limits, where whoever passes a size passes what is easier: so n passes at it demonstrate the
// reliability although the size was searched for with the same draws (Wilks' one-sided tolerance
// limit, Ann. Math. Stat. 12 (1941) 91). The same holds of the greatest of n measured figures.
//
// That what is easier is passed, too, is checked on half of the draws. Of each method a size
// above the one that is claimed was tried, and a draw failed it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/scenario/override.h"
#include "validate/suite/method.h"

namespace floorproof {

struct SuiteOptions {
  double reliability = 0.95, confidence = 0.95;
  std::uint64_t seed = 0;
  int jobs = 1;
  std::vector<Override> overrides = {};  // of every method's scenario
};

// One run that was driven and judged.
struct SuiteRun {
  int run = 0;  // its number, 0 .. n - 1
  double size = 0;
  SuiteDraw draw = {};
  MethodVerdict verdict = {};
  double duration_s = 0;  // simulated
  // As it was driven: drawn, unless they were set for every run.
  double friction = 0, mass_kg = 0;
};

struct MethodResult {
  std::string method;
  std::string not_applicable;  // why; else empty, and what follows stands
  std::optional<SizeLadder> sizes;
  std::optional<MeasuredFigure> measures;
  int n = 0;         // runs that count: at `size`, where there are sizes
  int failures = 0;  // of them
  // Exact (Clopper-Pearson) at the suite's confidence: a run passes with at least this probability.
  double reliability_lower = 0;
  // Of a method with sizes: the hardest that all n pass; none: not even the easiest.
  std::optional<double> size;
  bool above_all = false;  // it is the hardest of the ladder
  int easier = 0;          // runs at sizes easier than it: none failed
  // A harder size that all n pass, too, but that is not claimed: a run failed an easier one.
  std::optional<double> withdrawn;
  std::optional<double> figure;  // the greatest of n measured
  // Every run driven, in the order in which they were asked for.
  std::vector<SuiteRun> runs;
  std::size_t shown = 0;  // of `runs`: the one that a film shows: what failed first beyond, else a
                          // pass at `size`; of a measured figure the greatest
  double simulated_s = 0;

  // All n passed; with sizes: at least the easiest.
  bool passed() const { return not_applicable.empty() && n > 0 && failures == 0; }
};

// "passed", "failed", "limit found" or "not applicable".
std::string_view VerdictWord(const MethodResult& result);

// How far a method is: runs of those that are driven now, and of all so far.
struct SuiteProgress {
  std::string_view method;
  int driven = 0, asked = 0;
  int driven_in_all = 0;
};

// Lays the method's first run out and reads it, where the method can be asked of this robot: what
// is wrong with it costs no drive. Throws InputError.
void CheckMethod(const PluginEntry<Method>& entry, const RobotModel& robot, const std::string& name,
                 const SuiteOptions& options);

// Runs one method. Nothing when interrupted. The same result for any number of jobs. `name`: the
// robot's, a bundled one or a file. `on_progress` is called after each run, by one thread at a
// time. Throws InputError where a scenario cannot be laid out (an override that
// makes no sense), InternalError when the physics diverges.
std::optional<MethodResult> RunMethod(const PluginEntry<Method>& entry, const RobotModel& robot,
                                      const std::string& name, const SuiteOptions& options,
                                      const std::function<void(const SuiteProgress&)>& on_progress);

// A run as a user would drive it: scenario.yaml, and line.csv where the method states a plan, in
// this folder. Throws InputError.
void WriteRun(const PluginEntry<Method>& entry, const RobotModel& robot, const std::string& name,
              const SuiteRun& run, const SuiteOptions& options,
              const std::filesystem::path& folder);
inline constexpr const char* kRunFile = "scenario.yaml";
inline constexpr const char* kPlanFile = "line.csv";

}  // namespace floorproof

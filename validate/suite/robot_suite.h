// SPDX-License-Identifier: Apache-2.0
// What the suite found of one robot, and whether that is what was asked for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validate/suite/suite.h"

namespace floorproof {

struct RobotSuite {
  std::string robot;                  // as it was named
  std::string label;                  // its name, or its file's without folder and ending
  std::vector<MethodResult> methods;  // those that are done, in the list's order
  std::vector<std::string> filmed;    // of them
};

// "step=12": of a method with sizes, at least as hard a size; of one that measures, at most that.
struct SuiteRequirement {
  std::string method;
  double value = 0;
};

// Throws InputError.
SuiteRequirement ReadRequirement(const std::string& text);
// Throws InputError naming what no run of this robot could reach.
void RefuseBeyondLadders(std::span<const SuiteRequirement> required, const RobotModel& robot);

// Why the method's result is not what is asked for; empty: it is. Without requirements a method
// must pass: one with sizes at its easiest.
std::string WhyMissed(const MethodResult& result, std::span<const SuiteRequirement> required);

// The easiest size that a run failed. All that all runs pass beyond it is taken back.
std::optional<double> FailsAt(const MethodResult& result);
// "also fails at an easier size: 41 mm; so 80 mm, which all runs pass, does not count"; empty where
// nothing was taken back.
std::string WithdrawnText(const MethodResult& result);

// "12 mm", "102 mm or more", "none", "passed, 59 of 59", "not applicable".
std::string ResultText(const MethodResult& result);
// What that is worth: "59 of 59 passed: 95 % of such runs pass, at 95 % confidence; ...".
std::string ResultSentence(const MethodResult& result, const SuiteOptions& options);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// One run of a method, from its draws to its verdict.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "validate/suite/suite.h"

namespace floorproof {

struct Scenario;

// The method's runs on one robot.
class SuiteDrive {
 public:
  SuiteDrive(const PluginEntry<Method>& entry, const std::string& robot_name,
             const RobotModel& robot, const SuiteOptions& options);

  SuiteRun Draw(int run, double size) const;
  // Drives and judges them on the suite's threads, in order up to the first that fails (`all`: to
  // the end), whatever finished first. None when interrupted. Tells after each run how many were
  // driven, one thread at a time.
  std::vector<SuiteRun> Drive(std::vector<SuiteRun> runs, bool all,
                              const std::function<void(int driven)>& on_driven) const;
  Scenario Read(const SuiteRun& run) const;
  // The scenario's text; `with_plan`: its plan stands in a file beside it.
  std::string Text(const SuiteRun& run, const MethodDrive& drive, bool with_plan) const;
  MethodDrive LayOut(const SuiteRun& run) const;

 private:
  void Judge(const Scenario& scenario, SuiteRun& run) const;

  std::string name_, robot_name_;
  std::unique_ptr<Method> method_;
  const RobotModel& robot_;
  SuiteOptions options_;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Test methods: what a robot is asked to do over and over, and when it has passed. A new one is one
// file in validate/suite/methods and one line in its list.inc.
//
// A method lays out a scenario for each run, as a user's file would state it, and judges the record
// of its drive. So every run can be driven again, alone, by `floorproof run`.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/registry.h"
#include "env/scene/robot_model.h"
#include "run/episode/episode.h"
#include "validate/limit_search.h"
#include "validate/suite/population.h"

namespace floorproof {

// A size that makes a method harder rung by rung.
struct SizeLadder {
  std::string_view what, unit;
  Rungs rungs;           // the higher, the harder
  double down_from = 0;  // not 0: rungs are taken off it: the smaller, the harder
  double Size(int rung) const {
    const double size = static_cast<double>(rung) / rungs.per_unit;
    return down_from == 0 ? size : down_from - size;
  }
  bool smaller_is_harder() const { return down_from != 0; }
  // Whether passing at `size` is as much as passing at `asked`.
  bool Reaches(double size, double asked) const {
    constexpr double kSame = 1e-9;
    return smaller_is_harder() ? size <= asked + kSame : size >= asked - kSame;
  }
};

// A figure that every run of a method gives; the least is best.
struct MeasuredFigure {
  std::string_view what, unit;
};

// One run, before it is driven.
struct MethodRun {
  std::string_view method;  // its name
  const RobotModel& robot;  // as it is modelled, no draw applied
  const SuiteDraw& draw;
  double size = 0;  // of the ladder; 0: the method has none
};

// What is driven: a scenario's keys but for `scenario`, `name`, `robot` and its draws, and a plan;
// without a plan the keys say how it is made.
struct MethodDrive {
  std::string keys;  // YAML
  Path plan;
};

struct MethodVerdict {
  bool passed = false;
  std::string why = {};               // where not
  std::optional<double> figure = {};  // in the measured figure's unit
};

class Method {
 public:
  virtual ~Method() = default;
  // The tests after which it is shaped, by standard and title.
  virtual std::string_view shaped_after() const = 0;
  // What the robot is to do, and when it has passed, in a sentence or two.
  virtual std::string_view task() const = 0;
  // None: it is passed or not.
  virtual std::optional<SizeLadder> sizes(const RobotModel&) const { return {}; }
  virtual std::optional<MeasuredFigure> figure() const { return {}; }
  // Why it cannot be asked of this robot; empty: it can.
  virtual std::string WhyNot(const RobotModel&) const { return ""; }
  virtual MethodDrive LayOut(const MethodRun& run) const = 0;
  // Of a drive that came to its own end: not of one that broke or was interrupted.
  virtual MethodVerdict Judge(const MethodRun& run, const EpisodeRecord& record) const;
};

std::span<const PluginEntry<Method>> Methods();

// "stuck", "roll_over/fell at pit", "timeout": how a drive ended that is no success.
std::string HowItEnded(const EpisodeRecord& record);

}  // namespace floorproof

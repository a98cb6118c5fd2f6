// SPDX-License-Identifier: Apache-2.0
// Laws: what physics says in closed form, against what the simulation does. A new one is one file
// in validate/laws and one line in its list.inc.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/registry.h"
#include "validate/rig.h"

namespace floorproof {

// One comparison. `law` names the law and the case: "rolling/beluga/forward".
struct LawRow {
  std::string law;
  double expected = 0;   // in closed form, from the true model
  double measured = 0;   // in the simulation
  double tolerance = 0;  // most that they may differ; stated where the law is
  std::string unit;
  bool ok() const { return std::abs(measured - expected) <= tolerance; }  // false for NaN
};

class Law {
 public:
  virtual ~Law() = default;
  // The law as a formula, with where it holds.
  virtual std::string_view statement() const = 0;
  // The wrong models that it must notice. Under each of them at least one of its rows fails. For
  // every robot and case (a row's name without its last part), at least one row fails under one of
  // them.
  virtual std::vector<WrongModel> notices() const = 0;
  // Takes more than some 3 s of CPU: its tests are labelled slow.
  virtual bool slow() const { return false; }
  // Adds the law's rows. Deterministic; may run on any thread, beside other laws.
  virtual void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const = 0;
};

// Wrong models that several laws are tried with: friction or the motors' resistance 1.3 times,
// wheels 3 mm larger.
inline constexpr WrongModel kMoreFriction{.friction_factor = 1.3};
inline constexpr WrongModel kLargerWheels{.wheel_radius_add_m = 0.003};
inline constexpr WrongModel kMoreResistance{.resistance_factor = 1.3};

std::span<const PluginEntry<Law>> Laws();

struct LawResult {
  std::string name;       // of the plug-in
  std::string statement;  // the law
  std::vector<LawRow> rows;
};

// Checks every law on the true model, on `jobs` threads; results in the list's order, whatever
// finished first. `on_done` is called once a law, one call at a time. Throws what a law threw.
std::vector<LawResult> CheckLaws(int jobs, const std::function<void(const LawResult&)>& on_done);

// law,expected,measured,tolerance,unit,ok
std::string ValidateCsv(std::span<const LawResult> results);

}  // namespace floorproof

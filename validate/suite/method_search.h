// SPDX-License-Identifier: Apache-2.0
// The search for the hardest size that all runs of a method pass.
//
// The draw on the slipperiest floor climbs the ladder (limit_search.h). All draws are driven at its
// limit; one that fails goes down to its own limit, by bisection, and so on. Then easier sizes are
// tried (EasierTries): a failure there takes the claim back, and the search goes on below it.
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "validate/suite/suite_drive.h"

namespace floorproof {

// A run at a rung of the ladder; 0 where the method has no sizes.
struct Try {
  int rung = 0, run = 0;
  auto operator<=>(const Try&) const = default;
};

// Which runs are driven below `rung` to check that who passes it passes what is easier: every
// second of `order`, from the first on. Their rungs go round [first, rung) in steps of the golden
// section, which spreads any number of them evenly (Weyl's sequence). None where nothing is easier.
std::vector<Try> EasierTries(int first, int rung, const std::vector<int>& order);

class MethodSearch {
 public:
  // What is driven goes into `result.runs`, each run at each size once.
  MethodSearch(const SuiteDrive& drive, int n, MethodResult& result,
               std::function<void(const SuiteProgress&)> on_progress);

  // The hardest rung that all n pass while no easier one that was tried fails; 0: none. Says in the
  // result whether it is the ladder's last, and what was taken back. False when interrupted.
  bool FindRung(int& rung);
  // All n runs at this rung, whatever fails. Fewer when interrupted.
  std::vector<const SuiteRun*> DriveAll(int rung);

 private:
  // These in order, up to the first that fails, or all.
  std::vector<const SuiteRun*> Drive(const std::vector<Try>& tries, bool all);
  std::vector<Try> AllAt(int rung) const;
  bool Passes(const Try& one);
  std::optional<Try> WhatFails(int rung);
  int Down(const Try& failed);
  double Size(int rung) const { return result_.sizes ? result_.sizes->Size(rung) : 0; }

  const SuiteDrive& drive_;
  MethodResult& result_;
  std::function<void(const SuiteProgress&)> on_progress_;
  std::vector<int> order_;            // the slipperiest floor first: it mostly decides
  std::map<Try, std::size_t> known_;  // place in result_.runs
};

}  // namespace floorproof

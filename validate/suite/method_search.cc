// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/method_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/interrupt.h"

namespace floorproof {

std::vector<Try> EasierTries(int first, int rung, const std::vector<int>& order) {
  constexpr std::size_t kEvery = 2;
  std::vector<Try> tries;
  if (rung <= first) return tries;
  double share = 0.5;
  for (std::size_t i = 0; i < order.size(); i += kEvery) {
    tries.push_back({first + static_cast<int>(share * (rung - first)), order[i]});
    share = std::fmod(share + std::numbers::phi, 1);
  }
  return tries;
}

MethodSearch::MethodSearch(const SuiteDrive& drive, int n, MethodResult& result,
                           std::function<void(const SuiteProgress&)> on_progress)
    : drive_(drive),
      result_(result),
      on_progress_(std::move(on_progress)),
      order_(static_cast<std::size_t>(n)) {
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::stable_sort(order_, {}, [&](int run) { return drive_.Draw(run, 0).draw.friction; });
}

bool MethodSearch::FindRung(int& rung) {
  const Rungs& rungs = result_.sizes->rungs;
  const auto limit = FindLimit(rungs, [&](double size) {
    return Passes({static_cast<int>(std::lround(size * rungs.per_unit)), order_.front()});
  });
  if (!limit) return false;
  rung = static_cast<int>(std::lround(limit->size * rungs.per_unit));
  result_.above_all = limit->above_all;
  while (rung > 0) {
    const std::optional<Try> failed = WhatFails(rung);
    if (Interrupted()) return false;
    if (!failed) return true;
    result_.above_all = false;
    rung = Down(*failed);
    if (Interrupted()) return false;
  }
  return true;
}

std::vector<const SuiteRun*> MethodSearch::DriveAll(int rung) { return Drive(AllAt(rung), true); }

std::vector<Try> MethodSearch::AllAt(int rung) const {
  std::vector<Try> all;
  for (const int run : order_) all.push_back({rung, run});
  return all;
}

std::vector<const SuiteRun*> MethodSearch::Drive(const std::vector<Try>& tries, bool all) {
  std::vector<Try> missing;
  std::vector<SuiteRun> runs;
  for (const Try& one : tries) {
    const auto known = known_.find(one);
    if (known == known_.end()) {
      missing.push_back(one);
      runs.push_back(drive_.Draw(one.run, Size(one.rung)));
    } else if (!all && !result_.runs[known->second].verdict.passed) {
      break;
    }
  }
  const int before = static_cast<int>(result_.runs.size());
  const auto driven_now = drive_.Drive(std::move(runs), all, [&](int driven) {
    if (on_progress_)
      on_progress_({result_.method, driven, static_cast<int>(missing.size()), before + driven});
  });
  for (std::size_t i = 0; i < driven_now.size(); ++i) {
    known_[missing[i]] = result_.runs.size();
    result_.simulated_s += driven_now[i].duration_s;
    result_.runs.push_back(driven_now[i]);
  }
  std::vector<const SuiteRun*> driven;
  for (const Try& one : tries) {
    const auto known = known_.find(one);
    if (known == known_.end()) break;
    driven.push_back(&result_.runs[known->second]);
    if (!all && !driven.back()->verdict.passed) break;
  }
  return driven;
}

bool MethodSearch::Passes(const Try& one) {
  const auto driven = Drive({one}, true);
  return !driven.empty() && driven.front()->verdict.passed;
}

// The first of all n at this rung that fails. Where none does, the easiest failure below it.
std::optional<Try> MethodSearch::WhatFails(int rung) {
  const auto at_it = Drive(AllAt(rung), false);
  if (Interrupted()) return {};
  if (!at_it.back()->verdict.passed) return Try{rung, at_it.back()->run};
  const std::vector<Try> tries = EasierTries(result_.sizes->rungs.first, rung, order_);
  const auto easier = Drive(tries, true);
  if (Interrupted()) return {};
  std::optional<Try> failed;
  for (std::size_t i = 0; i < tries.size(); ++i)
    if (!easier[i]->verdict.passed && (!failed || tries[i] < *failed)) failed = tries[i];
  if (failed && !result_.withdrawn) result_.withdrawn = Size(rung);
  return failed;
}

// The hardest rung below it that this run passes, by bisection; 0: not the first.
int MethodSearch::Down(const Try& failed) {
  const int first = result_.sizes->rungs.first;
  if (failed.rung == first || !Passes({first, failed.run})) return 0;
  int passed = first, held = failed.rung;
  while (held - passed > 1 && !Interrupted()) {
    const int middle = (passed + held) / 2;
    (Passes({middle, failed.run}) ? passed : held) = middle;
  }
  return passed;
}

}  // namespace floorproof

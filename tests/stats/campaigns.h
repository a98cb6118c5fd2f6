// SPDX-License-Identifier: Apache-2.0
// Many simulated campaigns under one stopping rule.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/streams.h"

namespace floorproof {

// A rule that stops on (k, n), as the counts at which it passes and fails: entry n - 1 is for n.
struct StoppingRule {
  std::vector<int> pass_at_most;   // -1: no count passes
  std::vector<int> fail_at_least;  // n + 1: no count fails
};

struct StopChances {
  double passed = 0, failed = 0;
};

// Exact: the probability of each count among the campaigns that go on, carried from episode to
// episode.
inline StopChances Enumerate(const StoppingRule& rule, double p) {
  StopChances chances;
  std::vector<double> going_on(rule.pass_at_most.size() + 2, 0.0);  // by k
  going_on[0] = 1;
  std::size_t most = 0;  // the largest k that has not failed
  for (std::size_t i = 0; i < rule.pass_at_most.size(); ++i) {
    ++most;
    for (std::size_t k = most; k > 0; --k)
      going_on[k] = going_on[k] * (1 - p) + going_on[k - 1] * p;
    going_on[0] *= 1 - p;
    for (int k = 0; k <= rule.pass_at_most[i]; ++k)
      chances.passed += std::exchange(going_on[static_cast<std::size_t>(k)], 0.0);
    for (; most >= static_cast<std::size_t>(rule.fail_at_least[i]); --most)
      chances.failed += std::exchange(going_on[most], 0.0);
  }
  return chances;
}

struct CampaignTally {
  int campaigns = 0;
  std::vector<int> passed_at, failed_at;  // n of each that passed, that failed
  double Passed() const { return static_cast<double>(passed_at.size()) / campaigns; }
  double Failed() const { return static_cast<double>(failed_at.size()) / campaigns; }
};

// Of more than half the campaigns, the n by which half of all had stopped so.
inline int MedianOfAll(std::vector<int> stopped_at, int campaigns) {
  std::sort(stopped_at.begin(), stopped_at.end());
  return stopped_at.at(static_cast<std::size_t>(campaigns - 1) / 2);
}

inline CampaignTally Simulate(const StoppingRule& rule, double p, int campaigns) {
  CampaignTally tally;
  tally.campaigns = campaigns;
  for (int c = 0; c < campaigns; ++c) {
    Stream stream(11, static_cast<std::uint64_t>(c), "gate campaigns");
    int k = 0, n = 0;
    for (std::size_t i = 0; i < rule.pass_at_most.size(); ++i) {
      ++n;
      k += stream.Uniform() < p;
      if (k <= rule.pass_at_most[i]) {
        tally.passed_at.push_back(n);
        break;
      }
      if (k >= rule.fail_at_least[i]) {
        tally.failed_at.push_back(n);
        break;
      }
    }
  }
  return tally;
}

}  // namespace floorproof

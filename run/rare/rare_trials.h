// SPDX-License-Identifier: Apache-2.0
// The trials of a search for rare failures: episodes of given draws, driven in worker processes and
// kept in trials.sqlite, a row each under its number.
//
// What a search asks for follows from its seed and the results so far. So one that was broken off
// asks for the same again, and what is kept is not driven twice.
#pragma once

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "run/campaign/campaign_store.h"
#include "run/campaign/episode_maker.h"
#include "run/rare/rare_coordinates.h"
#include "run/rare/rare_score.h"

namespace floorproof {

struct RareProgress {
  std::uint64_t done = 0, driven = 0;  // of earlier runs too; in this one
  std::uint64_t failures = 0;          // among all of them
};

class RareTrials {
 public:
  // All outlive it. What `maker` has planned under TrialVariant() is planned for all trials of the
  // same inputs. `progress` is called now and then.
  RareTrials(EpisodeMaker& maker, const RareCoordinates& coordinates, const RareScore& score,
             CampaignStore& store, int jobs, std::function<void(const RareProgress&)> progress);

  // The next trials, numbered on from those before. Throws Interruption once what was driven is
  // kept, and InternalError where it cannot be kept.
  std::vector<TrialResult> Evaluate(std::span<const Trial> trials);
  // The row of a trial that was driven.
  EpisodeRow RowOf(const Trial& trial) const;

  std::uint64_t errors() const { return errors_; }
  const std::string& first_error() const { return first_error_; }

  static const Variant& TrialVariant();

 private:
  struct Known {
    TrialResult result;
    std::string drawn;
    bool error = false;
    std::string message;
  };
  Known Brief(const EpisodeRow& row) const;
  std::string DrawnText(const Trial& trial) const;  // as rows have it
  // `drawn`: of each trial, as rows have it.
  void Drive(std::span<const Trial> trials, std::span<const std::string> drawn,
             const std::vector<std::size_t>& missing);
  void Keep();

  EpisodeMaker& maker_;
  const RareCoordinates& coordinates_;
  const RareScore& score_;
  CampaignStore& store_;
  int jobs_;
  std::function<void(const RareProgress&)> progress_;
  std::unordered_map<std::uint64_t, Known> known_;  // by number
  std::uint64_t next_ = 0;
  std::vector<EpisodeRow> batch_;  // to be kept
  RareProgress shown_;
  std::uint64_t errors_ = 0;
  std::string first_error_;
};

}  // namespace floorproof

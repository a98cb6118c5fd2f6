// SPDX-License-Identifier: Apache-2.0
// Drives a campaign's episodes one after another, and keeps what follows from the same inputs: the
// parsed files and each variant's last plan. (A scene compiles within milliseconds.)
#pragma once

#include <map>
#include <string>

#include "planners/planner.h"
#include "run/campaign/episode_row.h"
#include "run/campaign/worker_pool.h"
#include "run/scenario/draws.h"
#include "run/scenario/matrix.h"

namespace floorproof {

class ScenarioFile;
struct Scenario;

class EpisodeMaker {
 public:
  // `file` outlives the maker. `replays`: rows of drives that did not succeed have their replay.
  explicit EpisodeMaker(const ScenarioFile& file, bool replays = false)
      : file_(file), replays_(replays) {}

  // Jobs number the episodes of all variants: episode 0 of each comes first, then episode 1.
  struct Numbered {
    const Variant& variant;
    std::uint64_t episode;
  };
  Numbered Of(Job job) const;
  // What a worker answers: the row as a line (episode_row.h), with the wall time it took.
  std::string Answer(Job job);

  // Plans and, unless the scenario says `drive: none`, drives. What an episode's draws make
  // impossible (a start in a wall) is its outcome `error`, with the reason as message.
  EpisodeRow Run(const Variant& variant, std::uint64_t episode);
  // The same of an episode whose draws are given; the row's number is the episode's own.
  EpisodeRow RunDrawn(const Variant& variant, std::uint64_t episode, const Drawn& drawn);
  // Plans for it now, so that whoever runs it later, in processes forked from this one too, finds
  // it planned. Throws as planning does.
  const PlanResult& PlanDrawn(const Variant& variant, std::uint64_t episode, const Drawn& drawn);
  // The row of an episode that could not be run.
  EpisodeRow Refused(const Variant& variant, std::uint64_t episode, const std::string& why) const;
  EpisodeRow Refused(const Variant& variant, std::uint64_t episode, const Drawn& drawn,
                     const std::string& why) const;

 private:
  struct Planned {
    std::string inputs;  // that the plan follows from
    PlanResult plan;
    std::string json;
    std::string made;  // by a program: the plan's text
  };
  EpisodeRow Drive(const Variant& variant, const Scenario& scenario);
  const Planned& Plan(const Variant& variant, const Scenario& scenario);

  const ScenarioFile& file_;
  bool replays_;
  std::map<std::string, Planned> plans_;  // by variant
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Plan, drive, judge, film: what run, replay and demo have in common.
#pragma once

#include <filesystem>

#include "apps/command.h"
#include "env/run/episode.h"

namespace floorproof {

struct DriveOptions {
  bool video = false;
  bool write_records = true;  // replay keeps what was recorded
};

struct DriveResult {
  PlanResult plan;
  EpisodeRecord record;
};

// Plans and, unless the scenario says `drive: none`, drives; writes everything into `folder` and
// says a line at each stage.
DriveResult DriveAndFilm(Scenario& scenario, const std::filesystem::path& folder,
                         const DriveOptions& options, const Globals& globals);

int ExitStatus(const DriveResult& result);

}  // namespace floorproof

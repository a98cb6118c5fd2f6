// SPDX-License-Identifier: Apache-2.0
// Plan, drive, judge, film: what run, replay and demo have in common.
#pragma once

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/console.h"
#include "env/scene/scene.h"
#include "run/episode/episode.h"

namespace floorproof {

struct Scenario;

struct DriveOptions {
  bool video = false;
  // Of the film: not empty: a draft of the seconds around the first failure of each of these modes.
  // The drive was told of before: only the film is spoken of.
  std::vector<FailureMode> only_around = {};
  bool write_records = true;            // replay keeps what was recorded
  EpisodeObserver* observer = nullptr;  // looks on as well
  std::string finished = {};            // folders that an interruption's line names as whole
};

struct DriveResult {
  PlanResult plan;
  EpisodeRecord record;
  std::optional<Scene> scene;  // that was driven in; none: nothing was, or no physics
  // Records, pictures or film could not be written (a full disk, no GL): the verdict stands all the
  // same. Rethrown by the command, once it has said the verdict.
  std::exception_ptr not_written;
};

// Plans and, unless the scenario says `drive: none`, drives; writes everything into `folder` and
// says a line at each stage. Interrupted, it writes what was driven, says what is there, and throws
// Interruption. Pictures wait for the drawing of other threads (media/drawing_lock.h), the drive
// does not.
DriveResult DriveAndFilm(const Scenario& scenario, const std::filesystem::path& folder,
                         const DriveOptions& options, const Console& console);

}  // namespace floorproof

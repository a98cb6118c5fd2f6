// SPDX-License-Identifier: Apache-2.0
// Recorded drives, driven again.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/console.h"
#include "report/drive_and_film.h"
#include "run/campaign/campaign_store.h"
#include "run/episode/json_file.h"
#include "run/scenario/draws.h"
#include "run/scenario/matrix.h"
#include "run/scenario/override.h"
#include "run/scenario/trust.h"

namespace floorproof {

class ScenarioFile;
struct Scenario;

// result.json, its metrics as this version names them. Throws InputError where it is none.
JsonValue ReadResult(const std::filesystem::path& file);

// Drives the run that `folder` holds again, its records kept; returns the result as result.json
// has it. No program is run (docs/external-planner.md). Throws InputError where the records cannot
// be read, or there is no plan but a program's, and InternalError when, without
// overrides, outcome, events or metrics are not the recorded ones: a film must show what was
// judged.
nlohmann::ordered_json ReplayRun(const std::filesystem::path& folder,
                                 const std::vector<Override>& overrides, Trust trust, bool video,
                                 const Console& console);

// Drives a recorded row again into `into`, whole as `run` would; `scenario` is what it was driven
// by, with the plan that a program made for it (AddMadePlan). No program is run. Throws as
// ReplayEpisode.
DriveResult ReplayRow(Scenario scenario, const EpisodeRow& row, const std::filesystem::path& into,
                      const DriveOptions& options, const Console& console);
// Adds to what is set for a row's drive the plan that a program made for it, if one did, kept in
// `folder`; `files`, those of the scenario, may read it from now on.
void AddMadePlan(const EpisodeRow& row, const std::filesystem::path& folder,
                 const InputFiles& files, Drawn& set);

// Drives the recorded episode again into <folder>/episodes/<variant>/<id>, whole as `run` would.
// No program is run. Throws InputError where there is no plan but a program's, and InternalError
// when outcome, events or metrics are not the recorded ones.
DriveResult ReplayEpisode(const ScenarioFile& file, const Variant& variant, const EpisodeRow& row,
                          const std::filesystem::path& folder, const DriveOptions& options,
                          const Console& console);

}  // namespace floorproof

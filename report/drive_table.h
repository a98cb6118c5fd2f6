// SPDX-License-Identifier: Apache-2.0
// What came of a drive, as a short table for people.
#pragma once

#include "base/text_table.h"
#include "run/episode/episode.h"

namespace floorproof {

struct Scenario;

// Of a drive that was planned and judged. `drive_s`: the wall time that it took.
FactTable DriveTable(const Scenario& scenario, const PlanResult& plan, const EpisodeRecord& record,
                     double drive_s);

}  // namespace floorproof

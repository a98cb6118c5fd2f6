// SPDX-License-Identifier: Apache-2.0
// What an audit found beside what lay there: the space audit ("audit-sampling", section 3.1) and
// its tapes, as pictures.
#pragma once

#include <filesystem>
#include <string>

#include "run/episode/episode.h"

namespace floorproof {

struct World;

// In words: how many samples were dirty, and the region's score with its interval.
std::string AuditText(const World& world, const PlanResult& plan, const FloorAudit& audit);

// Two maps side by side: the dirt that truly lay there before the first sample, and the score of
// each sample around its tape, dirtier places brighter in both.
void WriteDirt(const World& world, const PlanResult& plan, const FloorAudit& audit,
               const std::filesystem::path& png);

// The tapes as the microscope saw them, each by the number of its visit, with what was counted
// ringed; of many, 30 along the tour.
void WriteTapes(const World& world, const PlanResult& plan, const FloorAudit& audit,
                const std::filesystem::path& png);

}  // namespace floorproof

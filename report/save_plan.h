// SPDX-License-Identifier: Apache-2.0
// A plan's files and pictures.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "base/result_folder.h"
#include "planners/planner.h"
#include "report/risk_pictures.h"

namespace floorproof {

struct Scenario;

// Writes scenario.resolved.yaml, plan.csv, plan.json and, where risk is asked for, risk.csv, and
// the pictures of WritePlanPictures. What the folder, of EpisodeResults, holds of a drive of
// another plan goes. Returns plan.json's content. Throws InputError, InternalError.
nlohmann::ordered_json SavePlan(const Scenario& scenario, const PlanResult& plan, ResultFolder& out,
                                std::span<const RiskOfPlan> beside = {});

}  // namespace floorproof

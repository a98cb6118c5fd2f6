// SPDX-License-Identifier: Apache-2.0
// A plan and what it risks, as pictures in the style of the hTetro FMEA paper's Figures 3, 5 and 6.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/console.h"
#include "planners/risk/risk_meter.h"
#include "run/episode/episode.h"
#include "run/scenario/override.h"
#include "run/scenario/trust.h"

namespace floorproof {

struct Scenario;
struct ScenarioSpec;

struct RiskOfPlan {
  std::string label;
  RiskOfPath risk;
};
// Labelled by the planner, or by the plan's file.
RiskOfPlan MeasurePlan(const ScenarioSpec& spec, const PlanResult& plan);
// Plans these scenarios, to stand beside `first`. Throws InputError naming the one that cannot be
// read, has no plan, or has another floor, robot or risk.
std::vector<RiskOfPlan> PlansBeside(const std::vector<std::string>& files,
                                    const std::vector<Override>& overrides, const RiskOfPlan& first,
                                    Trust trust, const Console& console);

// heatmap_plan.png: the planned path over the map; where risk is asked for, over its cells, those
// with hazards coloured by their class. Of an audit, heatmap_samples.png, and plot_convergence.png
// where its order was found by iterations (report/audit_pictures.h). The others where the scenario
// asks for risk (AsksForRisk), or there are plans beside it: heatmap_risk.png: the risk factor (RF)
// of each cell that is no outer wall. heatmap_plan_visits.png: how often the plan visits each cell.
// plot_risk.png: the plot below, of this plan and those beside it. `record`: of its drive; maps
// then have its failures, and the first what was driven over the plan.
void WritePlanPictures(const Scenario& scenario, const PlanResult& plan,
                       const std::filesystem::path& folder, std::span<const RiskOfPlan> beside = {},
                       const EpisodeRecord* record = nullptr);

// Visits by ranges of RF (Figure 6), beside the number of cells in each: what visiting each once
// would be. At least one plan, all of one floor and robot; each is compared with the first.
void WriteRiskPlot(const std::string& title, std::span<const RiskOfPlan> plans,
                   const std::filesystem::path& png);

}  // namespace floorproof

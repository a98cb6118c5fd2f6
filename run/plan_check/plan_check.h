// SPDX-License-Identifier: Apache-2.0
// What can be said of a plan before it is driven: whether it leads the robot into anything, what it
// leads it over, what it leaves uncovered, what it takes.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "run/plan_check/driven_over.h"
#include "run/plan_check/plan_budget.h"
#include "run/plan_check/plan_clearance.h"
#include "run/plan_check/uncovered_pockets.h"

namespace floorproof {

struct Scenario;
struct World;

struct PlanCheck {
  PlanClearance clearance;
  std::vector<DrivenOver> driven_over;
  UncoveredFloor uncovered;
  PlanBudget budget;
  int sharp_corners = 0;  // see sharp_corners.h
};

// "planned: 71 waypoints, 120.5 m, 69 turns": of a plan that was found.
std::string PlannedText(const PlanResult& plan);
// The same, and how much of the floor it covers. `json`: its PlanJson.
std::string SweptText(const PlanResult& plan, const nlohmann::ordered_json& json);

// Of a plan that was found.
PlanCheck CheckPlan(const Scenario& scenario, const PlanResult& plan);

// In words, a line each; what needs a look begins with "warning: ". Of places,
// hazards and pockets at most five each are listed, the rest counted.
std::vector<std::string> PlanLines(const Scenario& scenario, const PlanResult& plan,
                                   const PlanCheck& check);
// Which of kPlanFaults it has: an overlap with an obstacle; a gap: pockets that the tool could
// reach above 1 m2, or together above 1 % of the free floor, where floor is to be covered, or a
// sample that it cannot reach; a warning, of `lines`, that is no overlap.
inline constexpr std::array<std::string_view, 3> kPlanFaults = {"overlap", "gap", "warning"};
std::vector<std::string> PlanFaults(const Scenario& scenario, const PlanResult& plan,
                                    const PlanCheck& check, std::span<const std::string> lines);
nlohmann::ordered_json PlanCheckJson(const World& world, const PlanCheck& check);

// What it crosses beyond what the robot is trusted to, a warning each, five at most and the rest
// counted.
std::vector<std::string> CrossingLines(const World& world, const PlanClearance& clearance);

// One line for who drives a plan; empty where it leads the robot into nothing.
std::string ConflictsLine(const PlanClearance& clearance);

// One line, too; empty where the robot stands still wherever the plan lets it dwell.
std::string UnheldDwellLine(const World& world, const PlanResult& plan);

// One line, too; empty where no corner is too sharp for the robot. `sharp_corners` as of PlanCheck.
std::string SharpCornersLine(const RobotSpec& robot, int sharp_corners);

}  // namespace floorproof

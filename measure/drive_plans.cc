// SPDX-License-Identifier: Apache-2.0
#include "measure/drive_plans.h"

#include <algorithm>

#include "measure/fit_carry_over.h"
#include "measure/plan_floors.h"
#include "run/plan_check/prediction.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

RobotCampaign Plans(const std::string& robot, int floors, const std::vector<Override>& overrides,
                    FloorConditions conditions) {
  std::vector<Override> kept;
  for (const Override& each : overrides)
    if (each.key_path == "seed" || each.key_path.starts_with("robot.")) kept.push_back(each);
  return CampaignOf(
      robot, "plans",
      [&](const std::string& named, const RobotModel& model) {
        return PlanFloorsScenario(named, model.spec, floors, conditions);
      },
      kept);
}

}  // namespace

RobotCampaign PlansOf(const std::string& robot, int floors,
                      const std::vector<Override>& overrides) {
  const bool mass_is_set = std::ranges::any_of(
      overrides, [](const Override& each) { return each.key_path == "robot.mass_kg"; });
  return Plans(robot, floors, overrides,
               mass_is_set ? FloorConditions::kKnownFriction : FloorConditions::kKnown);
}

CarryOver LearnCarryOver(const std::string& robot, int floors,
                         const std::vector<Override>& overrides, const CampaignSummary& driven,
                         const std::filesystem::path& folder) {
  constexpr int kDraws = 64;  // of friction and mass
  const RobotCampaign campaign = Plans(robot, floors, overrides, FloorConditions::kDrawn);
  const ScenarioFile predicted =
      ScenarioFile::FromText(campaign.text + "risk: {model: risk_model.json}\n",
                             std::filesystem::absolute(folder) / "plans.yaml", campaign.overrides);
  std::vector<Forecast> plans;
  for (std::size_t v = 0; v < predicted.variants().size(); ++v) {
    const VariantSummary& plan = driven.variants[v];
    if (plan.n == 0) continue;
    const Prediction prediction = Predict(predicted, predicted.variants()[v], kDraws);
    if (prediction.complete())
      plans.push_back({1 - prediction.survival.no_failure.value, plan.failures.front().k, plan.n});
  }
  return FitCarryOver(plans);
}

}  // namespace floorproof

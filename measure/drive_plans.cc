// SPDX-License-Identifier: Apache-2.0
#include "measure/drive_plans.h"

#include "measure/fit_carry_over.h"
#include "measure/plan_floors.h"
#include "run/plan_check/prediction.h"

namespace floorproof {
RobotCampaign PlansOf(const std::string& robot, int floors,
                      const std::vector<Override>& overrides) {
  std::vector<Override> kept;
  for (const Override& each : overrides)
    if (each.key_path == "seed" || each.key_path.starts_with("robot.")) kept.push_back(each);
  return CampaignOf(
      robot, "plans",
      [floors](const std::string& named, const RobotModel& model) {
        return PlanFloorsScenario(named, model.spec, floors);
      },
      kept);
}

CarryOver LearnCarryOver(const RobotCampaign& campaign, const CampaignSummary& driven,
                         const std::filesystem::path& folder) {
  constexpr int kDraws = 64;  // of friction and mass
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

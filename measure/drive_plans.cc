// SPDX-License-Identifier: Apache-2.0
#include "measure/drive_plans.h"

#include "measure/fit_carry_over.h"
#include "measure/plan_floors.h"
#include "run/plan_check/prediction.h"

namespace floorproof {
namespace {

// How often the variant's drives failed; of n only those that count.
Forecast DrivenOf(const CampaignStore& store, const std::string& variant) {
  Forecast driven{0, 0, 0};
  store.ForEach(variant, [&](const EpisodeRow& row) {
    if (!row.counts()) return;
    ++driven.n;
    driven.k += row.any_failure();
  });
  return driven;
}

}  // namespace

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

CarryOver LearnCarryOver(const RobotCampaign& campaign, const CampaignStore& store,
                         const std::filesystem::path& model,
                         const std::function<void(int done)>& progress) {
  constexpr int kDraws = 64;  // of friction and mass
  const ScenarioFile predicted = ScenarioFile::FromText(
      campaign.text + "risk: {model: \"" + std::filesystem::absolute(model).string() + "\"}\n",
      std::filesystem::absolute(model).parent_path() / "plans.yaml", campaign.overrides);
  std::vector<Forecast> plans;
  int done = 0;
  for (const Variant& variant : predicted.variants()) {
    Forecast plan = DrivenOf(store, variant.name);
    if (plan.n > 0) {
      const Prediction prediction = Predict(predicted, variant, kDraws);
      plan.p = 1 - prediction.survival.no_failure.value;
      if (prediction.complete()) plans.push_back(plan);
    }
    if (progress) progress(++done);
  }
  return FitCarryOver(plans);
}

}  // namespace floorproof

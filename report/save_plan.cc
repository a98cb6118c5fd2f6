// SPDX-License-Identifier: Apache-2.0
#include "report/save_plan.h"

#include <nlohmann/json.hpp>

#include "base/interrupt.h"
#include "run/episode/records.h"
#include "run/scenario/scenario.h"

namespace floorproof {

nlohmann::ordered_json SavePlan(const Scenario& scenario, const PlanResult& plan, ResultFolder& out,
                                std::span<const RiskOfPlan> beside) {
  const std::filesystem::path& folder = out.path();
  out.Begin();
  RemoveEpisodeFiles(out);  // of a drive of another plan
  SayWhenInterrupted(folder.string() + " may lack some of the plan's files");
  nlohmann::ordered_json json = WritePlanFiles(scenario, plan, folder);
  SayWhenInterrupted(folder.string() + " holds the plan; pictures may be missing");
  WritePlanPictures(scenario, plan, folder, beside);
  SayWhenInterrupted(folder.string() + " holds the plan");
  return json;
}

}  // namespace floorproof

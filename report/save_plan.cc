// SPDX-License-Identifier: Apache-2.0
#include "report/save_plan.h"

#include "base/interrupt.h"
#include "run/episode/records.h"

namespace floorproof {

void SavePlan(const Scenario& scenario, const PlanResult& plan, ResultFolder& out,
              std::span<const RiskOfPlan> beside) {
  const std::filesystem::path& folder = out.path();
  out.Begin();
  RemoveEpisodeFiles(out);  // of a drive of another plan
  SayWhenInterrupted(folder.string() + " may lack some of the plan's files");
  WritePlanFiles(scenario, plan, folder);
  SayWhenInterrupted(folder.string() + " holds the plan; pictures may be missing");
  WritePlanPictures(scenario, plan, folder, beside);
  SayWhenInterrupted(folder.string() + " holds the plan");
}

}  // namespace floorproof

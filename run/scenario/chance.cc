// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/chance.h"

#include <algorithm>

#include "env/map/generate.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {

bool EpisodesCanDiffer(const ScenarioFile& file, const Scenario& s) {
  return file.draws_differ() || NoiseCanDiffer(s);
}

bool NoiseCanDiffer(const Scenario& s) {
  const ConfigNode* generate = s.text.site.Find("generate");
  if (generate != nullptr && DrawnAtRandom(*generate)) return true;
  if (s.spec.promises.uses_seed) return true;
  if (const PlanCommand* program = ProgramToAsk(s.spec); program && program->uses_seed) return true;
  if (s.spec.episode.drive != "none" && s.spec.draws_on_the_way) return true;
  if (s.spec.episode.drive != "physics") return false;
  return s.spec.estimator_draws || std::ranges::any_of(s.spec.sensors, &SensorSpec::draws);
}

}  // namespace floorproof

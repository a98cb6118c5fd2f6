// SPDX-License-Identifier: Apache-2.0
// Scenarios written in a test, and driven.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "run/episode/episode.h"
#include "run/episode/execute.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario_file.h"
#include "tests/own_folder.h"

namespace floorproof {

class ScenarioTest : public OwnFolderTest {
 protected:
  Scenario Read(const std::string& text, const std::vector<Override>& overrides = {}) const {
    return ReadScenario(Save("scenario.yaml", text), overrides, Trust::kFull);
  }
  static EpisodeRecord Drive(const Scenario& scenario, EpisodeObserver* observer = nullptr) {
    const Execution execution = Execute(scenario, observer);
    EXPECT_EQ(execution.plan.status, PlanStatus::kSuccess) << execution.plan.message;
    return execution.record;
  }
  // With agents of the test's own among them.
  static EpisodeRecord DriveWith(const Scenario& s, Agents& agents,
                                 EpisodeObserver* observer = nullptr) {
    const PlanResult plan = MakePlan(s);
    return RunEpisode(s, agents,
                      BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start),
                      plan, observer);
  }
};

// A room of 8 m x 4 m inside its walls, its lower left free corner at (0.5, 0.5), with these
// hazards (a YAML list's inside) and this plan (rows of plan.csv's x_m,y_m).
inline std::string RoomScenario(const std::string& hazards, const std::string& more = "") {
  std::string rows = "      " + std::string(18, '#') + "\n";
  for (int i = 0; i < 8; ++i) rows += "      #" + std::string(16, '.') + "#\n";
  rows += "      " + std::string(18, '#') + "\n";
  return "scenario: 1\nsite:\n  site: 1\n  name: room\n  grid:\n    cell_m: 0.5\n    rows: |\n" +
         rows + "  start: {x_m: 1.5, y_m: 2.5, yaw_deg: 0}\n  hazards: [" + hazards +
         "]\nrobot: beluga\nplan: {file: plan.csv}\n" + more;
}

}  // namespace floorproof

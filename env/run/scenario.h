// SPDX-License-Identifier: Apache-2.0
// A scenario file, read whole: site, robot, plug-ins, limits.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "controllers/estimator.h"
#include "controllers/tracker.h"
#include "env/core/config.h"
#include "env/failures/detector.h"
#include "env/map/site.h"
#include "env/run/scenario_params.h"
#include "env/scene/robot_model.h"
#include "env/scene/scene.h"
#include "planners/planner.h"

namespace floorproof {

struct Scenario {
  std::filesystem::path file;
  std::string name;  // the key `name`, else the file's stem
  Site site;
  std::filesystem::path site_file;    // empty: the site stands in the scenario
  ConfigNode site_node;               // the site's tree, overrides applied
  std::filesystem::path site_folder;  // that its paths are relative to

  std::string robot_name;
  RobotChanges robot_changes;
  std::filesystem::path robot_file;
  RobotModel robot;

  Pose2 start;
  std::optional<Vec2> goal;

  std::string planner_name;  // empty: plan_file
  std::unique_ptr<Planner> planner;
  std::filesystem::path plan_file;
  Path user_plan;  // what it holds

  std::string tracker_name, estimator_name;
  std::unique_ptr<Tracker> tracker;
  std::unique_ptr<Estimator> estimator;
  std::vector<std::unique_ptr<Detector>> detectors;
  PhysicsParams physics;
  Battery battery;  // its voltage set, if only by the robot
  EpisodeParams episode;
  VideoParams video;
};

struct Override {
  std::string key_path, value;  // --set key.path=value; the value is YAML
};

// Reads the file, applies the overrides (keys below `site.` reach into the site file) and checks
// all of it. Throws InputError naming file, line, key, value and rule.
Scenario ReadScenario(const std::filesystem::path& file,
                      const std::vector<Override>& overrides = {});

// The files it was read from, beside its own: site, map, image, robot, plan.
std::vector<std::filesystem::path> FilesRead(const Scenario& scenario);

// The scenario with every default stated, the site in it, paths valid from `folder` and the SHA-256
// of each file read. Reading it gives the same scenario; resolving it again gives the same text.
std::string ResolvedScenario(const Scenario& scenario, const std::filesystem::path& folder);

}  // namespace floorproof

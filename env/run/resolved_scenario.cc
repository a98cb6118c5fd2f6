// SPDX-License-Identifier: Apache-2.0
// A scenario written out with every default stated, so that it survives a change of defaults.
#include <algorithm>

#include "env/run/file_output.h"
#include "env/run/scenario.h"

namespace floorproof {

namespace fs = std::filesystem;

std::string ResolvedScenario(const Scenario& s, const fs::path& folder) {
  const auto scalar = [](double v) { return ConfigNode::Scalar(FormatDouble(v)); };
  const auto from_here = [&](const fs::path& path) {
    return fs::relative(fs::absolute(path), fs::absolute(folder)).string();
  };
  ConfigNode root = ConfigNode::Map();
  root.Add("scenario", ConfigNode::Scalar("1"));
  root.Add("name", ConfigNode::Scalar(s.name, true));
  root.Add("site", ResolveSite(s.site_node, s.site_folder, folder));
  root.Find("site")->Add("name", ConfigNode::Scalar(s.site.map.name, true));

  ConfigNode robot = ConfigNode::Map();
  const bool bundled =
      std::ranges::any_of(Robots(), [&](const auto& r) { return r.name == s.robot_name; });
  robot.Add("name", ConfigNode::Scalar(bundled ? s.robot_name : from_here(s.robot_file), true));
  RobotChanges changes = s.robot_changes;
  WriteParams([&](ParamVisitor& v) { changes.Visit(v); }, robot);
  root.Add("robot", std::move(robot));

  ConfigNode start = ConfigNode::Map();
  start.Add("x_m", scalar(s.start.x_m));
  start.Add("y_m", scalar(s.start.y_m));
  start.Add("yaw_deg", scalar(CanonicalDegrees(s.start.yaw_rad * 180 / kPi)));
  root.Add("start", std::move(start));
  if (s.goal) {
    ConfigNode goal = ConfigNode::Map();
    goal.Add("x_m", scalar(s.goal->x()));
    goal.Add("y_m", scalar(s.goal->y()));
    root.Add("goal", std::move(goal));
  }

  ConfigNode plan = ConfigNode::Map();
  if (s.planner) {
    plan.Add("planner", ConfigNode::Scalar(s.planner_name, true));
    WriteParams(*s.planner, plan);
  } else {
    plan.Add("file", ConfigNode::Scalar(from_here(s.plan_file), true));
  }
  root.Add("plan", std::move(plan));

  const auto plugin = [](const std::string& name, Configurable& c) {
    ConfigNode node = ConfigNode::Map();
    node.Add("name", ConfigNode::Scalar(name, true));
    WriteParams(c, node);
    return node;
  };
  root.Add("controller", plugin(s.tracker_name, *s.tracker));
  root.Add("estimator", plugin(s.estimator_name, *s.estimator));
  ConfigNode failures = ConfigNode::Map();
  for (std::size_t i = 0; i < s.detectors.size(); ++i) {
    ConfigNode params = ConfigNode::Map();
    WriteParams(*s.detectors[i], params);
    failures.Add(std::string(Detectors()[i].name), std::move(params));
  }
  root.Add("failures", std::move(failures));

  EpisodeParams episode = s.episode;
  WriteParams([&](ParamVisitor& v) { episode.Visit(v); }, root);
  ConfigNode battery = ConfigNode::Map();
  Battery battery_params = s.battery;
  WriteParams([&](ParamVisitor& v) { battery_params.Visit(v); }, battery);
  root.Add("battery", std::move(battery));
  ConfigNode physics = ConfigNode::Map(), video = ConfigNode::Map();
  PhysicsParams physics_params = s.physics;
  WriteParams([&](ParamVisitor& v) { physics_params.Visit(v); }, physics);
  root.Add("physics", std::move(physics));
  VideoParams video_params = s.video;
  WriteParams([&](ParamVisitor& v) { video_params.Visit(v); }, video);
  root.Add("video", std::move(video));

  // What reading this file again will read: the site now stands within it.
  ConfigNode files = ConfigNode::Map();
  const auto add_file = [&](const fs::path& path) {
    files.Add(from_here(path), ConfigNode::Scalar(Sha256OfFile(path), true));
  };
  for (const auto& path : s.site.files_read) add_file(path);
  add_file(s.robot_file);
  if (!s.plan_file.empty()) add_file(s.plan_file);
  root.Add("files", std::move(files));
  return "# Every key with the value used. Paths hold from this folder.\n" + WriteYaml(root);
}

}  // namespace floorproof

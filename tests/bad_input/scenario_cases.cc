// SPDX-License-Identifier: Apache-2.0
// Scenarios whose YAML is fine and whose keys or values are not.
#include <sys/stat.h>

#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

const std::string kFile = "floorproof: scenario.yaml";

BadInput Changed(const std::string& name, const std::string& from, const std::string& to,
                 std::vector<std::string> named) {
  return {name,
          {"run", "scenario.yaml", "--out", "o"},
          {{"scenario.yaml", Replaced(GoodFiles().at("scenario.yaml"), from, to)}},
          std::move(named)};
}
// The scenario has 12 lines; this is the 13th.
BadInput Added(const std::string& name, const std::string& line, std::vector<std::string> named) {
  return {name,
          {"run", "scenario.yaml", "--out", "o"},
          {{"scenario.yaml", GoodFiles().at("scenario.yaml") + line + "\n"}},
          std::move(named)};
}
BadInput With(BadInput bad, std::function<bool(const fs::path&)> prepare) {
  bad.prepare = std::move(prepare);
  return bad;
}
std::function<bool(const fs::path&)> Link(const std::string& to, const std::string& at) {
  return [=](const fs::path& folder) {
    std::error_code error;
    fs::create_symlink(to, folder / at, error);
    return !error;
  };
}

}  // namespace

std::vector<BadInput> ScenarioCases() {
  const std::string out = "../";
  return {
      Changed("NoVersion", "scenario: 1\n", "", {kFile + ":1", "scenario", "missing"}),
      Changed("VersionTwo", "scenario: 1", "scenario: 2", {kFile + ":1: scenario = 2", "must be"}),
      Changed("UnknownKey", "robot: beluga", "robt: beluga",
              {kFile + ":3: robt", "unknown key; did you mean robot?"}),
      Changed("UnknownKeyBelow", "camera: top", "fpps: 30",
              {kFile + ":12: video.fpps", "unknown key; did you mean fps?"}),
      Changed("UnknownKeyOfAPlugin", "regulated_pursuit}", "regulated_pursuit, lookahed_m: 1}",
              {kFile + ":6: controller.lookahed_m", "unknown key"}),
      Changed("ALoneWordForAMap", "{camera: top}", "top", {kFile + ":12: video = top", "map"}),
      Changed("TextForANumber", "seed: 3", "seed: three", {kFile + ":11: seed = three", "whole"}),
      Changed("AFractionForAWhole", "seed: 3", "seed: 3.5", {kFile + ":11: seed = 3.5", "whole"}),
      Changed("AListForANumber", "seed: 3", "seed: [3]", {kFile + ":11: seed = [...]", "whole"}),
      Changed("AQuotedNumber", "seed: 3", "seed: \"3\"", {kFile + ":11: seed = 3", "whole"}),
      Changed("NegativeSeed", "seed: 3", "seed: -1", {kFile + ":11: seed = -1", "[0, 2147483647]"}),
      Changed("SeedBeyondInt", "seed: 3", "seed: 4294967296",
              {kFile + ":11: seed = 4294967296", "[0, 2147483647]"}),
      Changed("SeedBeyondAnyNumber", "seed: 3", "seed: 99999999999999999999999999",
              {kFile + ":11: seed = 9999", "whole number"}),
      Changed("NotANumber", "time_limit_s: 100", "time_limit_s: .nan",
              {kFile + ":10: time_limit_s = .nan", "number"}),
      Changed("Infinite", "time_limit_s: 100", "time_limit_s: inf",
              {kFile + ":10: time_limit_s = inf", "finite"}),
      Changed("BeyondDouble", "time_limit_s: 100", "time_limit_s: 1e999",
              {kFile + ":10: time_limit_s = 1e999", "number"}),
      Changed("NegativeTime", "time_limit_s: 100", "time_limit_s: -5",
              {kFile + ":10: time_limit_s = -5", "must be > 0"}),
      Changed("CoverageAboveOne", "min_coverage: 0.1", "min_coverage: 95",
              {kFile + ":9: success.min_coverage = 95", "[0, 1]"}),
      Added("NoControl", "control_hz: 0", {kFile + ":13: control_hz = 0", "[1, 2000]"}),
      Added("UnevenControl", "control_hz: 7", {kFile + ":13: control_hz = 7", "whole number"}),
      Added("UnevenTrace", "trace_hz: 7", {kFile + ":13: trace_hz = 7", "divide"}),
      Added("NoTimeStep", "physics: {timestep_s: 0}", {kFile + ":13: physics.timestep_s = 0"}),
      Added("NoVoltage", "battery: {voltage_v: 0}", {kFile + ":13: battery.voltage_v = 0"}),
      Added("UnknownBatteryKey", "battery: {voltage: 12}",
            {kFile + ":13: battery.voltage", "voltage_v"}),
      Added("UnknownDrive", "drive: fast", {kFile + ":13: drive = fast", "physics"}),
      Changed("NoSite", "site: site.yaml\n", "", {kFile + ":1: site", "missing"}),
      Changed("MissingSite", "site.yaml", "sight.yaml",
              {kFile + ":2: site = sight.yaml", "no such file"}),
      Changed("SiteIsAFolder", "site.yaml", ".", {kFile + ":2: site = .", "folder"}),
      Changed("SiteIsTheScenario", "site.yaml", "scenario.yaml",
              {"floorproof: scenario.yaml: is a scenario, not a site"}),
      Trusted(Changed("SiteIsADevice", "site.yaml", "/dev/zero",
                      {kFile + ":2: site = /dev/zero", "a pipe or a device"})),
      With(Changed("SiteIsAPipe", "site.yaml", "pipe", {kFile + ":2: site = pipe", "a pipe or"}),
           [](const fs::path& folder) { return mkfifo((folder / "pipe").c_str(), 0600) == 0; }),
      With(Changed("SiteIsALoopOfLinks", "site.yaml", "loop.yaml",
                   {kFile + ":2: site = loop.yaml", "cannot be read", "symbolic links"}),
           Link("loop.yaml", "loop.yaml")),
      With(Changed("SiteIsALinkToNothing", "site.yaml", "dangling.yaml",
                   {kFile + ":2: site = dangling.yaml", "no such file"}),
           Link("nothing.yaml", "dangling.yaml")),
      Changed("SiteNameTooLong", "site.yaml", std::string(5000, 'x'),
              {kFile + ":2: site = xxx", "cannot be read", "too long"}),
      Changed("SiteClimbsOut", "site.yaml", "a/../../site.yaml",
              {kFile + ":2: site = a/../../site.yaml", "leaves its folder"}),
      Trusted(Changed("SiteClimbsToNothing", "site.yaml", "../../../../../../nothing/site.yaml",
                      {kFile + ":2: site = ../../", "no such file"})),
      Changed("UnknownRobot", "robot: beluga", "robot: belga",
              {kFile + ":3: robot = belga", "did you mean beluga?"}),
      Changed("NoRobot", "robot: beluga\n", "", {kFile + ":1: robot", "missing"}),
      Changed("NegativeMass", "robot: beluga", "robot: {name: beluga, mass_kg: -1}",
              {kFile + ":3: robot.mass_kg = -1", "must be in [0.01, 10000]"}),
      Changed("UnknownPlanner", "{file: plan.csv}", "{planner: boustrofedon}",
              {kFile + ":5: plan.planner = boustrofedon", "did you mean boustrophedon?"}),
      Changed("UnknownTracker", "regulated_pursuit", "regulated_persuit",
              {kFile + ":6: controller = regulated_persuit", "did you mean regulated_pursuit?"}),
      Changed("UnknownEstimator", "estimator: truth", "estimator: trust",
              {kFile + ":7: estimator = trust", "did you mean truth?"}),
      Changed("UnknownDetector", "{stuck: {}}", "{stuk: {}}",
              {kFile + ":8: failures.stuk", "did you mean stuck?"}),
      Changed("UnknownCamera", "camera: top", "camera: front",
              {kFile + ":12: video.camera = front", "auto"}),
      Changed("StartInAWall", "x_m: 1.0, y_m: 1.0", "x_m: 0.1, y_m: 1.0",
              {kFile + ":4: start = 0.1, 1", "lies in a wall"}),
      Changed("StartOffTheMap", "x_m: 1.0, y_m: 1.0", "x_m: 100, y_m: 1.0",
              {kFile + ":4: start = 100, 1", "lies off the map"}),
      Changed("StartBeyondAnyCell", "x_m: 1.0", "x_m: 1e300", {kFile + ":4: start", "1e+300"}),
      Changed("StartNotANumber", "x_m: 1.0", "x_m: .nan", {kFile + ":4: start.x_m = .nan"}),
      Changed("NoStart", "start: {x_m: 1.0, y_m: 1.0, yaw_deg: 0}\n", "",
              {kFile + ":1: start", "where to start"}),
      Added("GoalOffTheMap", "goal: {x_m: -3, y_m: 1}",
            {kFile + ":13: goal = -3, 1", "lies off the map"}),
      Added("AFileThatHasChanged", "files: {site.yaml: \"00\"}",
            {kFile + ":13: files.site.yaml = 00", "has changed"}),
      Trusted(Added("AHashOfADevice", "files: {/dev/zero: \"00\"}",
                    {kFile + ":13: files./dev/zero", "a pipe or a device"})),
  };
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Command lines, and folders that cannot be written to.
#include <sys/stat.h>
#include <unistd.h>

#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

BadInput Words(const std::string& name, std::vector<std::string> arguments,
               std::vector<std::string> named, std::function<bool(const fs::path&)> prepare = {}) {
  return {name, std::move(arguments), {}, std::move(named), std::move(prepare)};
}
// A folder that looks like a finished run's, with this in result.json.
BadInput Replayed(const std::string& name, const std::string& result,
                  std::vector<std::string> named) {
  return {name,
          {"replay", "."},
          {{"scenario.resolved.yaml", GoodFiles().at("drawn.yaml")}, {"result.json", result}},
          std::move(named)};
}

}  // namespace

std::vector<BadInput> CommandCases() {
  const std::string run = "run", s = "scenario.yaml";
  return {
      Words("None", {}, {"--help"}),
      Words("UnknownCommand", {"rum", s}, {"rum", "unknown command; did you mean run?"}),
      Words("UnknownOption", {run, s, "--vidoe"},
            {"--vidoe", "unknown option; did you mean --video?"}),
      Words("LongCommand", {std::string(100'000, 'x')}, {"xxx...: unknown command"}),
      Words("LongOption", {run, "--" + std::string(100'000, 'x')}, {"xxx...: unknown option"}),
      Words("LongPath", {run, std::string(5'000, 'x') + "/a.yaml"}, {"xxx...xxx", "xxx/a.yaml: "}),
      Words("LongSeed", {run, s, "--seed", std::string(100'000, 'x')},
            {"--seed", "xxx...", "not in range 0 to"}),
      Words("LongSeedInOneWord", {run, s, "--seed=" + std::string(100'000, 'x')},
            {"--seed", "xxx...", "not in range 0 to"}),
      Words("LongArgumentTooMany", {run, s, std::string(100'000, 'x')}, {"xxx..."}),
      Words("LongKind", {"list", std::string(100'000, 'x')}, {"KIND", "xxx... not in"}),
      Words("ManyArgumentsTooMany",
            [] {
              std::vector<std::string> words = {"run", "scenario.yaml"};
              for (int i = 0; i < 10'000; ++i) words.push_back("word" + std::to_string(i));
              return words;
            }(),
            {"not expected: word9999", "..."}),
      Words("ArgumentThatTurnsAndColours", {run, s, "--seed", "a\u202e\u2028\u009bgnp\x1b[31m\nb"},
            {"a???gnp?[31m b"}),
      Words("NoScenario", {run}, {"SCENARIO"}),
      Words("TwoScenarios", {run, s, s}, {s}),
      Words("OptionWithoutValue", {run, s, "--out"}, {"--out"}),
      Words("SeedInWords", {run, s, "--seed", "three"}, {"--seed", "three"}),
      Words("NegativeSeed", {run, s, "--seed", "-1"}, {"--seed"}),
      Words("SeedBeyondInt", {run, s, "--seed", "99999999999"}, {"--seed"}),
      Words("SetWithoutEquals", {run, s, "--set", "seed"}, {"--set", "seed", "must be KEY=VALUE"}),
      Words("SetWithoutKey", {run, s, "--set", "=3"}, {"--set", "=3", "must be KEY=VALUE"}),
      Words("SetUnknownKey", {run, s, "--set", "sed=3"},
            {"--set sed:1: sed", "did you mean seed?"}),
      Words("SetBelowAValue", {run, s, "--set", "seed.a=3"}, {"--set seed.a", "below a value"}),
      Words("SetEmptyKey", {run, s, "--set", "video..fps=3"}, {"--set video..fps", "empty key"}),
      Words("SetNoYaml", {run, s, "--set", "seed=[1"}, {"--set seed", "bad YAML"}),
      Words("SetOutOfRange", {run, s, "--set", "video.fps=9999"},
            {"--set video.fps:1: video.fps = 9999", "[1, 120]"}),
      Words("SetOfTheSite", {run, s, "--set", "site.floor.friction=9"},
            {"--set site.floor.friction:1: floor.friction = 9", "(0, 5]"}),
      Words("ListOfNothing", {"list", "planers"}, {"planers"}),
      Words("SchemaOfNothing", {"schema", "robot"}, {"KIND", "robot"}),
      Words("MissingScenario", {run, "no.yaml"}, {"no.yaml: no such file"}),
      Words("ScenarioIsAFolder", {run, "."}, {"a folder"}),
      Words("ScenarioIsADevice", {run, "/dev/zero"}, {"/dev/zero: is a pipe or a device"}),
      Words("ScenarioIsStdin", {run, "/dev/stdin"}, {"/dev/stdin: is a pipe or a device"}),
      Words(
          "ScenarioIsAPipe", {run, "pipe.yaml"}, {"pipe.yaml: is a pipe or a device"},
          [](const fs::path& folder) { return mkfifo((folder / "pipe.yaml").c_str(), 0600) == 0; }),
      Words("ScenarioIsALoop", {run, "loop.yaml"}, {"loop.yaml: cannot be read"},
            [](const fs::path& folder) {
              std::error_code error;
              fs::create_symlink("loop.yaml", folder / "loop.yaml", error);
              return !error;
            }),
      Words("ScenarioNotPermitted", {run, s}, {"scenario.yaml: cannot be read: Permission denied"},
            [](const fs::path& folder) {
              return geteuid() != 0 && chmod((folder / "scenario.yaml").c_str(), 0) == 0;
            }),
      Words("ScenarioIsAnImage", {run, "map.png"},
            {"map.png: is an image, not a scenario", "floorproof init"}),
      Words("ScenarioIsASite", {run, "site.yaml"},
            {"site.yaml:", "is a site, not a scenario", "floorproof init"}),
      Words("OutIsAFile", {run, s, "--out", s}, {"scenario.yaml: cannot make this folder"}),
      Words("OutIsBelowAFile", {run, s, "--out", "map.pgm/o"},
            {"map.pgm/o: cannot make this folder"}),
      Words("OutCannotBeMade", {run, s, "--out", "/proc/floorproof"},
            {"/proc/floorproof: cannot make this folder"}),
      Words("OutNameTooLong", {run, s, "--out", std::string(300, 'o')},
            {"cannot make this folder"}),
      Words("OutIsReadOnly", {run, s, "--out", "shut"}, {"shut/", "cannot be written"},
            [](const fs::path& folder) {
              fs::create_directory(folder / "shut");
              return geteuid() != 0 && chmod((folder / "shut").c_str(), 0500) == 0;
            }),
      Words("AFolderInTheResultsPlace", {run, "drawn.yaml", "--out", "o"},
            {"o/result.json: is no plain file", "name another folder, or move the file away"},
            [](const fs::path& folder) {
              return fs::create_directories(folder / "o/result.json/x");
            }),
      Words("PlanCannotBeWritten", {"plan", "drawn.yaml", "--out", "o"},
            {"o/scenario.resolved.yaml: is no plain file",
             "name another folder, or move the file away"},
            [](const fs::path& folder) {
              return fs::create_directories(folder / "o/scenario.resolved.yaml");
            }),
      Words("SceneIntoNothing", {"scene", "drawn.yaml", "--out", "no/scene.xml"},
            {"no/scene.xml: cannot be written"}),
      Words("SceneIsAFolder", {"scene", "drawn.yaml", "--out", "."},
            {"cannot be written", "folder"}),
      Words("InitOfNothing", {"init", "no.yaml"}, {"no.yaml: no such file"}),
      Words("InitOfASite", {"init", "site.yaml"}, {"site.yaml: is a site, not a ROS map"}),
      Words("InitOfAnUnknownRobot", {"init", "map.yaml", "--robot", "belga"},
            {"--robot", "belga", "did you mean beluga?"}),
      Words("InitOntoAFile", {"init", "map.yaml", "--out", "map.pgm"}, {"map.pgm: cannot make"}),
      {"InitOfAFloorTooSmall",
       {"init", "map.yaml", "--out", "o"},
       {{"map.yaml", Replaced(GoodFiles().at("map.yaml"), "0.5", "0.05")}},
       {"map.yaml", "no place for a robot"}},
      Words("MeasureOfAnUnknownRobot", {"measure", "belga"}, {"ROBOT", "did you mean beluga?"}),
      Words("MeasureOfNoEpisodes", {"measure", "beluga", "-n", "2", "--episodes", "1:1"},
            {"--episodes", "1:1", "holds no episode"}),
      Words("MeasureThatSetsNothing",
            {"measure", "beluga", "--set", "site.generate.angel_deg=3", "--out", "o"},
            {"site.generate.angel_deg", "did you mean angle_deg?"}),
      Words("SuiteOfAnUnknownRobot", {"suite", "belga"}, {"ROBOT", "did you mean beluga?"}),
      Words("SuiteOfOneRobotTwice", {"suite", "beluga", "beluga"}, {"ROBOT", "beluga"}),
      Words("SuiteOfAnUnknownMethod", {"suite", "beluga", "--methods", "stp"},
            {"--methods", "stp", "did you mean step?"}),
      Words("SuiteWithoutAMethod", {"suite", "beluga", "--methods", "step,"}, {"--methods"}),
      Words("SuiteOfFullReliability", {"suite", "beluga", "--reliability", "1"},
            {"reliability = 1", "must lie between 0 and 1"}),
      Words("SuiteOfNoConfidence", {"suite", "beluga", "--confidence", "0"},
            {"confidence = 0", "must lie between 0 and 1"}),
      Words("SuiteThatRequiresWords", {"suite", "beluga", "--require", "step=high"},
            {"--require", "step=high", "a number above 0"}),
      Words("SuiteThatRequiresTheSizeless", {"suite", "beluga", "--require", "obstacle=1"},
            {"--require", "obstacle=1", "neither sizes nor a figure"}),
      Words("SuiteThatRequiresTheUnasked",
            {"suite", "beluga", "--methods", "sill", "--require", "step=1"},
            {"--require", "step=1", "not among --methods"}),
      Words("SuiteThatAsksNothing", {"suite", "scrubber", "--methods", "obstacle,obstacle_glass"},
            {"--methods", "obstacle,obstacle_glass", "nothing of this can be asked of scrubber",
             "turn on the spot"}),
      Words("SuiteThatSetsNothing",
            {"suite", "beluga", "--methods", "sill", "--set", "robot.mas=3", "--out", "o"},
            {"--set robot.mas:1: robot.mas", "did you mean mass_kg?"}),
      Words("ReplayOfNothing", {"replay", "no"}, {"no/scenario.resolved.yaml", "no such file"}),
      Words("ReplayOfAPlanAlone", {"replay", "."}, {"no such file", "not a folder of a finished"}),
      Replayed("ReplayOfBrokenJson", "{\"outcome\": ", {"result.json", "is not a result"}),
      Replayed("ReplayOfAJsonList", "[1, 2]", {"result.json", "is not a result"}),
      Replayed("ReplayOfNestedJson",
               "{\"drawn\": " + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}",
               {"result.json", "is not a result", "nested more than 100 levels deep"}),
  };
}

}  // namespace floorproof

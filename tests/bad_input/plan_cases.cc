// SPDX-License-Identifier: Apache-2.0
#include <sys/stat.h>

#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

BadInput Plan(const std::string& name, const std::string& text, std::vector<std::string> named) {
  named.insert(named.begin(), "plan.csv");
  return {name, {"run", "scenario.yaml", "--out", "o"}, {{"plan.csv", text}}, std::move(named)};
}
BadInput File(const std::string& name, const std::string& file, std::vector<std::string> named,
              std::function<bool(const std::filesystem::path&)> prepare = {}) {
  return {name,
          {"run", "scenario.yaml", "--out", "o"},
          {{"scenario.yaml", Replaced(GoodFiles().at("scenario.yaml"), "plan.csv", file)}},
          std::move(named),
          std::move(prepare)};
}

BadInput Command(const std::string& name, const std::string& keys, std::vector<std::string> named) {
  named.insert(named.begin(), "scenario.yaml:5");
  return {name,
          {"run", "scenario.yaml", "--trust", "--out", "o"},
          {{"scenario.yaml",
            Replaced(GoodFiles().at("scenario.yaml"), "file: plan.csv", "command: " + keys)},
           {"no.sh", "#!/bin/sh\n"}},
          std::move(named)};
}

}  // namespace

std::vector<BadInput> PlanCases() {
  const std::string head = "x_m,y_m,speed_mps,dwell_s\n";
  return {
      Plan("Empty", "", {"holds no waypoint"}),
      Plan("HeaderAlone", head, {"holds no waypoint"}),
      Plan("NoHeader", "1.0,1.0\n1.5,1.0\n", {":1: is no row of column names", "x_m,y_m"}),
      Plan("UnknownColumn", "x_m,y_m,sped_mps\n1,1,1\n",
           {":1: sped_mps", "did you mean speed_mps?"}),
      Plan("NoYColumn", "x_m,yaw_rad\n1,1\n", {":1: y_m", "missing"}),
      Plan("TheSameColumnTwice", "x_m,y_m,x_m\n1,1,1\n", {":1: x_m", "twice"}),
      Plan("TextForANumber", head + "1,1,,\none,1,,\n", {":3: x_m = one", "must be a number"}),
      Plan("NotANumber", head + "1,nan,,\n", {":2: y_m = nan", "finite"}),
      Plan("Infinite", head + "inf,1,,\n", {":2: x_m = inf", "finite"}),
      Plan("AnEmptyCell", head + "1,,,\n", {":2: y_m", "must be a number"}),
      Plan("TooFewColumns", head + "1,1\n", {":2", "has 2 columns, the first row 4"}),
      Plan("TooManyColumns", head + "1,1,,,5\n", {":2", "has 5 columns, the first row 4"}),
      Plan("Semicolons", "x_m;y_m\n1;1\n", {":1", "by semicolons: must be by commas"}),
      Plan("SemicolonsBelowTheHead", head + "1;1;;\n", {":2", "by semicolons: must be by commas"}),
      Plan("OffTheMap", head + "1,1,,\n1,40,,\n", {":3: x_m, y_m = 1, 40", "lies off the map"}),
      Plan("BeyondAnyCell", head + "1e300,1,,\n", {":2: x_m, y_m = 1e+300", "lies off the map"}),
      Plan("NegativeSpeed", head + "1,1,-0.2,\n", {":2: speed_mps = -0.2", "must be >= 0"}),
      Plan("ASpeedThatNeverArrives", head + "1,1,1e-9,\n",
           {":2: speed_mps = 1e-09", "at least 0.001"}),
      Plan("AnEndlessStand", head + "1,1,,1e12\n", {":2: dwell_s = 1e+12", "[0, 1e+05]"}),
      Plan("AShapeOfControlCharacters", std::string("x_m,y_m,shape\n1,1,\x1b[2J\n"),
           {":2: shape", "letters"}),
      Plan("AShapeOfARobotThatHasOne", "x_m,y_m,shape\n1,1,I\n",
           {":2: shape = I", "does not change its shape"}),
      Plan("Binary", std::string("\0\1\2\3\xff\xfe\0\0", 8), {":1", "no row of column names"}),
      Plan("ALongLine", std::string(8'000'000, 'x') + "\n", {":1: is no row of column names"}),
      File("MissingFile", "plans.csv", {"scenario.yaml:5: plan.file = plans.csv", "no such file"}),
      File("OutOfReach", "/etc/passwd",
           {"scenario.yaml:5: plan.file = /etc/passwd", "lies outside the scenario's folder"}),
      File("AFolder", ".", {"scenario.yaml:5: plan.file = .", "a folder"}),
      Trusted(File("ADevice", "/dev/zero", {"scenario.yaml:5: plan.file = /dev/zero", "a device"})),
      File("APipe", "pipe", {"scenario.yaml:5: plan.file = pipe", "a pipe or a device"},
           [](const std::filesystem::path& folder) {
             return mkfifo((folder / "pipe").c_str(), 0600) == 0;
           }),
      File("ClimbsOut", "x/../../plan.csv",
           {"scenario.yaml:5: plan.file = x/../../plan.csv", "leaves its folder"}),
      Command("ACommandThatIsNoList", "./cover.py", {"plan.command = ./cover.py", "list of words"}),
      Command("ACommandOfMaps", "[{a: b}]", {"plan.command", "must be text"}),
      Command("AnEmptyCommand", "[]", {"plan.command", "the program first"}),
      Command("ACommandWithoutAProgram", "[\"\", a]", {"plan.command", "begin with a program"}),
      Command("ACommandBesideAPlanner", "[sh], planner: spiral",
              {"plan.planner = spiral", "stands beside plan.command"}),
      Command("ACommandBesideAFile", "[sh], file: plan.csv",
              {"plan.file = plan.csv", "stands beside plan.command"}),
      Command("ACommandWithoutTime", "[sh], timeout_s: 0", {"plan.timeout_s = 0", "must be"}),
      Command("ACommandOfAnotherKey", "[sh], timeout: 5",
              {"plan.timeout", "did you mean timeout_s?"}),
      Command("ACommandInNoFolder", "[sh], folder: elsewhere",
              {"plan.folder = ", "elsewhere", "no such folder"}),
      Command("NoSuchProgram", "[./cover.py]", {"plan.command = ./cover.py", "no such program"}),
      Command("NoSuchProgramInPath", "[no.such.program]",
              {"plan.command = no.such.program", "named ./no.such.program"}),
      Command("AProgramThatIsAFolder", "[./]", {"plan.command = ./", "is a folder"}),
      Command("AProgramThatCannotBeRun", "[./no.sh]", {"plan.command = ./no.sh", "chmod +x"}),
      Command("ACommandWhosePlanIsGone", "[sh], made: inputs/0",
              {"plan.made = inputs/0", "no such file"}),
      File("IsAMap", "map.pgm", {"map.pgm:1: is no row of column names"}),
  };
}

}  // namespace floorproof

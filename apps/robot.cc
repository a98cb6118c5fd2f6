// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/result_folder.h"
#include "report/robot_picture.h"
#include "report/robot_report.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPicture = ".robot.png";

ResultNames RobotPictures() {
  return {"robot", [](std::string_view name) { return name.ends_with(kPicture); }};
}

// Where the robot's MJCF is, or would be.
fs::path OutFile(const std::string& out, const fs::path& file) {
  if (out.empty()) return fs::path("out/robot") / (file.stem().string() + ".xml");
  if (fs::path(out).extension() != ".xml")
    throw InputError({"--out", 0}, "", out, "must end in .xml; the picture goes beside it");
  return out;
}

}  // namespace

void AddRobot(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string file, out;
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add(
      "robot", "Check a robot: what it is, from three sides, and ten seconds of its drive");
  command.Text("FILE", options->file, "A robot's MJCF, or a name of `floorproof list robots`",
               Subcommand::Need::kRequired);
  command.Text("--out", options->out,
               "The picture goes beside this .xml (default: out/robot/NAME.xml)");
  command.OnRun([options, &globals, &status] {
    const fs::path file = FindRobotFile(options->file, {"FILE", 0});
    const RobotModel robot = ReadRobot(file);
    const fs::path out = OutFile(options->out, file);
    const fs::path folder = out.has_parent_path() ? out.parent_path() : ".";
    ResultFolder results(folder, RobotPictures(), robot.files);
    const RobotCheck check = CheckRobot(file.string());
    const fs::path picture = folder / (out.stem().string() + std::string(kPicture));
    results.Begin();
    WritePng(picture, DrawRobot(check, PartsOf(robot)));
    SayWhenInterrupted(picture.string() + " is there");
    for (const std::string& said : RobotLines(check)) globals.Say(said);
    globals.Say("picture: " + picture.string());
    globals.Result(RobotJson(check));
    if (!check.ok()) status = kNotSuccess;
  });
}

}  // namespace floorproof

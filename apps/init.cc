// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "env/map/init_files.h"

namespace floorproof {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxRobotBytes = 64u << 20, kMaxTextBytes = 3u << 20;

// Canonical, since ../ in a path through a symbolic link would lead elsewhere.
std::string PathFrom(const fs::path& folder, const fs::path& file) {
  return fs::weakly_canonical(fs::absolute(file))
      .lexically_relative(fs::weakly_canonical(fs::absolute(folder)))
      .string();
}

// What a user has changed, or made of another map, stays; to drive it in this map's name would
// mislead.
void RefuseOther(const fs::path& file, const std::string& text) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored))) return;
  if (!WhyUnreadable(file, kMaxTextBytes).empty() || ReadInputFile(file, kMaxTextBytes) != text)
    throw InputError({file.string(), 0}, "", "",
                     "is there already, changed or of another map or robot: --out names another "
                     "folder");
}

}  // namespace

void AddInit(CommandLine& line, const Globals& globals, int&) {
  struct Options {
    std::string map, robot = "beluga", out = ".";
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add(
      "init", "Write site.yaml and scenario.yaml for your own ROS map, commented and runnable");
  command.Text("MAP", options->map, "map.yaml of a ROS map_server map",
               Subcommand::Need::kRequired);
  command.TextWithDefault("--robot", options->robot,
                          "A name of `floorproof list robots`, or an MJCF");
  command.TextWithDefault(
      "--out", options->out,
      "Folder to write into; what is changed or another map's there is refused");
  command.OnRun([options, &globals] {
    const auto robot_file = FindRobotFile(options->robot, {"--robot", 0});
    if (const std::string why = WhyUnreadable(robot_file, kMaxRobotBytes); !why.empty())
      throw InputError({"--robot", 0}, "", options->robot,
                       why + ": " + fs::absolute(robot_file).string());
    const RobotModel robot = ReadRobot(robot_file);
    const fs::path folder = options->out;
    const bool bundled = robot_file != options->robot;
    const InitFiles files = MakeInitFiles(options->map, robot.spec, folder,
                                          bundled ? options->robot : PathFrom(folder, robot_file));
    const std::pair<fs::path, const std::string*> written[] = {
        {folder / "site.yaml", &files.site_yaml}, {folder / "scenario.yaml", &files.scenario_yaml}};
    for (const auto& [file, text] : written) RefuseOther(file, *text);
    for (const auto& warning : files.warnings) globals.Say("warning: " + warning);
    MakeFolder(folder);
    for (const auto& [file, text] : written) {
      WriteFileWhole(file, *text);
      SayWhenInterrupted(file.string() + " is there");
      globals.Say(file.string() + " written");
    }
    globals.Say("next: floorproof run " + (folder / "scenario.yaml").string() + " --video");
  });
}

}  // namespace floorproof

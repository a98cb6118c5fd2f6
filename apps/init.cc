// SPDX-License-Identifier: Apache-2.0
#include "apps/command.h"
#include "base/file_output.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "env/map/init_files.h"

namespace floorproof {

namespace {

constexpr std::uintmax_t kMaxRobotBytes = 64u << 20;

// Canonical, since ../ in a path through a symbolic link would lead elsewhere.
std::string PathFrom(const std::filesystem::path& folder, const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  return fs::weakly_canonical(fs::absolute(file))
      .lexically_relative(fs::weakly_canonical(fs::absolute(folder)))
      .string();
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
  command.TextWithDefault("--out", options->out, "Folder to write into (existing files stay)");
  command.OnRun([options, &globals] {
    const auto robot_file = FindRobotFile(options->robot, {"--robot", 0});
    if (const std::string why = WhyUnreadable(robot_file, kMaxRobotBytes); !why.empty())
      throw InputError({"--robot", 0}, "", options->robot,
                       why + ": " + std::filesystem::absolute(robot_file).string());
    const RobotModel robot = ReadRobot(robot_file);
    const std::filesystem::path folder = options->out;
    const bool bundled = robot_file != options->robot;
    const InitFiles files = MakeInitFiles(options->map, robot.spec, folder,
                                          bundled ? options->robot : PathFrom(folder, robot_file));
    for (const auto& warning : files.warnings) globals.Say("warning: " + warning);
    MakeFolder(folder);
    const auto write = [&](const char* name, const std::string& text) {
      const bool stays = std::filesystem::exists(folder / name);
      if (!stays) WriteFileWhole(folder / name, text);
      SayWhenInterrupted((folder / name).string() + " is there");
      globals.Say((folder / name).string() + (stays ? " is there already and stays" : " written"));
    };
    write("site.yaml", files.site_yaml);
    write("scenario.yaml", files.scenario_yaml);
    globals.Say("next: floorproof run " + (folder / "scenario.yaml").string() + " --video");
  });
}

}  // namespace floorproof

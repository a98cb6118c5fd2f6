// SPDX-License-Identifier: Apache-2.0
#include "apps/command.h"
#include "env/core/input_file.h"
#include "env/core/interrupt.h"
#include "env/map/init_files.h"
#include "env/run/file_output.h"

namespace floorproof {

namespace {

constexpr std::uintmax_t kMostRobotBytes = 64u << 20;

}  // namespace

void AddInit(CLI::App& app, const Globals& globals, int&) {
  struct Options {
    std::string map, robot = "beluga", out = ".";
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "init", "Write site.yaml and scenario.yaml for your own ROS map, commented and runnable");
  command->add_option("MAP", options->map, "map.yaml of a ROS map_server map")->required();
  command->add_option("--robot", options->robot, "A name of `floorproof list robots`, or an MJCF")
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder to write into (existing files stay)")
      ->capture_default_str();
  command->callback([options, &globals] {
    const auto robot_file = FindRobotFile(options->robot, {"--robot", 0});
    if (const std::string why = WhyUnreadable(robot_file, kMostRobotBytes); !why.empty())
      throw InputError({"--robot", 0}, "", options->robot, why);
    const RobotModel robot = ReadRobot(robot_file);
    const std::filesystem::path folder = options->out;
    const InitFiles files = MakeInitFiles(options->map, robot.robot, folder);
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

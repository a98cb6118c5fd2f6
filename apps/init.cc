// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "env/map/init_files.h"
#include "env/map/ros_map.h"
#include "run/scenario/trust.h"

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

// The files to write: the scenario, its site, and copies of the map and the robot if these lie
// where an untrusted scenario may not read them (docs/security.md). So the folder can be moved and
// shared.
class InitFolder {
 public:
  explicit InitFolder(fs::path folder) : folder_(std::move(folder)) {}

  // How the site names this map; empty: where it lies.
  std::string MapKey(const fs::path& map, const InputFiles& inputs) {
    if (IsInReach(map)) return "";
    const fs::path image = ReadRosMap(map, inputs).image;
    ConfigNode keys = ReadYamlFile(map, inputs, "image");
    keys.SetPath("image", ConfigNode::Scalar(image.filename().string(), true));
    Add(map.filename(), WriteYaml(keys));
    Add(image.filename(), inputs.Read(image, kMaxCopyBytes));
    return map.filename().string();
  }
  // How the scenario names the robot that was read from these files, its own the first.
  std::string RobotKey(const std::vector<fs::path>& files, const InputFiles& inputs) {
    if (IsInReach(files.front())) return PathFrom(folder_, files.front());
    const fs::path from = files.front().parent_path();
    for (const fs::path& file : files)
      Add("robot" / file.lexically_relative(from), inputs.Read(file, kMaxCopyBytes));
    return ("robot" / files.front().filename()).string();
  }
  void Add(const fs::path& name, std::string text) {
    files_.emplace_back(folder_ / name, std::move(text));
  }
  const fs::path& path() const { return folder_; }
  void Write(const Globals& globals) const {
    for (const auto& [file, text] : files_) RefuseOther(file, text);
    for (const auto& [file, text] : files_) {
      MakeFolder(file.parent_path());
      WriteFileWhole(file, text);
      SayWhenInterrupted(file.string() + " is there");
      globals.Say(file.string() + " written");
    }
  }

 private:
  static constexpr std::uintmax_t kMaxCopyBytes = 256u << 20;

  bool IsInReach(const fs::path& file) const {
    const InputFiles untrusted;
    ConfineScenario(folder_ / "scenario.yaml", untrusted);
    return untrusted.WhyUnreadable(file, kMaxCopyBytes).empty();
  }

  fs::path folder_;
  std::vector<std::pair<fs::path, std::string>> files_;
};

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
    const InputFiles inputs;
    const RobotModel robot = ReadRobot(robot_file, {}, Blocks::kLocked, inputs);
    InitFolder folder(options->out);
    const bool bundled = robot_file != options->robot;
    const std::string robot_key = bundled ? options->robot : folder.RobotKey(robot.files, inputs);
    const InputFiles map_files;
    if (!globals.trusted) ConfineMap(options->map, map_files);
    const InitFiles files = MakeInitFiles(options->map, robot.spec, folder.path(), robot_key,
                                          folder.MapKey(options->map, map_files), map_files);
    folder.Add("site.yaml", files.site_yaml);
    folder.Add("scenario.yaml", files.scenario_yaml);
    for (const auto& warning : files.warnings) globals.Say("warning: " + warning);
    folder.Write(globals);
    globals.Say("next: floorproof run " + (folder.path() / "scenario.yaml").string() + " --video");
  });
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/robot_ladder.h"
#include "apps/written_model.h"
#include "base/interrupt.h"
#include "base/result_folder.h"
#include "base/usable_cores.h"
#include "controllers/drive.h"
#include "env/urdf/urdf_mjcf.h"
#include "env/urdf/urdf_text.h"
#include "report/robot_picture.h"
#include "report/robot_report.h"
#include "run/scenario/override.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPicture = ".robot.png";

ResultNames RobotPictures() {
  return {"robot", [](std::string_view name) {
            return name.ends_with(kPicture) || name.ends_with(kLadderTable) ||
                   name.ends_with(kLadderChart);
          }};
}

// Where the robot's MJCF is written, or would be.
fs::path OutFile(const std::string& out, const fs::path& file) {
  if (out.empty()) return fs::path("out/robot") / (file.stem().string() + ".xml");
  if (fs::path(out).extension() != ".xml")
    throw InputError({"--out", 0}, "", out, "must end in .xml; the picture goes beside it");
  return out;
}

UrdfAnswers Answers(const Globals& globals) {
  ConfigNode keys = ConfigNode::Map();
  for (const Override& o : globals.Overrides())
    keys.SetPath(o.key_path, ParseYaml(o.value, "--set " + o.key_path));
  UrdfAnswers answers;
  ReadParams(keys, "", [&](ParamVisitor& v) { answers.Visit(v); });
  return answers;
}

std::optional<DriveChoice> Choose(const RobotSpec& robot, std::string& why) {
  const auto* drive = DriveFor(robot, why);
  if (drive == nullptr) return std::nullopt;
  return DriveChoice{std::string(drive->name), drive->make()->holonomic()};
}

// Writes the URDF's MJCF to `out`, and returns it.
UrdfMjcf Convert(const fs::path& urdf, const fs::path& out, const Globals& globals) {
  UrdfMjcf mjcf = MjcfOfUrdf(urdf, Answers(globals), Choose);
  if (WriteConverted(out, mjcf.text))
    mjcf.notes.push_back("the limits that " + out.string() +
                         " held are dropped: they were measured of another model than this; "
                         "`floorproof robot " +
                         out.string() + " --ladder` measures them again");
  SayWhenInterrupted(out.string() + " is there");
  for (const std::string& note : mjcf.notes) globals.Say(note);
  globals.Say(out.string() + " written: each guess in it is marked as one");
  return mjcf;
}

}  // namespace

void AddRobot(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string file, out;
    bool ladder = false;
    int jobs = UsableCores();
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add("robot",
                                "Check a robot: what it is, from three sides, and ten seconds of "
                                "its drive; make the MJCF of a URDF");
  command.Text("FILE", options->file,
               "A robot's URDF or MJCF, or a name of `floorproof list robots`",
               Subcommand::Need::kRequired);
  command.Text("--out", options->out,
               "Where a URDF's MJCF goes, or with --ladder the measured one, the pictures beside "
               "it (default: out/robot/NAME.xml; a file of your own is measured in place)");
  command.Flag("--ladder", options->ladder,
               "Measure the largest hazards that it crosses, for planners: minutes; they are "
               "written into its model");
  command.Integer("--jobs", options->jobs, "With --ladder: threads (default: one a core)", 1, 1024);
  command.OnRun([options, &globals, &status] {
    const bool urdf = fs::path(options->file).extension() == ".urdf" || IsUrdf(options->file, {});
    fs::path file = urdf ? fs::path(options->file) : FindRobotFile(options->file, {"FILE", 0});
    const fs::path out = OutFile(options->out, file);
    UrdfMjcf mjcf;
    if (urdf) {
      mjcf = Convert(file, out, globals);
      file = out;
    } else if (!globals.sets.empty()) {
      throw InputError({"--set", 0}, "", globals.sets.front(),
                       "answers what a URDF does not say; an MJCF states it itself");
    }
    const RobotModel robot = ReadRobot(file);
    const bool in_place = file.string() == options->file && options->out.empty();
    const fs::path target =
        options->ladder ? PlaceForLimits(robot.files, in_place ? fs::path() : out) : fs::path();
    const fs::path folder = out.has_parent_path() ? out.parent_path() : ".";
    ResultFolder results(folder, RobotPictures(), robot.files);
    RobotCheck check = CheckRobot(file.string());
    for (const std::string& wrong : mjcf.wrong)
      check.findings.push_back({Finding::Kind::kWrong, wrong,
                                "add the mesh file, or give the link a <collision> made of "
                                "boxes, cylinders and spheres"});
    const fs::path picture = folder / (out.stem().string() + std::string(kPicture));
    results.Begin();
    WritePng(picture, DrawRobot(check, PartsOf(robot)));
    SayWhenInterrupted(picture.string() + " is there");
    SayRobot(check, globals);
    globals.Say("picture: " + picture.string());
    nlohmann::ordered_json json = RobotCheckJson(check);
    if (urdf) json["of_the_urdf"] = mjcf.notes;
    if (options->ladder)
      json["ladder"] = MeasureLimits(robot, target, folder / out.stem(), options->jobs, globals);
    globals.Result(json);
    if (!check.ok()) status = kExitNotSuccess;
  });
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Robots: the MJCF, and the RobotSpec read from it once.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/input_files.h"
#include "env/core/robot_spec.h"
#include "env/scene/engine.h"
#include "env/scene/feet.h"
#include "env/scene/robot_changes.h"

namespace floorproof {

// A bundled robot: models/list.inc names its file.
struct RobotEntry {
  std::string_view name, file, help;
};
std::span<const RobotEntry> Robots();

// The MJCF of a bundled robot's name, or of a path that ends in .xml. Throws InputError at `mark`.
std::filesystem::path FindRobotFile(const std::string& name_or_path, const SourceMark& mark);

struct RobotModel {
  SpecPtr mjcf;  // the robot alone, changes applied
  RobotSpec spec;
  std::vector<std::filesystem::path> files = {};  // that it was read from, the MJCF first
  std::shared_ptr<const mjVFS> assets = {};       // those files, for whoever compiles `mjcf`
  std::vector<Foot> feet = {};                    // wheels, casters and rollers
};

// Whether a reconfigurable robot can change its shape, or is one rigid body in the shape it has.
enum class Blocks { kLocked, kHinged };

// Reads and checks a robot. Conventions (docs/adding-a-robot.md): one body `base` with a free
// joint; one actuator a driven wheel, on a hinge whose body carries the wheel's cylinder; text and
// numbers under <custom>; of a reconfigurable robot also hinges between blocks. Throws InputError
// naming the file and what is missing.
RobotModel ReadRobot(const std::filesystem::path& file, const RobotChanges& changes = {},
                     Blocks blocks = Blocks::kLocked, const InputFiles& files = {});

// The robot alone, compiled. Throws InputError when MuJoCo refuses it.
ModelPtr CompileAlone(const RobotModel& robot);

// Throws InputError that names the shapes there are.
[[noreturn]] void RefuseShape(const RobotSpec& robot, const SourceMark& mark, std::string_view key,
                              std::string_view shape);

// Whether the body belongs to the robot's chassis: the base, or a block. Wheels and casters do not.
bool IsChassis(const mjModel* model, int body, const RobotSpec& robot);
bool IsChassis(const mjsBody* body, const RobotSpec& robot);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_model.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "env/core/blocks.h"
#include "env/scene/engine_refusal.h"
#include "env/scene/exposed_wheels.h"
#include "env/scene/lock_blocks.h"
#include "env/scene/measured_block.h"
#include "env/scene/models_folder.h"
#include "env/scene/robot_limits.h"
#include "env/scene/robot_mjcf.h"
#include "env/scene/roller_wheels.h"
#include "env/scene/scene.h"
#include "env/scene/spec_reader.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {
namespace {

bool IsChassisName(std::string_view body, const RobotSpec& robot) {
  return body == "base" ||
         std::ranges::find(robot.blocks, body, &BlockSpec::name) != robot.blocks.end();
}

// Clear shape, tool, radii, wheels and all that hangs on the shape, as at the start.
void TakeShape(RobotSpec& robot, const std::vector<ShapeSpec>& shapes, int index) {
  robot.shapes = shapes;
  robot.shape = 0;
  robot.tool_width_m = ToolWidth(robot, index);
  robot.shape = index;
  const ShapeSpec& shape = shapes[static_cast<std::size_t>(index)];
  robot.static_tip_rad = shape.static_tip_rad;
  robot.inscribed_radius_m = -SignedDistance(shape.footprint_B, Vec2::Zero());
  robot.circumscribed_radius_m = 0;
  for (const Vec2& p : shape.footprint_B)
    robot.circumscribed_radius_m = std::max(robot.circumscribed_radius_m, p.norm());
  robot.outline_B = ConvexParts({{shape.footprint_B, {}}});
  for (Shape2* part : {&robot.clear, &robot.tool})
    if (part->kind == Shape2::Kind::kFootprint) part->footprint_B = shape.footprint_B;
  if (robot.clear.kind == Shape2::Kind::kCircle)
    robot.clear.radius_m = robot.circumscribed_radius_m;
  if (robot.hinges.empty()) return;
  const BlockMotions blocks = MoveBlocks(robot.blocks, robot.hinges, AtRest(shape.hinge_rad));
  for (WheelSpec& wheel : robot.wheels) {
    const Pose2& X_BK = blocks.block[static_cast<std::size_t>(wheel.block)].X_BK;
    wheel.p_BW.head<2>() = X_BK * Vec2(wheel.p_BW.head<2>());
    wheel.yaw_rad = WrapAngle(wheel.yaw_rad + X_BK.yaw_rad);
  }
}

// Motors are found again by their names: they get one where the file gives none.
void NameParts(mjSpec* spec, const std::string& file) {
  const auto name = [&](mjsElement* element, const char* kind, int number) {
    if (mjs_getString(mjs_getName(element))[0] != '\0') return;
    const std::string given = kind + std::to_string(number);
    if (mjs_setName(element, given.c_str()) != 0)
      throw InputError({file, 0}, given, "", "another's name, needed for one without");
  };
  int number = 0;
  for (mjsElement* e = mjs_firstElement(spec, mjOBJ_ACTUATOR); e; e = mjs_nextElement(spec, e))
    name(e, "actuator ", number++);
}

RobotModel CopyOf(const ParsedMjcf& parsed) {
  RobotModel out;
  out.mjcf.reset(mj_copySpec(parsed.spec.get()));
  out.assets = parsed.engine_files.shared_vfs();
  for (const auto& [path, hash] : parsed.hashes) out.files.push_back(path);
  return out;
}

// What a scenario changes of the robot so that limits that were measured do not hold for it; none
// where they do. A full bin and a battery drawn low, as scenarios draw them, move a limit by no
// more than another start does.
std::string WhatItChanges(const RobotSpec& from, const RobotSpec& to) {
  constexpr double kDrawn = 0.1 + 1e-9, kExact = 1e-9;
  const auto same = [](double x, double y, double share) {
    return std::abs(x - y) <= share * std::abs(x);
  };
  if (!same(from.mass_kg, to.mass_kg, kDrawn)) return "its mass by more than a tenth";
  if (!same(from.battery.voltage_v.value_or(0), to.battery.voltage_v.value_or(0), kDrawn))
    return "its battery's voltage by more than a tenth";
  if (!same(from.clearance_m, to.clearance_m, kExact)) return "its clearance";
  const auto same_wheel = [&](const WheelSpec& x, const WheelSpec& y) {
    return same(x.radius_m, y.radius_m, kExact) &&
           same(x.roller_radius_m, y.roller_radius_m, kExact);
  };
  return std::ranges::equal(from.wheels, to.wheels, same_wheel) ? "" : "its wheels";
}

// Limits are of the robot that was measured: of the model that its files state, and of what the
// scenario leaves as it is.
void CheckMeasured(const std::vector<std::filesystem::path>& models, const InputFiles& files,
                   const std::string& changed, MeasuredLimits& measured) {
  if (measured.by.empty()) return;
  if (measured.model != ModelHash(models, files))
    DropLimits(measured, "the model was changed since");
  else if (!changed.empty())
    DropLimits(measured, "the scenario changes " + changed);
}

// Changes the model and reads what it then is. Returns it as it was compiled last.
ModelPtr ChangeAndRead(RobotModel& out, const std::string& file, const RobotChanges& changes,
                       Blocks blocks, const InputFiles& files) {
  NameParts(out.mjcf.get(), file);
  ModelPtr model;
  const auto read = [&] {
    model.reset(mj_compile(out.mjcf.get(), out.assets.get()));
    if (!model) throw EngineRefusal(file, "does not compile", mjs_getError(out.mjcf.get()));
    return ReadSpec(model.get(), file);
  };
  out.spec = read();
  const RobotSpec as_written = out.spec;
  if (ChangeRobot(out.mjcf.get(), out.spec, changes)) out.spec = read();
  const std::string changed = WhatItChanges(as_written, out.spec);

  const int shape = changes.shape.empty() ? 0 : FindShape(out.spec, changes.shape);
  if (shape < 0) RefuseShape(out.spec, {file, 0}, "shape", changes.shape);
  CheckMeasured(out.files, files, shape > 0 ? "its shape" : changed, out.spec.measured);
  if (out.spec.shapes.empty()) return model;
  const MeasuredLimits measured = std::move(out.spec.measured);
  const std::vector<ShapeSpec> shapes = out.spec.shapes;
  if (blocks == Blocks::kLocked) {
    LockBlocks(out.mjcf.get(), out.spec, shapes[static_cast<std::size_t>(shape)]);
    std::vector<BlockSpec> locked = std::move(out.spec.blocks);
    out.spec = read();
    out.spec.blocks = std::move(locked);
  }
  out.spec.measured = measured;
  TakeShape(out.spec, shapes, shape);
  return model;
}

void Finish(RobotModel& out, const std::string& file, const RobotChanges& changes, Blocks blocks,
            const InputFiles& files) {
  const ModelPtr model = ChangeAndRead(out, file, changes, blocks, files);
  out.feet = FeetOf(out.mjcf.get(), model.get(), out.spec);
  LetExposedWheelsMeetWalls(out.mjcf.get(), model.get(), out.spec);
}

void PutOnFloor(const RobotModel& robot) {
  HazardMap floor;
  floor.frame = {8, 8, 0.5, {}};
  floor.occupancy = Grid<CellState>(8, 8);
  const Scene scene = BuildScene(floor, robot, {}, {2, 2, 0});
  const DataPtr data = MakeData(scene.model.get());
  for (int step = 0; step < 3; ++step) StepEngine(scene.model.get(), data.get());
}

void PutOnRollers(const RobotModel& robot, const std::string& file) {
  if (!HasMecanumWheels(robot.spec)) return;
  const RobotModel rollers = WithRollerWheels(robot);
  const ModelPtr model(mj_compile(rollers.mjcf.get(), rollers.assets.get()));
  if (!model)
    throw EngineRefusal(file, "does not compile with wheels: rollers",
                        mjs_getError(rollers.mjcf.get()));
  RefuseBeyondLimits(model.get(), file);
  PutOnFloor(rollers);
}

// What becomes of a robot, once: its blocks locked and hinged, on rollers, in each shape.
void UseOnce(const ParsedMjcf& parsed, const std::string& file, const InputFiles& files) {
  const auto finish = [&](const RobotChanges& changes, Blocks blocks) {
    RobotModel robot = CopyOf(parsed);
    Finish(robot, file, changes, blocks, files);
    PutOnFloor(robot);
    return robot;
  };
  const RobotModel robot = finish({}, Blocks::kLocked);
  PutOnRollers(robot, file);
  if (robot.spec.shapes.empty()) return;
  finish({}, Blocks::kHinged);
  for (const ShapeSpec& shape : robot.spec.shapes) finish({.shape = shape.name}, Blocks::kLocked);
}

}  // namespace

std::span<const RobotEntry> Robots() {
  static constexpr RobotEntry kTable[] = {
#define FP_ROBOT(name, file, help) {name, file, help},
#include "models/list.inc"
#undef FP_ROBOT
  };
  return kTable;
}

std::filesystem::path FindRobotFile(const std::string& name_or_path, const SourceMark& mark) {
  std::vector<std::string> names;
  for (const auto& entry : Robots()) {
    if (entry.name == name_or_path) return ModelsFolder() / entry.file;
    names.emplace_back(entry.name);
  }
  if (name_or_path.ends_with(".xml")) return name_or_path;
  if (name_or_path.ends_with(".urdf") || name_or_path.ends_with(".URDF"))
    throw InputError(mark, "robot", name_or_path,
                     "unknown robot; a URDF's MJCF is made by `floorproof robot " + name_or_path +
                         "`, and named here");
  if (name_or_path.ends_with(".sdf") || name_or_path.ends_with(".xacro"))
    throw InputError(
        mark, "robot", name_or_path,
        "is not read: MJCF (.xml) is, and URDF by `floorproof robot`, which makes MJCF of "
        "it; `xacro FILE > my_robot.urdf` makes URDF of a .xacro");
  throw InputError(mark, "robot", name_or_path,
                   "unknown robot" + DidYouMean(name_or_path, names) +
                       " (a name of `list robots`, or an .xml file)");
}

RobotModel ReadRobot(const std::filesystem::path& file, const RobotChanges& changes, Blocks blocks,
                     const InputFiles& files) {
  static std::mutex mutex;
  RobotModel out;
  {
    const std::scoped_lock lock(mutex);
    out = CopyOf(ReadMjcf(
        file, files, [&](const ParsedMjcf& parsed) { UseOnce(parsed, file.string(), files); }));
  }
  Finish(out, file.string(), changes, blocks, files);
  return out;
}

ModelPtr CompileAlone(const RobotModel& robot) {
  const SpecPtr spec(mj_copySpec(robot.mjcf.get()));
  ModelPtr model(mj_compile(spec.get(), robot.assets.get()));
  if (!model)
    throw EngineRefusal(robot.spec.model_file, "does not compile", mjs_getError(spec.get()));
  return model;
}

void RefuseShape(const RobotSpec& robot, const SourceMark& mark, std::string_view key,
                 std::string_view shape) {
  if (robot.shapes.empty())
    throw InputError(mark, key, shape, "the robot " + robot.name + " does not change its shape");
  std::string known;
  for (const ShapeSpec& s : robot.shapes) known += (known.empty() ? "" : ", ") + s.name;
  throw InputError(mark, key, shape, "unknown shape (known: " + known + ")");
}

bool IsChassis(const mjModel* model, int body, const RobotSpec& robot) {
  const char* name = mj_id2name(model, mjOBJ_BODY, body);
  return name != nullptr && IsChassisName(name, robot);
}

bool IsChassis(const mjsBody* body, const RobotSpec& robot) {
  return IsChassisName(mjs_getString(mjs_getName(body->element)), robot);
}

}  // namespace floorproof

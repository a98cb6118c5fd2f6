// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_model.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "env/core/blocks.h"
#include "env/scene/engine_files.h"
#include "env/scene/lock_blocks.h"
#include "env/scene/mecanum_wheel.h"
#include "env/scene/mjcf_check.h"
#include "env/scene/spec_reader.h"

namespace floorproof {
namespace {

// An MJCF parsed, with all files that the engine opened for it.
struct ParsedMjcf {
  SpecPtr spec;
  EngineFiles engine_files;
  std::vector<std::pair<std::filesystem::path, std::string>> hashes;  // of each
};

// Kept as long as none of its files has other bytes. Parsing takes 20 ms and a copy 0.3 ms, and a
// campaign reads its robot in every episode.
const ParsedMjcf& ParseMjcf(const std::filesystem::path& file, const InputFiles& files) {
  static std::map<std::filesystem::path, ParsedMjcf> parsed;
  const std::filesystem::path path = std::filesystem::absolute(file).lexically_normal();
  const auto same = [&](const auto& known) { return files.Sha256(known.first) == known.second; };
  if (const auto known = parsed.find(path);
      known != parsed.end() && std::ranges::all_of(known->second.hashes, same))
    return known->second;
  CheckMjcf(file, files);
  ParsedMjcf out;
  out.engine_files = EngineFiles(files, path);
  char error[1000] = "";
  out.spec.reset(mj_parseXML(path.c_str(), out.engine_files.vfs(), error, sizeof error));
  if (!out.spec) throw InputError({file.string(), 0}, "", error, "is not MJCF that MuJoCo reads");
  // Meshes and pictures are opened by the compiler alone.
  const SpecPtr copy(mj_copySpec(out.spec.get()));
  if (!ModelPtr(mj_compile(copy.get(), out.engine_files.vfs())))
    throw InputError({file.string(), 0}, "", mjs_getError(copy.get()), "does not compile");
  for (const std::filesystem::path& opened : out.engine_files.Opened())
    out.hashes.emplace_back(opened, files.Sha256(opened));
  return parsed.insert_or_assign(path, std::move(out)).first->second;
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

// What is found again by its name gets one where the file gives none: motors, and the Mecanum
// wheels' geoms, which meet the floor by pairs.
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
  number = 0;
  for (mjsElement* e = mjs_firstElement(spec, mjOBJ_GEOM); e; e = mjs_nextElement(spec, e))
    if (RollersOf(mjs_asGeom(e)).radius_m > 0) name(e, "wheel ", number++);
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

std::filesystem::path ModelsFolder() {
  if (const char* folder = std::getenv("FLOORPROOF_MODELS")) return folder;
  return FLOORPROOF_MODELS_DIR;
}

std::filesystem::path FindRobotFile(const std::string& name_or_path, const SourceMark& mark) {
  std::vector<std::string> names;
  for (const auto& entry : Robots()) {
    if (entry.name == name_or_path) return ModelsFolder() / entry.file;
    names.emplace_back(entry.name);
  }
  if (name_or_path.ends_with(".xml")) return name_or_path;
  std::string rule = "unknown robot";
  if (const auto near = Nearest(name_or_path, names); !near.empty())
    rule += "; did you mean " + near + "?";
  throw InputError(mark, "robot", name_or_path,
                   rule + " (a name of `list robots`, or an .xml file)");
}

RobotModel ReadRobot(const std::filesystem::path& file, const RobotChanges& changes, Blocks blocks,
                     const InputFiles& files) {
  static std::mutex mutex;
  RobotModel out;
  {
    const std::scoped_lock lock(mutex);
    const ParsedMjcf& parsed = ParseMjcf(file, files);
    out.mjcf.reset(mj_copySpec(parsed.spec.get()));
    out.assets = parsed.engine_files.shared_vfs();
    for (const auto& [path, hash] : parsed.hashes) out.files.push_back(path);
  }
  NameParts(out.mjcf.get(), file.string());
  const auto read = [&] {
    ModelPtr model(mj_compile(out.mjcf.get(), out.assets.get()));
    if (!model)
      throw InputError({file.string(), 0}, "", mjs_getError(out.mjcf.get()), "does not compile");
    return ReadSpec(model.get(), file.string());
  };
  out.spec = read();
  if (ChangeRobot(out.mjcf.get(), out.spec, changes)) out.spec = read();

  const int shape = changes.shape.empty() ? 0 : FindShape(out.spec, changes.shape);
  if (shape < 0) RefuseShape(out.spec, {file.string(), 0}, "shape", changes.shape);
  if (out.spec.shapes.empty()) return out;
  const std::vector<ShapeSpec> shapes = out.spec.shapes;
  if (blocks == Blocks::kLocked) {
    LockBlocks(out.mjcf.get(), out.spec, shapes[static_cast<std::size_t>(shape)]);
    std::vector<BlockSpec> locked = std::move(out.spec.blocks);
    out.spec = read();
    out.spec.blocks = std::move(locked);
  }
  TakeShape(out.spec, shapes, shape);
  return out;
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
  if (name == nullptr) return false;
  return name == std::string_view("base") ||
         std::ranges::find(robot.blocks, name, &BlockSpec::name) != robot.blocks.end();
}

}  // namespace floorproof

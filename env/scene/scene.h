// SPDX-License-Identifier: Apache-2.0
// HazardMap + robot -> compiled mjModel, and the meaning of its geoms.
#pragma once

#include <string>
#include <vector>

#include "base/params.h"
#include "env/core/hazard_map.h"
#include "env/scene/engine.h"
#include "env/scene/robot_model.h"
#include "env/scene/wall_pool.h"

namespace floorproof {

struct PhysicsParams {
  double timestep_s = 0.004;  // 1-5 ms give the same answers (physics.md)
  std::string integrator = "discrete";
  void Visit(ParamVisitor& v);
};

// What a geom is to the detectors.
struct GeomRole {
  enum class Kind : std::uint8_t {
    kFloor,   // base floor, and bottoms of cuts (hazard >= 0)
    kWall,    // walls and furniture of the map
    kHazard,  // a hazard's solid
    kWheel,   // a wheel or caster of the robot
    kBody,    // any other part of the robot
    kLook,    // seen, never touched
  };
  Kind kind = Kind::kLook;
  int hazard = -1;  // index into HazardMap::hazards
};

// Groups of the model's geoms, so that a sensor's rays can tell them apart. The robot is in
// neither, nor are walls that stand in for those of a large map (WallPool).
inline constexpr int kSolidGroup = 4, kGlassGroup = 5;

enum class WallSet {
  kNear,  // a pool where there are many; for the simulation
  kAll,   // for pictures and files, however many there are
};

struct Scene {
  ModelPtr model;
  SpecPtr spec;                 // what it was compiled from
  std::vector<GeomRole> roles;  // per geom id
  int base_body = -1;
  int num_wall_geoms = 0, num_floor_geoms = 0, num_hazard_geoms = 0;
  WallPool pool;  // num 0: the model holds all walls itself
  // Parts of a step, so that the tyres' vibration is followed where a foot meets an edge.
  int edge_steps = 1;
};

// Builds the scene with the robot standing at `start`. Throws InternalError when MuJoCo refuses it.
Scene BuildScene(const HazardMap& map, const RobotModel& robot, const PhysicsParams& physics,
                 const Pose2& start, WallSet walls = WallSet::kNear);

// The scene, built with all its walls, as one MJCF file that the stock MuJoCo loads and steps.
std::string SceneXml(const Scene& scene);

}  // namespace floorproof

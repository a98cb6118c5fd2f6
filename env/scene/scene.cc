// SPDX-License-Identifier: Apache-2.0
#include "env/scene/scene.h"

#include <algorithm>
#include <cmath>

#include "env/scene/edge_contacts.h"
#include "env/scene/floor.h"
#include "env/scene/robot_reach.h"
#include "env/scene/scene_looks.h"
#include "env/scene/surfaces.h"
#include "env/scene/walls.h"
#include "env/scene/wheel_collider.h"
#include "env/scene/wheel_pairs.h"
#include "env/scene/world_geoms.h"

namespace floorproof {
namespace {

constexpr double kSlab_m = 0.10;  // of floor below the lowest
constexpr double kThinnest_m = 1e-5;

class SceneBuilder {
 public:
  SceneBuilder(const HazardMap& map, const RobotModel& robot, const ContactWalk& walk,
               const Looks& looks, mjSpec* spec)
      : world(map, walk, spec),
        map_(map),
        looks_(looks),
        robot_(robot.spec),
        assets_(robot.assets.get()),
        spec_(spec) {}

  void Floor() {
    const auto pieces = FloorPieces(map_);
    if (pieces.empty()) {
      mjsGeom* plane = world.Add({GeomRole::Kind::kFloor, -1}, map_.floor_friction, 0);
      plane->type = mjGEOM_PLANE;
      const Vec2 middle = MiddleOf(map_.frame);
      plane->pos[0] = middle.x();
      plane->pos[1] = middle.y();
      SetYaw(plane->quat, map_.frame.X_WG.yaw_rad);
      plane->size[0] = map_.frame.width * map_.frame.cell_m / 2 + 2;
      plane->size[1] = map_.frame.height * map_.frame.cell_m / 2 + 2;
      plane->size[2] = 1;
      mjs_setString(plane->material, looks_.floor.c_str());
    }
    // All slabs reach down equally deep: beside a deep pit there is no slot under the floor.
    double lowest_m = 0;
    for (const auto& piece : pieces) lowest_m = std::min(lowest_m, piece.z_top_m);
    for (const auto& piece : pieces) {
      const bool base = piece.hazard < 0;
      // What lies on the base floor is what is met there; on a cut's bottom, the cut still is.
      const int met = base ? piece.surface : piece.hazard;
      mjsGeom* geom =
          world.Extrude({Solid::Kind::kPrism, piece.outline, {}, lowest_m - kSlab_m, piece.z_top_m},
                        {GeomRole::Kind::kFloor, met}, FrictionOf(piece.hazard, piece.surface), 0);
      if (piece.surface >= 0)
        Colour(At(piece.surface), geom);
      else
        mjs_setString(geom->material, (base ? looks_.floor : looks_.pit).c_str());
    }
  }

  void Walls(const Vec2& start_W, WallSet set) {
    const std::vector<Box2> boxes = WallBoxes(map_, robot_, start_W);
    if (set == WallSet::kNear) pool = MakeWallPool(boxes, map_.frame.X_WG, spec_, assets_);
    const std::size_t num = pool.num > 0 ? static_cast<std::size_t>(pool.num) : boxes.size();
    for (std::size_t i = 0; i < num; ++i) {
      mjsGeom* geom = world.Add({GeomRole::Kind::kWall, -1}, 0.3, 0);
      geom->type = mjGEOM_BOX;
      if (pool.num > 0)
        ParkWall(geom->pos, geom->size);
      else
        PlaceWall(boxes[i], map_.frame.X_WG, geom->pos, geom->size);
      SetYaw(geom->quat, map_.frame.X_WG.yaw_rad);
      mjs_setString(geom->material, looks_.wall.c_str());
    }
  }

  void Hazards() {
    for (std::size_t h = 0; h < map_.hazards.size(); ++h) {
      const Hazard& hazard = map_.hazards[h];
      for (const Solid& solid : hazard.solids) {
        if (solid.kind != Solid::Kind::kPrism) continue;  // the floor has its hole, its surface
        // What is no floor, or too small a one, is not wet by itself.
        const bool floor = hazard.hazard_class == HazardClass::kLevelChange || IsSlope(solid);
        if (!floor || !solid.top.empty()) {
          AddSolid(solid, static_cast<int>(h), -1);
          continue;
        }
        for (SurfacePiece& piece : SurfacesOn(map_, h + 1, solid.base, 0)) {
          Solid part = solid;
          part.base = std::move(piece.outline);
          part.z_high_m = HighestOn(solid, part.base);
          if (part.z_high_m - part.z_low_m < kThinnest_m) continue;  // at a slope's foot
          AddSolid(part, static_cast<int>(h), piece.hazard);
        }
      }
    }
  }

  WallPool pool;
  WorldGeoms world;

 private:
  const Hazard& At(int hazard) const { return map_.hazards[static_cast<std::size_t>(hazard)]; }
  // Of what is built by `hazard` (-1: the base floor), with the surface of another on it.
  double FrictionOf(int hazard, int surface) const {
    const int met = surface >= 0 ? surface : hazard;
    if (met < 0) return map_.floor_friction;
    return At(met).material.friction.value_or(map_.floor_friction);
  }
  static void Colour(const Hazard& hazard, mjsGeom* geom) {
    std::copy(hazard.material.rgba.begin(), hazard.material.rgba.end(), geom->rgba);
  }
  void AddSolid(const Solid& solid, int hazard, int surface) {
    mjsGeom* geom = world.Extrude(solid, {GeomRole::Kind::kHazard, hazard},
                                  FrictionOf(hazard, surface), At(hazard).material.restitution);
    Colour(At(surface >= 0 ? surface : hazard), geom);
  }
  const HazardMap& map_;
  const Looks& looks_;
  const RobotSpec& robot_;
  const mjVFS* assets_;
  mjSpec* spec_;
};

int EdgeSteps(const std::vector<Foot>& feet, double timestep_s) {
  constexpr double kFollowed_rad = 0.25, kMost = 8;
  const double steps = std::ceil(FastestPhase(feet, timestep_s) / kFollowed_rad);
  return static_cast<int>(std::clamp(steps, 1.0, kMost));
}

// How the engine walks through a contact: with `implicitfast` every step is divided
// (fine_steps.h).
ContactWalk WalkOf(const PhysicsParams& physics, int edge_steps) {
  const bool implicit = physics.integrator == "discrete";
  return {implicit ? physics.timestep_s : physics.timestep_s / edge_steps, implicit};
}

// A robot's file does not rule the world: gravity and wind, solver and its scale, memory, looks.
void TakeDefaults(mjSpec* spec) {
  const SpecPtr fresh(mj_makeSpec());
  spec->option = fresh->option;
  spec->visual = fresh->visual;
  spec->stat = fresh->stat;
  spec->memory = fresh->memory;
  spec->nconmax = fresh->nconmax;
  spec->njmax = fresh->njmax;
  spec->nstack = fresh->nstack;
}

void SetPhysics(mjSpec* spec, const PhysicsParams& physics) {
  spec->option.timestep = physics.timestep_s;
  spec->option.integrator = physics.integrator == "discrete" ? mjINT_DISCRETE : mjINT_IMPLICITFAST;
  spec->option.cone = mjCONE_ELLIPTIC;
  spec->option.impratio = kImpratio;
  spec->option.solver = mjSOL_NEWTON;
  spec->option.disableflags |= mjDSBL_ISLAND;
  // A diverged state must end the episode, not be put back to the start in silence.
  spec->option.disableflags |= mjDSBL_AUTORESET;
}

void PlaceRobot(mjSpec* spec, const Pose2& start) {
  mjsBody* base = mjs_findBody(spec, "base");
  base->pos[0] = start.x_m;
  base->pos[1] = start.y_m;
  base->pos[2] = 0;
  SetYaw(base->quat, start.yaw_rad);
}

void SetRayGroups(const HazardMap& map, Scene& scene) {
  mjModel* m = scene.model.get();
  const int pool_end = scene.pool.first_geom + scene.pool.num;
  for (int g = 0; g < m->ngeom; ++g) {
    const GeomRole& role = scene.roles[static_cast<std::size_t>(g)];
    const bool stands_in = scene.pool.num > 0 && g >= scene.pool.first_geom && g < pool_end;
    if (m->geom_bodyid[g] != 0 || role.kind == GeomRole::Kind::kLook || stands_in) {
      m->geom_group[g] = std::min(m->geom_group[g], kSolidGroup - 1);
      continue;
    }
    const bool glass =
        role.hazard >= 0 && role.kind == GeomRole::Kind::kHazard &&
        map.hazards[static_cast<std::size_t>(role.hazard)].hazard_class == HazardClass::kGlass;
    m->geom_group[g] = glass ? kGlassGroup : kSolidGroup;
  }
}

}  // namespace

void PhysicsParams::Visit(ParamVisitor& v) {
  v("timestep_s", timestep_s, Bounds{0.0005, 0.005}, "physics step (s)");
  v("integrator", integrator, {"discrete", "implicitfast"}, "MuJoCo's integrator");
}

Scene BuildScene(const HazardMap& map, const RobotModel& robot, const PhysicsParams& physics,
                 const Pose2& start, WallSet walls) {
  Scene scene;
  scene.spec.reset(mj_copySpec(robot.mjcf.get()));
  TakeDefaults(scene.spec.get());
  SetPhysics(scene.spec.get(), physics);
  PlaceRobot(scene.spec.get(), start);
  ReserveEdgeMemory(scene.spec.get());
  const Looks looks = AddLooks(map.frame, scene.spec.get());
  scene.edge_steps = EdgeSteps(robot.feet, physics.timestep_s);
  SceneBuilder builder(map, robot, WalkOf(physics, scene.edge_steps), looks, scene.spec.get());
  builder.Floor();
  builder.Walls(start.p(), walls);
  builder.Hazards();
  PairWheels(map, robot, builder.world, scene.spec.get());
  InstallWheelCollider();
  InstallEdgeCollider();
  scene.model = CompileSpec(scene.spec.get(), robot.assets.get());
  InflateWheelBounds(scene.model.get());

  const mjModel* m = scene.model.get();
  scene.base_body = mj_name2id(m, mjOBJ_BODY, "base");
  scene.roles.resize(static_cast<std::size_t>(m->ngeom));
  const std::vector<bool> touches = CanTouch(m);
  std::vector<int> body_geoms;
  for (int g = 0; g < m->ngeom; ++g) {
    const int body = m->geom_bodyid[g];
    if (body == 0 || !touches[static_cast<std::size_t>(g)]) continue;
    const bool is_chassis = IsChassis(m, body, robot.spec);
    scene.roles[static_cast<std::size_t>(g)].kind =
        is_chassis ? GeomRole::Kind::kBody : GeomRole::Kind::kWheel;
    if (is_chassis) body_geoms.push_back(g);
  }
  MarkBodyGeoms(scene.model.get(), body_geoms);
  for (const auto& [geom, role] : builder.world.all()) {
    scene.roles[static_cast<std::size_t>(mjs_getId(geom->element))] = role;
    scene.num_wall_geoms += role.kind == GeomRole::Kind::kWall;
    scene.num_floor_geoms += role.kind == GeomRole::Kind::kFloor;
    scene.num_hazard_geoms += role.kind == GeomRole::Kind::kHazard;
  }
  scene.pool = std::move(builder.pool);
  if (scene.pool.num > 0)
    scene.pool.first_geom =
        static_cast<int>(std::ranges::find(scene.roles, GeomRole::Kind::kWall, &GeomRole::kind) -
                         scene.roles.begin());
  SetRayGroups(map, scene);
  return scene;
}

std::string SceneXml(const Scene& scene) {
  char error[1000] = "";
  std::string xml(1 << 20, '\0');
  for (;;) {
    const int size = mj_saveXMLString(scene.spec.get(), xml.data(), static_cast<int>(xml.size()),
                                      error, sizeof error);
    if (size < 0) throw InternalError(std::string("MuJoCo: cannot write MJCF: ") + error);
    if (size == 0) return xml.c_str();
    xml.assign(static_cast<std::size_t>(size) + 1, '\0');
  }
}

}  // namespace floorproof

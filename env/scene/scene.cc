// SPDX-License-Identifier: Apache-2.0
#include "env/scene/scene.h"

#include <algorithm>
#include <cmath>

#include "env/scene/floor.h"
#include "env/scene/free_names.h"
#include "env/scene/mecanum_wheel.h"
#include "env/scene/restitution.h"
#include "env/scene/rolling_drag.h"
#include "env/scene/scene_looks.h"
#include "env/scene/surfaces.h"
#include "env/scene/tyre.h"
#include "env/scene/walls.h"

namespace floorproof {
namespace {

// Contact bits, as the robots' MJCF states them: wheels meet the floor and hazards, the body all.
constexpr int kFloorBit = 1, kWallBit = 2;
constexpr int kPairsBit = 4;      // of what touches by pairs only
constexpr double kSlab_m = 0.10;  // of floor below the lowest
constexpr double kThinnest_m = 1e-5;
// Contact softness that was sound at 1-5 ms (physics.md, "Settings that were sound").
constexpr double kTimeConstant_s = 0.01;
constexpr mjtNum kSolimp[] = {0.95, 0.99, 0.0005};

void SetYaw(double* quat, double yaw_rad) {
  quat[0] = std::cos(yaw_rad / 2);
  quat[1] = quat[2] = 0;
  quat[3] = std::sin(yaw_rad / 2);
}

class SceneBuilder {
 public:
  SceneBuilder(const HazardMap& map, const RobotModel& robot, const Looks& looks, mjSpec* spec)
      : map_(map),
        looks_(looks),
        robot_(robot.spec),
        rollers_(robot.rollers),
        assets_(robot.assets.get()),
        spec_(spec),
        world_(mjs_findBody(spec, "world")),
        geom_names_(spec, mjOBJ_GEOM),
        mesh_names_(spec, mjOBJ_MESH) {
    for (mjsElement* e = mjs_firstElement(spec, mjOBJ_GEOM); e; e = mjs_nextElement(spec, e))
      if (RollersOf(mjs_asGeom(e)).radius_m > 0) mecanum.push_back(mjs_asGeom(e));
    tyres_ = ScrubbingTyres(spec, robot.spec);
  }

  void Floor() {
    const auto pieces = FloorPieces(map_);
    if (pieces.empty()) {
      mjsGeom* plane = Add(GeomRole::Kind::kFloor, -1, map_.floor_friction, 0);
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
          Extrude({Solid::Kind::kPrism, piece.outline, {}, lowest_m - kSlab_m, piece.z_top_m},
                  GeomRole::Kind::kFloor, met, FrictionOf(piece.hazard, piece.surface), 0);
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
      mjsGeom* geom = Add(GeomRole::Kind::kWall, -1, 0.3, 0);
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
        if (!solid.top.empty()) {                         // tapered: too small to be wet by itself
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

  // Plain wheels and casters touch what drags by pairs of their own.
  void PairFeet() {
    std::vector<Foot> feet;
    for (const auto& [geom, role] : added) {
      const double drag = DragOf(role);
      if (drag <= 0) continue;
      if (feet.empty()) feet = NamedFeet();
      for (const Foot& foot : feet) PairFoot(spec_, foot, geom, drag);
    }
  }

  // Mecanum wheels touch the floor and hazards by pairs, through their collider, and tyres that
  // scrub by softer ones; walls meet the body.
  void PairWheels() {
    for (mjsGeom* wheel : mecanum) {
      wheel->conaffinity = 0;
      for (const auto& [geom, role] : added)
        if (role.kind != GeomRole::Kind::kWall)
          PairWheel(spec_, wheel, geom, {geom->friction[0], 0, DragOf(role) * RadiusOf(wheel)});
    }
    // Rollers need no collider, but the same slower friction.
    for (const std::string& name : rollers_) {
      mjsGeom* roller = mjs_asGeom(mjs_findElement(spec_, mjOBJ_GEOM, name.c_str()));
      roller->conaffinity = kPairsBit;
      for (const auto& [geom, role] : added)
        if (role.kind != GeomRole::Kind::kWall)
          PairWheel(spec_, roller, geom,
                    {geom->friction[0], geom->friction[0], DragOf(role) * roller->size[0]});
    }
    int number = 0;
    for (mjsGeom* tyre : tyres_) {
      tyre->conaffinity = kPairsBit;
      if (mjs_getString(mjs_getName(tyre->element))[0] == '\0')
        mjs_setName(tyre->element, geom_names_.For("tyre/" + std::to_string(number)).c_str());
      ++number;
      for (const auto& [geom, role] : added)
        if (role.kind != GeomRole::Kind::kWall) PairTyre(spec_, tyre, geom, DragOf(role));
    }
  }

  WallPool pool;
  std::vector<std::pair<mjsGeom*, GeomRole>> added;
  std::vector<mjsGeom*> mecanum;  // the robot's wheels with rollers

 private:
  const Hazard& At(int hazard) const { return map_.hazards[static_cast<std::size_t>(hazard)]; }
  // Of what is built by `hazard` (-1: the base floor), with the surface of another on it.
  double FrictionOf(int hazard, int surface) const {
    const int met = surface >= 0 ? surface : hazard;
    if (met < 0) return map_.floor_friction;
    return At(met).material.friction.value_or(map_.floor_friction);
  }
  double DragOf(const GeomRole& role) const {
    return role.hazard >= 0 ? At(role.hazard).material.rolling_drag : 0;
  }
  static double RadiusOf(const mjsGeom* mecanum_wheel) {
    return mecanum_wheel->size[0] + RollersOf(mecanum_wheel).radius_m;
  }
  std::vector<Foot> NamedFeet() {
    std::vector<Foot> feet = FeetOf(spec_, robot_);
    std::erase_if(feet, [&](const Foot& foot) {
      return std::ranges::find(tyres_, foot.geom) != tyres_.end() ||
             std::ranges::find(rollers_, NameOf(foot.geom)) != rollers_.end();
    });
    for (std::size_t i = 0; i < feet.size(); ++i)
      if (NameOf(feet[i].geom).empty())
        mjs_setName(feet[i].geom->element, geom_names_.For("foot/" + std::to_string(i)).c_str());
    return feet;
  }
  static std::string NameOf(const mjsGeom* geom) {
    return mjs_getString(mjs_getName(geom->element));
  }
  static void Colour(const Hazard& hazard, mjsGeom* geom) {
    std::copy(hazard.material.rgba.begin(), hazard.material.rgba.end(), geom->rgba);
  }
  void AddSolid(const Solid& solid, int hazard, int surface) {
    mjsGeom* geom = Extrude(solid, GeomRole::Kind::kHazard, hazard, FrictionOf(hazard, surface),
                            At(hazard).material.restitution);
    Colour(At(surface >= 0 ? surface : hazard), geom);
  }
  mjsGeom* Add(GeomRole::Kind kind, int hazard, double friction, double restitution) {
    mjsGeom* geom = mjs_addGeom(world_, nullptr);
    const bool wall = kind == GeomRole::Kind::kWall;
    geom->contype = wall ? kWallBit : kFloorBit;
    geom->conaffinity = 0;
    geom->condim = 3;
    geom->priority = 1;  // what is met rules over the robot's own friction and softness
    geom->friction[0] = friction;
    const ContactSoftness softness =
        kind == GeomRole::Kind::kFloor
            ? ContactSoftness{kTimeConstant_s, 1}
            : SoftnessFor(restitution,
                          {spec_->option.timestep, spec_->option.integrator == mjINT_DISCRETE});
    geom->solref[0] = softness.time_constant_s;
    geom->solref[1] = softness.damping_ratio;
    std::copy(std::begin(kSolimp), std::end(kSolimp), geom->solimp);
    if (restitution > 0) geom->solimp[0] = geom->solimp[1];  // as SoftnessFor assumes
    added.emplace_back(geom, GeomRole{kind, hazard});
    const std::string name = geom_names_.For(Name(kind, hazard));
    mjs_setName(geom->element, name.c_str());
    return geom;
  }

  // Names that a reader of the exported MJCF understands.
  std::string Name(GeomRole::Kind kind, int hazard) const {
    const std::string number = std::to_string(added.size());
    if (hazard >= 0) return map_.hazards[static_cast<std::size_t>(hazard)].id + "/" + number;
    return (kind == GeomRole::Kind::kWall ? "wall/" : "floor/") + number;
  }

  // A box where it is one, else a convex mesh.
  mjsGeom* Extrude(const Solid& solid, GeomRole::Kind kind, int hazard, double friction,
                   double restitution) {
    const Polygon &base = solid.base, &top = solid.top.empty() ? base : solid.top;
    const double z_low = solid.z_low_m, z_high = solid.z_high_m;
    mjsGeom* geom = Add(kind, hazard, friction, restitution);
    if (base.size() == 4 && top == base && !IsSlope(solid) && IsRectangle(base)) {
      const Vec2 middle = (base[0] + base[2]) / 2, along = base[1] - base[0];
      geom->type = mjGEOM_BOX;
      geom->pos[0] = middle.x();
      geom->pos[1] = middle.y();
      geom->pos[2] = (z_low + z_high) / 2;
      SetYaw(geom->quat, std::atan2(along.y(), along.x()));
      geom->size[0] = along.norm() / 2;
      geom->size[1] = (base[2] - base[1]).norm() / 2;
      geom->size[2] = (z_high - z_low) / 2;
      return geom;
    }
    // Vertices around the middle, so that single precision costs nothing far from the origin.
    Vec2 middle = Vec2::Zero();
    for (const auto& p : base) middle += p / static_cast<double>(base.size());
    std::vector<float> vertices;
    const auto add = [&](const Vec2& p, double z) {
      for (const double v : {p.x() - middle.x(), p.y() - middle.y(), z - z_low})
        vertices.push_back(static_cast<float>(v));
    };
    for (const Vec2& p : base) add(p, z_low);
    for (const Vec2& p : top) add(p, TopAt(solid, p));
    mjsMesh* mesh = mjs_addMesh(spec_, nullptr);
    const std::string name = mesh_names_.For("mesh/" + std::to_string(added.size()));
    mjs_setName(mesh->element, name.c_str());
    mjs_setFloat(mesh->uservert, vertices.data(), static_cast<int>(vertices.size()));
    geom->type = mjGEOM_MESH;
    mjs_setString(geom->meshname, name.c_str());
    geom->pos[0] = middle.x();
    geom->pos[1] = middle.y();
    geom->pos[2] = z_low;
    return geom;
  }

  static bool IsRectangle(const Polygon& p) {
    const Vec2 a = p[1] - p[0], b = p[2] - p[1], c = p[3] - p[2];
    return std::abs(a.dot(b)) < 1e-9 * a.norm() * b.norm() + 1e-15 && (a + c).norm() < 1e-9;
  }

  const HazardMap& map_;
  const Looks& looks_;
  const RobotSpec& robot_;
  const std::vector<std::string>& rollers_;
  std::vector<mjsGeom*> tyres_;  // of plain wheels that scrub
  const mjVFS* assets_;
  mjSpec* spec_;
  mjsBody* world_;
  FreeNames geom_names_, mesh_names_;
};

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
  const Looks looks = AddLooks(map.frame, scene.spec.get());
  SceneBuilder builder(map, robot, looks, scene.spec.get());
  builder.Floor();
  builder.Walls(start.p(), walls);
  builder.Hazards();
  builder.PairWheels();
  builder.PairFeet();
  InstallWheelCollider();
  scene.model = CompileSpec(scene.spec.get(), robot.assets.get());
  InflateWheelBounds(scene.model.get());

  const mjModel* m = scene.model.get();
  scene.base_body = mj_name2id(m, mjOBJ_BODY, "base");
  scene.roles.resize(static_cast<std::size_t>(m->ngeom));
  for (int g = 0; g < m->ngeom; ++g) {
    const int body = m->geom_bodyid[g];
    const bool touches =
        m->geom_contype[g] != 0 || m->geom_conaffinity[g] != 0 || RollersOf(m, g).radius_m > 0;
    if (body == 0 || !touches) continue;
    scene.roles[static_cast<std::size_t>(g)].kind =
        IsChassis(m, body, robot.spec) ? GeomRole::Kind::kBody : GeomRole::Kind::kWheel;
  }
  for (const auto& [geom, role] : builder.added) {
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

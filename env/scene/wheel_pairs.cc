// SPDX-License-Identifier: Apache-2.0
#include "env/scene/wheel_pairs.h"

#include <algorithm>
#include <string>

#include "env/scene/mecanum_wheel.h"
#include "env/scene/rolling_drag.h"
#include "env/scene/tyre.h"

namespace floorproof {
namespace {

constexpr int kPairsBit = 4;  // of what touches floors and hazards by pairs only

class WheelPairs {
 public:
  WheelPairs(const HazardMap& map, const RobotModel& robot, const WorldGeoms& world, mjSpec* spec)
      : map_(map),
        robot_(robot.spec),
        rollers_(robot.rollers),
        world_(world),
        spec_(spec),
        tyres_(ScrubbingTyres(spec, robot.spec)) {}

  void PairMecanum() {
    for (mjsElement* e = mjs_firstElement(spec_, mjOBJ_GEOM); e; e = mjs_nextElement(spec_, e)) {
      mjsGeom* wheel = mjs_asGeom(e);
      const double roller_m = RollersOf(wheel).radius_m;
      if (roller_m <= 0) continue;
      wheel->conaffinity &= kWallBit;
      for (const auto& [geom, role] : world_.all())
        if (role.kind != GeomRole::Kind::kWall)
          PairWheel(spec_, wheel, geom,
                    {geom->friction[0], 0, DragOf(role) * (wheel->size[0] + roller_m)});
    }
  }

  // Rollers need no collider, but the same slower friction.
  void PairRollers() {
    for (const std::string& name : rollers_) {
      mjsGeom* roller = mjs_asGeom(mjs_findElement(spec_, mjOBJ_GEOM, name.c_str()));
      roller->conaffinity = kPairsBit | (roller->conaffinity & kWallBit);
      for (const auto& [geom, role] : world_.all())
        if (role.kind != GeomRole::Kind::kWall)
          PairWheel(spec_, roller, geom,
                    {geom->friction[0], geom->friction[0], DragOf(role) * roller->size[0]});
    }
  }

  void PairTyres() {
    int number = 0;
    for (mjsGeom* tyre : tyres_) {
      tyre->conaffinity = kPairsBit | (tyre->conaffinity & kWallBit);
      if (mjs_getString(mjs_getName(tyre->element))[0] == '\0')
        mjs_setName(tyre->element, world_.FreeName("tyre/" + std::to_string(number)).c_str());
      ++number;
      for (const auto& [geom, role] : world_.all())
        if (role.kind != GeomRole::Kind::kWall) PairTyre(spec_, tyre, geom, DragOf(role));
    }
  }

  void PairFeet() {
    std::vector<Foot> feet;
    for (const auto& [geom, role] : world_.all()) {
      const double drag = DragOf(role);
      if (drag <= 0) continue;
      if (feet.empty()) feet = NamedFeet();
      for (const Foot& foot : feet) PairFoot(spec_, foot, geom, drag);
    }
  }

 private:
  double DragOf(const GeomRole& role) const {
    return role.hazard >= 0
               ? map_.hazards[static_cast<std::size_t>(role.hazard)].material.rolling_drag
               : 0;
  }
  std::vector<Foot> NamedFeet() {
    std::vector<Foot> feet = FeetOf(spec_, robot_);
    std::erase_if(feet, [&](const Foot& foot) {
      return std::ranges::find(tyres_, foot.geom) != tyres_.end() ||
             std::ranges::find(rollers_, NameOf(foot.geom)) != rollers_.end();
    });
    for (std::size_t i = 0; i < feet.size(); ++i)
      if (NameOf(feet[i].geom).empty())
        mjs_setName(feet[i].geom->element, world_.FreeName("foot/" + std::to_string(i)).c_str());
    return feet;
  }
  static std::string NameOf(const mjsGeom* geom) {
    return mjs_getString(mjs_getName(geom->element));
  }

  const HazardMap& map_;
  const RobotSpec& robot_;
  const std::vector<std::string>& rollers_;
  const WorldGeoms& world_;
  mjSpec* spec_;
  std::vector<mjsGeom*> tyres_;  // of plain wheels that scrub
};

}  // namespace

void PairWheels(const HazardMap& map, const RobotModel& robot, const WorldGeoms& world,
                mjSpec* spec) {
  WheelPairs pairs(map, robot, world, spec);
  pairs.PairMecanum();
  pairs.PairRollers();
  pairs.PairTyres();
  pairs.PairFeet();
}

}  // namespace floorproof

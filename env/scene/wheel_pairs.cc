// SPDX-License-Identifier: Apache-2.0
#include "env/scene/wheel_pairs.h"

#include <algorithm>
#include <cmath>

#include "env/scene/wheel_collider.h"

namespace floorproof {
namespace {

// A wheel that slides on while the robot turns is pressed off the floor by its friction, the more
// the sooner that stops a slip, and hops.
constexpr double kStopsSlip_s = 0.01, kStopsScrub_s = 0.08;
constexpr double kLeastAhead_m = 0.005, kMostAhead_m = 0.015;  // LiveGeoms has 20 mm to spare

// Whether the wheels are on several parallel axles: they slide across the floor whenever the
// robot turns.
bool Scrubs(const RobotSpec& robot) {
  constexpr double kOneAxle_m = 1e-3, kParallel_rad = 1e-3;
  if (robot.wheels.size() < 3) return false;
  const WheelSpec& first = robot.wheels.front();
  const Vec2 ahead(std::cos(first.yaw_rad), std::sin(first.yaw_rad));
  double farthest_m = 0;
  for (const WheelSpec& wheel : robot.wheels) {
    if (wheel.roller_radius_m > 0) return false;
    if (std::abs(WrapAngle(wheel.yaw_rad - first.yaw_rad)) > kParallel_rad) return false;
    const Vec2 from_first = (wheel.p_BW - first.p_BW).head<2>();
    farthest_m = std::max(farthest_m, std::abs(from_first.dot(ahead)));
  }
  return farthest_m > kOneAxle_m;
}

// `impedance`: the pair's.
void StopSlips(double stops_slip_s, double impedance, mjsPair* pair) {
  pair->solreffriction[0] = 2 * stops_slip_s / impedance;
  pair->solreffriction[1] = 1;
}

void SetTyre(const Foot& foot, double stops_slip_s, mjsPair* pair) {
  const double share = (1 - kTyreImpedance) * foot.inverse_mass_pkg;
  pair->solref[0] = -share * foot.tyre.stiffness_npm;
  pair->solref[1] = -share * foot.tyre.damping_nspm;
  pair->solimp[0] = pair->solimp[1] = kTyreImpedance;
  StopSlips(stops_slip_s, kTyreImpedance, pair);
  pair->margin = foot.sink_m();
}

}  // namespace

void PairWheels(const HazardMap& map, const RobotModel& robot, const WorldGeoms& world,
                mjSpec* spec) {
  const double stops_slip_s = Scrubs(robot.spec) ? kStopsScrub_s : kStopsSlip_s;
  const double ahead_m =
      std::clamp(2 * spec->option.timestep * robot.spec.max_speed_mps, kLeastAhead_m, kMostAhead_m);
  for (const Foot& foot : robot.feet) {
    mjsGeom* geom = mjs_asGeom(mjs_findElement(spec, mjOBJ_GEOM, foot.geom.c_str()));
    geom->conaffinity &= kWallBit;
    MarkPaired(spec, geom);
    for (const auto& [ground, role] : world.all()) {
      if (role.kind == GeomRole::Kind::kWall) continue;
      const Material* material =
          role.hazard >= 0 ? &map.hazards[static_cast<std::size_t>(role.hazard)].material : nullptr;
      const double drag = material != nullptr ? material->rolling_drag : 0;
      mjsPair* pair = mjs_addPair(spec, nullptr);
      mjs_setString(pair->geomname1, foot.geom.c_str());
      mjs_setString(pair->geomname2, mjs_getString(mjs_getName(ground->element)));
      // As the engine would choose: what has the higher priority rules.
      const mjsGeom* ruler = geom->priority > ground->priority ? geom : ground;
      const bool rolls = foot.rolls_m > 0;
      pair->condim = rolls && drag > 0 ? 6 : foot.scrubs_m > 0 ? 4 : 3;
      const double slide = ruler->friction[0] + (rolls ? 0 : drag), roll = drag * foot.rolls_m;
      // Rollers that have no mass turn freely: no friction across their axes, which is the pair's
      // second. At 0.005 already wheels chatter (MuJoCo raises 0 to 1e-5).
      const double across = RollersOf(geom).radius_m > 0 ? 0 : slide;
      const double friction[5] = {slide, across, slide * foot.scrubs_m, roll, roll};
      std::copy(std::begin(friction), std::end(friction), pair->friction);
      std::copy(std::begin(ground->solimp), std::end(ground->solimp), pair->solimp);
      std::copy(std::begin(ground->solref), std::end(ground->solref), pair->solref);
      if (role.kind == GeomRole::Kind::kHazard && material != nullptr && material->restitution > 0)
        StopSlips(stops_slip_s, ground->solimp[1], pair);
      else
        SetTyre(foot, stops_slip_s, pair);
      pair->gap = ahead_m;
    }
  }
}

void KeepStiffness(const mjModel* built, mjModel* model) {
  for (int p = 0; p < model->npair; ++p) {
    const mjtNum* was = built->pair_solref + mjNREF * p;
    if (was[0] >= 0) continue;
    const auto inverse_mass = [p](const mjModel* m) {
      return m->body_invweight0[2 * m->geom_bodyid[m->pair_geom1[p]]] +
             m->body_invweight0[2 * m->geom_bodyid[m->pair_geom2[p]]];
    };
    const double share = inverse_mass(model) / inverse_mass(built);
    for (int i = 0; i < 2; ++i) model->pair_solref[mjNREF * p + i] = share * was[i];
  }
}

}  // namespace floorproof

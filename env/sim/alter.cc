// SPDX-License-Identifier: Apache-2.0
// Alterations of the simulated model. Each value follows from the one that was built, in the
// scene's model, so that altering twice is altering once.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "env/scene/roller_wheels.h"
#include "env/scene/wheel_collider.h"
#include "env/scene/wheel_pairs.h"
#include "env/sim/simulation.h"

namespace floorproof {
namespace {

constexpr double kOpenCircuit_ohm = 1e12;  // of a motor that gives nothing
constexpr double kBlocked_nm = 10;         // holds a roller against anything that a floor can do

template <class T>
void RequireOneEach(const std::vector<T>& values, std::size_t wheels, const char* of) {
  if (!values.empty() && values.size() != wheels)
    throw InternalError(std::string("alterations: ") + of + " must hold a value a driven wheel");
}

}  // namespace

void Simulation::Alter(const Alterations& alterations) {
  RequireOneEach(alterations.wheel_torque, robot_.wheels.size(), "wheel_torque");
  RequireOneEach(alterations.roller_drag, robot_.wheels.size(), "roller_drag");
  RequireOneEach(alterations.wheel_stuck_radps, robot_.wheels.size(), "wheel_stuck_radps");
  RequireOneEach(alterations.wheel_friction, robot_.wheels.size(), "wheel_friction");
  const bool has_rollers =
      std::ranges::any_of(robot_.wheels, [](const WheelSpec& w) { return w.roller_radius_m > 0; });
  if (!alterations.roller_drag.empty() && !has_rollers)
    throw InternalError("alterations: roller_drag: the robot's wheels have no rollers");
  const bool payload_changes = alterations.payload_kg != altered_.payload_kg ||
                               alterations.payload_p_B != altered_.payload_p_B;
  voltage_changes_ |= alterations.battery_voltage != 1;
  altered_ = alterations;
  battery_.Weaken(altered_.battery_voltage);
  AlterMotors();
  AlterFriction();
  AlterRollerBearings();
  if (payload_changes) AlterPayload();
  SetDriverVoltages();
  live_.Refresh();
  HoldStuckWheels();
}

// A motor that gives a share of its torque at any speed and voltage is one of higher resistance,
// behind a driver of lower gain and limit.
void Simulation::AlterMotors() {
  const mjModel* built = scene_.model.get();
  for (int a = 0; a < own_->nu; ++a) {
    const auto wheel = static_cast<std::size_t>(a);
    const bool weak = wheel < altered_.wheel_torque.size();
    const double given = weak ? altered_.wheel_torque[wheel] : 1;
    const double share = wheel < cut_.size() && cut_[wheel] ? 0 : given;
    const mjtNum* was = built->actuator_gainprm + mjNGAIN * a;
    mjtNum* gain = own_->actuator_gainprm + mjNGAIN * a;
    constexpr int kResistance = 0, kVelocity = 6;
    gain[kResistance] =
        share > 0 ? std::min(was[kResistance] * altered_.motor_resistance / share, kOpenCircuit_ohm)
                  : kOpenCircuit_ohm;
    gain[kVelocity] = was[kVelocity] * share;
    for (int i = 0; i < 2; ++i)
      own_->actuator_forcerange[2 * a + i] = built->actuator_forcerange[2 * a + i] * share;
  }
}

void Simulation::AlterFriction() {
  const mjModel* built = scene_.model.get();
  // None: as built.
  const auto most_of_wheel = [&](int wheel) -> std::optional<double> {
    const auto at = static_cast<std::size_t>(wheel);
    return wheel >= 0 && at < altered_.wheel_friction.size() ? altered_.wheel_friction[at]
                                                             : std::nullopt;
  };
  // Whether it has the floor's friction: walls have their own, and hazards may.
  const auto is_floor = [&](int geom) {
    const GeomRole& role = scene_.roles[static_cast<std::size_t>(geom)];
    if (role.kind != GeomRole::Kind::kFloor && role.kind != GeomRole::Kind::kHazard) return false;
    return role.hazard < 0 ||
           !map_.hazards[static_cast<std::size_t>(role.hazard)].material.friction.has_value();
  };
  // The driven wheel that a geom belongs to: itself, or a roller on it.
  const auto wheel_of = [&](int geom) {
    for (int body = own_->geom_bodyid[geom]; body > 0; body = own_->body_parentid[body])
      if (const auto at = std::ranges::find(wheel_bodies_, body); at != wheel_bodies_.end())
        return static_cast<int>(at - wheel_bodies_.begin());
    return -1;
  };
  for (int g = 0; g < own_->ngeom; ++g) {
    const mjtNum* was = built->geom_friction + 3 * g;
    mjtNum* friction = own_->geom_friction + 3 * g;
    if (is_floor(g)) friction[0] = was[0] * altered_.floor_friction;
  }
  for (int p = 0; p < own_->npair; ++p) {
    const std::array geoms = {own_->pair_geom1[p], own_->pair_geom2[p]};
    const mjtNum* was = built->pair_friction + 5 * p;
    mjtNum* friction = own_->pair_friction + 5 * p;
    const auto floor_rules = [&](int at) {
      return is_floor(geoms[at]) &&
             built->geom_priority[geoms[at]] >= built->geom_priority[geoms[1 - at]];
    };
    const bool floor = floor_rules(0) || floor_rules(1);
    for (int i = 0; i < 2; ++i) friction[i] = was[i] * (floor ? altered_.floor_friction : 1);
    for (const int geom : geoms) {
      const int wheel = wheel_of(geom);
      if (const auto most = most_of_wheel(wheel))
        for (int i = 0; i < 2; ++i) friction[i] = std::min(friction[i], *most);
      if (wheel >= 0 && !altered_.roller_drag.empty())
        friction[1] +=
            altered_.roller_drag[static_cast<std::size_t>(wheel)] * (friction[0] - friction[1]);
    }
    if (was[0] > 0) friction[2] = was[2] * friction[0] / was[0];  // what a tread scrubs with
  }
}

// Rollers that are bodies are braked in their bearings: by the share of what the floor can turn
// them with, under the weight that a wheel carries at rest.
void Simulation::AlterRollerBearings() {
  const mjModel* built = scene_.model.get();
  const double load_n = (robot_.mass_kg + altered_.payload_kg) * -built->opt.gravity[2] /
                        static_cast<double>(robot_.wheels.size());
  for (int joint = 0; joint < own_->njnt; ++joint) {
    const int body = own_->jnt_bodyid[joint];
    const auto at = std::ranges::find(wheel_bodies_, own_->body_parentid[body]);
    if (at == wheel_bodies_.end()) continue;
    const auto wheel = static_cast<std::size_t>(at - wheel_bodies_.begin());
    const WheelSpec& spec = robot_.wheels[wheel];
    const char* geom = mj_id2name(own_.get(), mjOBJ_GEOM, own_->body_geomadr[body]);
    if (geom == nullptr || !std::string_view(geom).starts_with(RollerPrefix(spec.name))) continue;
    const double drag = altered_.roller_drag.empty() ? 0 : altered_.roller_drag[wheel];
    const double floor_nm =
        map_.floor_friction * altered_.floor_friction * load_n * spec.roller_radius_m;
    const int dof = own_->jnt_dofadr[joint];
    // A roller is so light that the engine's usual softness would let it creep round.
    constexpr mjtNum kHard[mjNIMP] = {0.9999, 0.9999, 0.001, 0.5, 2};
    std::copy_n(drag > 0 ? kHard : built->dof_solimp + mjNIMP * dof, mjNIMP,
                own_->dof_solimp + mjNIMP * dof);
    own_->dof_frictionloss[dof] =
        built->dof_frictionloss[dof] + (drag < 1 ? drag * floor_nm : kBlocked_nm);
  }
}

// A point mass that rides on the base: mass, centre and inertia of both together.
void Simulation::AlterPayload() {
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const mjModel* built = scene_.model.get();
  const int base = scene_.base_body;
  const double m1 = built->body_mass[base], m2 = altered_.payload_kg;
  const Vec3 p1(built->body_ipos + 3 * base), p2 = altered_.payload_p_B;
  const Vec3 p = (m1 * p1 + m2 * p2) / (m1 + m2);
  const auto of_point = [](double mass, const Vec3& r) -> Matrix {
    return mass * (r.squaredNorm() * Matrix::Identity() - r * r.transpose());
  };
  Matrix R;
  mju_quat2Mat(R.data(), built->body_iquat + 4 * base);
  const Vec3 principal(built->body_inertia + 3 * base);
  const Matrix inertia =
      R * principal.asDiagonal() * R.transpose() + of_point(m1, p1 - p) + of_point(m2, p2 - p);
  mjtNum axes[9];
  mju_eig3(own_->body_inertia + 3 * base, axes, own_->body_iquat + 4 * base, inertia.data());
  std::copy_n(p.data(), 3, own_->body_ipos + 3 * base);
  own_->body_mass[base] = m1 + m2;
  if (m2 == 0) {  // as built, to the bit
    std::copy_n(built->body_inertia + 3 * base, 3, own_->body_inertia + 3 * base);
    std::copy_n(built->body_iquat + 4 * base, 4, own_->body_iquat + 4 * base);
    std::copy_n(p1.data(), 3, own_->body_ipos + 3 * base);
    own_->body_mass[base] = m1;
  }
  const DataPtr scratch = MakeData(own_.get());
  SetConstEngine(own_.get(), scratch.get());  // what the engine derives from masses
  InflateWheelBounds(own_.get());             // and from the wheels' cores alone
  KeepStiffness(built, own_.get());
  live_.model()->stat = own_->stat;
  live_.Refresh();
}

}  // namespace floorproof

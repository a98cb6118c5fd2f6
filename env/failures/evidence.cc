// SPDX-License-Identifier: Apache-2.0
#include "env/failures/evidence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "env/failures/effects.h"
#include "env/failures/footing.h"
#include "env/failures/posture.h"

namespace floorproof {
namespace {

constexpr double kGravity = 9.81;

double Weight(const RobotSpec& robot) { return robot.mass_kg * kGravity; }

// As a floor pushes, and no edge of it.
bool IsUpright(const Vec3& force_W_n) {
  constexpr double kAside = 0.05;
  return force_W_n.head<2>().norm() <= kAside * force_W_n.z();
}

}  // namespace

double HazardMemory::Holds(const RobotSpec& robot, const Sample& sample, const Touch& touch) {
  const BodyTwist& cmd = sample.command.twist;
  const Vec2 v_W = sample.X_WB().Rotate({cmd.vx_mps, cmd.vy_mps});
  const double speed_mps = v_W.norm() + std::abs(cmd.wz_radps) * robot.circumscribed_radius_m;
  if (speed_mps == 0) return 0;
  // Apart: on a ramp that holds it, a wheel's grip pushes on as hard as the slope pushes back.
  const auto against_w = [&](const Wrench& wrench) {
    return std::max(0.0, -wrench.Power(v_W, cmd.wz_radps));
  };
  return (against_w(touch.normal) + against_w(touch.friction)) / speed_mps / Weight(robot);
}

// By normal forces alone: the wheels' grip pushes whichever way the tracker steers.
double HazardMemory::PushesOff(const RobotSpec& robot, const Sample& sample, const Touch& touch) {
  const double off_m = sample.off_track_W.norm();
  const double aside_n =
      off_m > 0 ? touch.normal.force_W_n.head<2>().dot(sample.off_track_W) / off_m : 0;
  const double turning_n =
      robot.circumscribed_radius_m > 0
          ? std::abs(touch.normal.moment_W_nm.z()) / robot.circumscribed_radius_m
          : 0;
  return (std::max(0.0, aside_n) + turning_n) / Weight(robot);
}

double HazardMemory::Tilts(const RobotSpec& robot, const Sample& sample, const Touch& touch) {
  constexpr double kLevel = 0.01;  // rad: leans to no side
  const Mat3 R_WB = Attitude(sample);
  const Vec2 lean = LeanOf(R_WB);
  if (lean.norm() < kLevel || robot.circumscribed_radius_m == 0) return 0;
  const Vec2 down = lean.normalized();
  const Vec3 axis_W(-down.y(), down.x(), 0);  // turns the upright body to that side
  const Vec3 force_W_n = touch.normal.force_W_n + touch.friction.force_W_n;
  const Vec3 moment_W_nm = touch.normal.moment_W_nm + touch.friction.moment_W_nm -
                           (R_WB * robot.p_BCom).cross(force_W_n);
  return moment_W_nm.dot(axis_W) / robot.circumscribed_radius_m / Weight(robot);
}

double HazardMemory::Entry::At(double now_s) const {
  return impulse_s * std::exp((t_s - now_s) / kFade_s);
}

void HazardMemory::Start(const EpisodeContext& context) {
  map_ = &context.map;
  robot_ = &context.robot;
  timestep_s_ = context.timestep_s;
  entries_ = {};
  passive_ = {};
  now_s_ = 0;
  starts_ = true;
}

void HazardMemory::Update(const Sample& sample) {
  now_s_ = sample.t_s;
  if (starts_) floor_m_ = FloorUnder(*map_, *robot_, sample);
  starts_ = false;
  for (int i = 0; i < sample.num_touches; ++i) {
    const Touch& touch = sample.touches[static_cast<std::size_t>(i)];
    if (touch.hazard >= 0 && IsUpright(touch.normal.force_W_n) &&
        IsFloor(map_->hazards[static_cast<std::size_t>(touch.hazard)], floor_m_))
      continue;
    const double effect = effect_(*robot_, sample, touch);
    if (!(effect > 0)) continue;
    auto entry = std::ranges::find_if(
        entries_, [&](const Entry& e) { return e.impulse_s > 0 && e.hazard == touch.hazard; });
    if (entry == entries_.end()) {
      entry = std::ranges::min_element(
          entries_, {}, [&](const Entry& e) { return e.impulse_s > 0 ? e.At(now_s_) : 0; });
      *entry = {touch.hazard, 0, now_s_};
    }
    *entry = {touch.hazard, entry->At(now_s_) + effect * timestep_s_, now_s_};
  }
  if (sample.near_hazard < 0) return;
  const Hazard& near = map_->hazards[static_cast<std::size_t>(sample.near_hazard)];
  const bool slippery = near.material.friction && *near.material.friction < map_->floor_friction;
  if (IsGap(near, floor_m_) || slippery) passive_ = {sample.near_hazard, 0, now_s_};
}

std::string HazardMemory::Recall(double since_s) const {
  const Entry* most = nullptr;
  double least_s = kLeast * kFade_s;
  for (const Entry& entry : entries_) {
    if (entry.t_s < since_s || !(entry.At(now_s_) > least_s)) continue;
    least_s = entry.At(now_s_);
    most = &entry;
  }
  if (most != nullptr) return HazardId(*map_, most->hazard, true);
  return passive_.t_s >= since_s ? HazardId(*map_, passive_.hazard, false) : "";
}

Event MakeEvent(FailureMode mode, std::string_view kind, const Sample& sample, std::string hazard,
                double value, double threshold) {
  Event event;
  event.mode = mode;
  event.kind = kind;
  event.t_s = sample.t_s;
  event.x_m = sample.p_WB.x();
  event.y_m = sample.p_WB.y();
  event.yaw_rad = sample.yaw_rad;
  event.hazard = std::move(hazard);
  event.value = value;
  event.threshold = threshold;
  event.effect = EffectOf(mode, kind);
  return event;
}

}  // namespace floorproof

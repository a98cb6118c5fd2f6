// SPDX-License-Identifier: Apache-2.0
#include "tests/failures/synthetic.h"

#include <cmath>

namespace floorproof {

RobotSpec TestRobot() {
  RobotSpec robot;
  robot.drive = "differential";
  for (const double side : {1.0, -1.0}) {
    WheelSpec wheel;
    wheel.p_BW = {0, side * 0.12, 0.035};
    wheel.radius_m = 0.035;
    wheel.max_speed_radps = 20;
    robot.wheels.push_back(wheel);
  }
  robot.clear = {Shape2::Kind::kCircle, 0.18, {}};
  robot.circumscribed_radius_m = 0.18;
  robot.clearance_m = 0.025;
  robot.p_BCom = {0, 0, 0.08};
  robot.mass_kg = 10;
  robot.step_m = 0.015;
  robot.static_tip_rad = 0.6;
  return robot;
}

HazardMap TestMap() {
  HazardMap map;
  Hazard step;
  step.id = "sill";
  step.type = "step";
  step.hazard_class = HazardClass::kLevelChange;
  step.known = false;
  step.height_m = 0.040;
  step.footprint = {Rectangle({5, -1}, {6, 1})};
  Hazard glass = step;
  glass.id = "door";
  glass.type = "glass";
  glass.hazard_class = HazardClass::kGlass;
  glass.height_m = 2;
  map.hazards = {step, glass};
  return map;
}

const EpisodeContext& TestContext() {
  static const HazardMap map = TestMap();
  static const RobotSpec robot = TestRobot();
  static const EpisodeContext context{map, robot, kStepS};
  return context;
}

Trace Drive(const std::vector<Piece>& pieces) {
  Trace trace;
  Pose2 X_WB;
  double progress_m = 0;
  for (const Piece& piece : pieces) {
    const auto steps = static_cast<int>(std::lround(piece.duration_s / kStepS));
    for (int i = 0; i < steps; ++i) {
      const BodyTwist& v = piece.twist;
      X_WB = X_WB * Pose2{v.vx_mps * kStepS, v.vy_mps * kStepS, v.wz_radps * kStepS};
      Sample sample;
      sample.t_s = static_cast<double>(trace.size() + 1) * kStepS;
      sample.p_WB = {X_WB.x_m, X_WB.y_m, 0};
      sample.yaw_rad = X_WB.yaw_rad;
      sample.v_WB_W.head<2>() = X_WB.Rotate({v.vx_mps, v.vy_mps});
      sample.V_WB_B = v;
      sample.command.twist = v;
      sample.command.dwelling = piece.dwelling;
      sample.command.turning = v.vx_mps == 0 && v.vy_mps == 0 && v.wz_radps != 0;
      progress_m += std::hypot(v.vx_mps, v.vy_mps) * kStepS;
      sample.progress_m = progress_m;
      sample.cross_track_half_width_m = 1;
      sample.wheel_contacts = 3;
      sample.support_margin_m = 0.05;
      trace.push_back(sample);
    }
  }
  return trace;
}

Trace DriveInto(const Hit& hit) {
  Trace trace = Drive({{3.0, {hit.speed_mps, 0, 0}}});
  constexpr double kImpactS = 1.0;
  double x_m = 0;
  for (Sample& sample : trace) {
    const double t_s = sample.t_s - kImpactS;
    const double speed_mps = t_s < kStepS / 2 ? hit.speed_mps : hit.after(t_s);
    x_m += speed_mps * kStepS;
    sample.p_WB.x() = sample.progress_m = x_m;
    sample.v_WB_W.x() = sample.V_WB_B.vx_mps = speed_mps;
    if (t_s < -kStepS / 2) continue;
    if (t_s > kStepS / 2) sample.command.twist.vx_mps = hit.command_after_mps;
    if (t_s > hit.contact_s) continue;
    sample.num_contacts = 1;
    sample.contacts[0] = {-1, Vec2(x_m + 0.18, 0), Vec2(-1, 0), 0, speed_mps, 0.01, 0.05, false};
  }
  return trace;
}

Trace Mirrored(Trace trace) {
  for (Sample& s : trace) {
    s.p_WB.y() *= -1;
    s.v_WB_W.y() *= -1;
    for (BodyTwist* v : {&s.V_WB_B, &s.command.twist}) {
      v->vy_mps *= -1;
      v->wz_radps *= -1;
    }
    s.yaw_rad *= -1;
    s.roll_rad *= -1;
    s.off_track_W.y() *= -1;
    s.off_support_W.y() *= -1;
    for (Touch& touch : s.touches)
      for (Wrench* wrench : {&touch.normal, &touch.friction}) {
        wrench->force_W_n.y() *= -1;
        wrench->moment_W_nm.x() *= -1;
        wrench->moment_W_nm.z() *= -1;
      }
    for (ObstacleContact& contact : s.contacts) {
      contact.p_W.y() *= -1;
      contact.normal_W.y() *= -1;
    }
  }
  return trace;
}

Trace With(Trace trace, const std::function<void(Sample&)>& change, double from_s, double to_s) {
  for (Sample& sample : trace)
    if (sample.t_s > from_s - kStepS / 2 && sample.t_s < to_s - kStepS / 2) change(sample);
  return trace;
}

void PushedBy(Sample& sample, int hazard, const Vec3& force_W_n) {
  Touch& touch = sample.touches[static_cast<std::size_t>(sample.num_touches++)];
  touch = {hazard, {force_W_n, Vec3::Zero()}, {}};
}

Trace FailingTrace(FailureMode mode) {
  const Trace clean = Drive({{2, {0.2, 0, 0}}, {2, {0.2, 0.0, 0.5}}, {4, {0.2, 0, 0}}});
  switch (mode) {
    case FailureMode::kVeerOff:
      return With(
          clean, [](Sample& s) { s.cross_track_m = 0.6; }, 5);
    case FailureMode::kStuck:
      return With(Drive({{12, {0, 0, 0}}}), [](Sample& s) { s.command.twist.vx_mps = 0.2; });
    case FailureMode::kRollOver:
      return With(
          clean, [](Sample& s) { s.tilt_rad = 1.3; }, 5);
    case FailureMode::kBounceBack: {
      Hit hit;
      hit.after = [](double t_s) { return t_s < 0.1 ? -0.06 : 0.0; };
      return DriveInto(hit);
    }
  }
  return {};
}

std::vector<Event> Judge(Detector& dut, const Trace& trace) {
  std::vector<Event> events;
  dut.Start(TestContext());
  for (const Sample& sample : trace)
    if (dut.Update(sample)) events.push_back(dut.event());
  return events;
}

std::unique_ptr<Detector> MakeDetector(std::string_view name, const std::string& yaml) {
  auto dut = MakePlugin(Detectors(), name, "failures");
  if (!yaml.empty()) ReadParams(ParseYaml(yaml, "test.yaml"), "failures.", *dut);
  return dut;
}

}  // namespace floorproof

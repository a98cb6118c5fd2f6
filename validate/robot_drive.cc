// SPDX-License-Identifier: Apache-2.0
// Tolerances. Way: 3 %, a driver's droop under rolling friction, and 5 mm. Turn: 3 %, 2 deg, and
// for plain wheels half the share that a wheel's half width has of half the track: it rolls true on
// a line anywhere within its width. Braking: 20 % and 10 mm, by how the wheels lag.
#include "validate/robot_drive.h"

#include <fmt/format.h>

#include <algorithm>

namespace floorproof {
namespace {

// When each part begins, s.
constexpr double kStraight_s = 0.5, kBrake_s = 4, kTurn_s = 5.5, kHalt_s = 8.5, kEnd_s = 10;
constexpr double kRamp_s = 1;  // the longest, up to a speed or down from it
constexpr double kDegree = kPi / 180;
constexpr double kTurnShare = 0.8;  // of the yaw rate that the wheels can give

struct Limits {
  double speed_mps, accel_mps2, yaw_radps, yaw_accel_radps2;
  bool on_the_spot;
};

Limits LimitsOf(const RobotSpec& robot, const Drive& drive) {
  std::vector<double> wheels(robot.wheels.size());
  drive.ToWheels({0, 0, robot.max_yaw_rate_radps}, wheels);
  const double most_radps = std::abs(drive.ToTwist(wheels).wz_radps);
  const bool on_the_spot = drive.turns_on_the_spot();
  return {std::min(robot.cruise_mps, robot.max_accel_mps2 * kRamp_s), robot.max_accel_mps2,
          std::min({robot.max_yaw_rate_radps, robot.max_yaw_accel_radps2 * kRamp_s,
                    on_the_spot ? kTurnShare * most_radps : robot.max_yaw_rate_radps}),
          robot.max_yaw_accel_radps2, on_the_spot};
}

// The command at a time. A robot that cannot turn on the spot drives on while it turns.
BodyTwist Asked(const Limits& limits, double t_s) {
  const auto ramp = [&](double from_s, double until_s, double most, double accel) {
    if (t_s < from_s) return 0.0;
    const double top = std::min(most, accel * (until_s - from_s));
    return std::max(0.0, std::min({top, accel * (t_s - from_s), top - accel * (t_s - until_s)}));
  };
  const double straight = ramp(kStraight_s, kBrake_s, limits.speed_mps, limits.accel_mps2);
  const double turn = ramp(kTurn_s, kHalt_s, limits.yaw_radps, limits.yaw_accel_radps2);
  const double along =
      limits.on_the_spot ? 0 : ramp(kTurn_s, kHalt_s, limits.speed_mps, limits.accel_mps2);
  return {straight + along, 0, turn};
}

// How far each wheel has turned since the start, rad.
std::vector<double> WheelAngles(Rig& rig) {
  const mjModel* m = rig.sim().model();
  std::vector<double> angles;
  for (const WheelSpec& wheel : rig.robot().wheels) {
    const int joint = m->actuator_trnid[2 * mj_name2id(m, mjOBJ_ACTUATOR, wheel.name.c_str())];
    const int q = m->jnt_qposadr[joint];
    angles.push_back(rig.data()->qpos[q] - m->qpos0[q]);
  }
  return angles;
}

bool IsDriven(const mjModel* m, int body) {
  for (int a = 0; a < m->nu; ++a)
    if (m->jnt_bodyid[m->actuator_trnid[2 * a]] == body) return true;
  return false;
}

// Who carries what as it stands, and what of it drags.
void WeighWheels(Rig& rig, RobotDrive& out) {
  const mjModel* m = rig.sim().model();
  double driven_n = 0, all_n = 0, drag_n = 0;
  for (int c = 0; c < rig.data()->ncon; ++c) {
    const mjContact& contact = rig.data()->contact[c];
    for (const int geom : contact.geom) {
      if (geom < 0) continue;
      const auto kind = rig.scene().roles[static_cast<std::size_t>(geom)].kind;
      if (kind != GeomRole::Kind::kWheel && kind != GeomRole::Kind::kBody) continue;
      mjtNum force[6];
      mj_contactForce(m, rig.data(), c, force);
      const int body = m->geom_bodyid[geom];
      all_n += force[0];
      if (IsDriven(m, body)) driven_n += force[0];
      bool rolls = false;
      for (int j = m->body_jntadr[body]; j < m->body_jntadr[body] + m->body_jntnum[body]; ++j)
        rolls = rolls || m->jnt_type[j] == mjJNT_HINGE || m->jnt_type[j] == mjJNT_BALL;
      if (!rolls) drag_n += contact.friction[0] * force[0];
    }
  }
  for (const WheelSpec& wheel : rig.robot().wheels) {
    const int a = mj_name2id(m, mjOBJ_ACTUATOR, wheel.name.c_str());
    drag_n += m->dof_frictionloss[m->jnt_dofadr[m->actuator_trnid[2 * a]]] / wheel.radius_m;
  }
  out.driven_share = all_n > 0 ? driven_n / all_n : 0;
  out.rolling_n = drag_n;
}

// Where the robot is, and how far its wheels have rolled.
struct Moment {
  Pose2 X_WB;
  double speed_mps = 0;
  double rolled_m = 0, rolled_rad = 0;      // by its wheels' angles, since the start
  double expected_m = 0, expected_rad = 0;  // by the speeds commanded
};

class TenSeconds {
 public:
  TenSeconds(const std::string& robot, const WrongModel& wrong)
      : rig_(robot, {.wrong = wrong}),
        drive_(MakePlugin(Drives(), rig_.robot().drive, "drive")),
        wheels_(rig_.robot().wheels.size()),
        angles_rad_(WheelAngles(rig_)),
        step_rad_(wheels_.size()) {
    drive_->Configure(rig_.robot());
    limits_ = LimitsOf(rig_.robot(), *drive_);
    start_s_ = rig_.truth().t_s;
  }

  Moment Until(double t_s) {
    while (rig_.truth().t_s - start_s_ < t_s - 1e-9) {
      const double before_s = rig_.truth().t_s;
      const BodyTwist asked = Asked(limits_, before_s - start_s_);
      rig_.Command(asked);
      HingeState hinges = rig_.truth().hinges;
      drive_->ToWheels(asked, hinges, wheels_);
      const BodyTwist rolls = drive_->ToTwist(wheels_, hinges);
      rig_.Step();
      const double dt_s = rig_.truth().t_s - before_s;
      expected_m_ += rolls.vx_mps * dt_s;
      expected_rad_ += rolls.wz_radps * dt_s;
      AddRolled();
    }
    const Truth& truth = rig_.truth();
    turned_rad_ += WrapAngle(truth.yaw_rad - last_yaw_rad_);
    last_yaw_rad_ = truth.yaw_rad;
    return {truth.X_WB(), truth.v_WB_W.head<2>().norm(), rolled_m_, rolled_rad_, expected_m_,
            expected_rad_};
  }
  // Since the start, whole turns counted; asked for often enough.
  double turned_rad() const { return turned_rad_; }
  double tilt_rad() const { return rig_.truth().tilt_rad; }
  Rig& rig() { return rig_; }
  const Limits& limits() const { return limits_; }

 private:
  // By how far the wheels turned in this step, and where they point.
  void AddRolled() {
    const std::vector<double> angles = WheelAngles(rig_);
    for (std::size_t w = 0; w < angles.size(); ++w) step_rad_[w] = angles[w] - angles_rad_[w];
    const BodyTwist step = drive_->ToTwist(step_rad_, rig_.truth().hinges);
    rolled_m_ += step.vx_mps;
    rolled_rad_ += step.wz_radps;
    angles_rad_ = angles;
  }

  Rig rig_;
  std::unique_ptr<Drive> drive_;
  std::vector<double> wheels_, angles_rad_, step_rad_;
  Limits limits_{};
  double start_s_ = 0, expected_m_ = 0, expected_rad_ = 0, turned_rad_ = 0, last_yaw_rad_ = 0;
  double rolled_m_ = 0, rolled_rad_ = 0;
};

void Stand(TenSeconds& run, RobotDrive& out) {
  constexpr double kDrift_m = 0.002, kTilt_deg = 1.5;
  const Moment begun = run.Until(0.1), stands = run.Until(kStraight_s);
  WeighWheels(run.rig(), out);
  out.rows.push_back({"stand/drift", 0, (stands.X_WB.p() - begun.X_WB.p()).norm(), kDrift_m, "m"});
  out.rows.push_back({"stand/tilt", 0, run.tilt_rad() / kDegree, kTilt_deg, "deg"});
}

constexpr double kLag = 0.02;  // of what was commanded: beyond it the motors are to blame

std::string WayHint(double expected_m, double made_m, double rolled_m, double driven_share) {
  if (std::abs(rolled_m - expected_m) > kLag * expected_m)
    return fmt::format(
        "its wheels rolled {:.3f} m of {:.3f} m: the motors do not hold the speed; raise the stall "
        "torque or the driver's gain, or lower cruise_mps",
        rolled_m, expected_m);
  return fmt::format(
      "its wheels rolled {:.3f} m and it came {:.3f} m: they slip, with {:.0f} % of the weight on "
      "them; move the masses to the driven wheels, or lower the casters' friction",
      rolled_m, made_m, 100 * driven_share);
}

std::string TurnHint(double expected_deg, double turned_deg, double rolled_deg) {
  if (std::abs(rolled_deg - expected_deg) > kLag * std::abs(expected_deg))
    return fmt::format(
        "its wheels rolled for {:.0f} of {:.0f} deg: scrubbing tyres or casters hold the motors "
        "back; raise the stall torque or the driver's gain, or take narrower wheels",
        rolled_deg, expected_deg);
  return fmt::format(
      "its wheels rolled for {:.0f} deg and it turned {:.0f} deg: tyres scrub or casters hold it; "
      "take narrower wheels, or casters that slide or swivel",
      rolled_deg, turned_deg);
}

void Straight(TenSeconds& run, RobotDrive& out) {
  constexpr double kShare = 0.03, kWay_m = 0.005, kAsideShare = 0.02, kAside_m = 0.003;
  constexpr double kYaw_deg = 2;
  const Moment a = run.Until(kStraight_s), b = run.Until(kBrake_s);
  const Vec2 made_B = a.X_WB.Inverse() * b.X_WB.p();
  const double expected_m = b.expected_m - a.expected_m;
  out.rows.push_back({"straight/way", expected_m, made_B.x(), kShare * expected_m + kWay_m, "m"});
  out.rows.push_back({"straight/aside", 0, made_B.y(), kAsideShare * expected_m + kAside_m, "m"});
  out.rows.push_back(
      {"straight/yaw", 0, WrapAngle(b.X_WB.yaw_rad - a.X_WB.yaw_rad) / kDegree, kYaw_deg, "deg"});
  if (!out.rows[out.rows.size() - 3].ok())
    out.straight_hint = WayHint(expected_m, made_B.x(), b.rolled_m - a.rolled_m, out.driven_share);
}

void Brake(TenSeconds& run, RobotDrive& out) {
  constexpr double kShare = 0.2, kWay_m = 0.010, kRest_mps = 0.005;
  const Moment a = run.Until(kBrake_s), b = run.Until(kTurn_s);
  const double v_mps = run.limits().speed_mps;
  const double expected_m = v_mps * v_mps / (2 * run.limits().accel_mps2);
  out.rows.push_back({"brake/way", expected_m, (b.X_WB.p() - a.X_WB.p()).norm(),
                      kShare * expected_m + kWay_m, "m"});
  out.rows.push_back({"brake/rest", 0, b.speed_mps, kRest_mps, "m/s"});
}

// Of half the track: by how much the line on which wheels roll true may lie beside their middle.
double ScrubShare(const RobotSpec& robot) {
  double share = 0;
  if (robot.turn_radius_m > 0) return share;  // its wheels steer instead
  for (const WheelSpec& wheel : robot.wheels)
    if (wheel.roller_radius_m == 0)
      share = std::max(share, 0.5 * wheel.half_width_m / std::max(1e-3, std::abs(wheel.p_BW.y())));
  return share;
}

// Where a body turns about, in its first frame; it turned by `turned_rad`, no whole number of
// turns.
Vec2 TurnCentre(const Pose2& first, const Pose2& last, double turned_rad) {
  const Vec2 way = first.Inverse() * last.p();
  const double cot = 1 / std::tan(turned_rad / 2);
  return 0.5 * (way + cot * Vec2(-way.y(), way.x()));
}

// Ahead of the middle of the wheels, where a turn about `centre_B` is that of a skid-steer whose
// load lies off the middle: plain wheels on several axles slide less where they carry more. The
// point is at most a few times as far off as the load; a turn about one farther away has another
// cause.
std::optional<double> TurnsAboutItsLoad(const RobotSpec& robot, const Vec2& centre_B) {
  constexpr double kAxle_m = 0.010, kAside_m = 0.010, kLoad_m = 0.002, kLever = 5;
  const auto [rear, front] =
      std::ranges::minmax(robot.wheels, {}, [](const WheelSpec& wheel) { return wheel.p_BW.x(); });
  const double middle_m = (front.p_BW.x() + rear.p_BW.x()) / 2;
  const double half_base_m = (front.p_BW.x() - rear.p_BW.x()) / 2;
  const double load_m = robot.p_BCom.x() - middle_m, about_m = centre_B.x() - middle_m;
  const bool skids = half_base_m > kAxle_m && robot.wheels.front().roller_radius_m == 0;
  const bool by_load = std::abs(load_m) > kLoad_m && load_m * about_m > 0 &&
                       std::abs(about_m) <= std::min(half_base_m, kLever * std::abs(load_m));
  if (!skids || !by_load || std::abs(middle_m) > kAxle_m || std::abs(centre_B.y()) > kAside_m)
    return std::nullopt;
  return about_m;
}

void Turn(TenSeconds& run, RobotDrive& out) {
  constexpr double kShare = 0.03, kYaw_deg = 2, kOff_m = 0.010, kOffShare = 0.05;
  constexpr double kRest_mps = 0.005, kLook_s = 0.25;
  const Moment a = run.Until(kTurn_s);
  const double before_rad = run.turned_rad();
  Moment b = a;
  Vec2 centre_B = Vec2::Zero();  // by the moment that is nearest to half a turn from the start
  double half_turn = 0;
  for (double t_s = kTurn_s + kLook_s; t_s <= kEnd_s; t_s += kLook_s) {
    b = run.Until(t_s);
    const double so_far_rad = run.turned_rad() - before_rad;
    if (const double nearness = std::abs(std::sin(so_far_rad / 2)); nearness > half_turn) {
      half_turn = nearness;
      centre_B = TurnCentre(a.X_WB, b.X_WB, so_far_rad);
    }
  }
  const RobotSpec& robot = run.rig().robot();
  const double expected_deg = (b.expected_rad - a.expected_rad) / kDegree;
  const double turned_deg = (run.turned_rad() - before_rad) / kDegree;
  const double share = kShare + ScrubShare(robot);
  out.rows.push_back(
      {"turn/yaw", expected_deg, turned_deg, share * std::abs(expected_deg) + kYaw_deg, "deg"});
  if (!out.rows.back().ok())
    out.turn_hint = TurnHint(expected_deg, turned_deg, (b.rolled_rad - a.rolled_rad) / kDegree);
  if (run.limits().on_the_spot) {
    const LawRow off{"turn/off_the_spot", 0, (b.X_WB.p() - a.X_WB.p()).norm(),
                     kOff_m + kOffShare * 2 * robot.circumscribed_radius_m, "m"};
    if (!off.ok()) out.turns_about_m = TurnsAboutItsLoad(robot, centre_B);
    if (!out.turns_about_m) out.rows.push_back(off);
  }
  out.rows.push_back({"halt/rest", 0, b.speed_mps, kRest_mps, "m/s"});
}

}  // namespace

RobotDrive DriveTenSeconds(const std::string& robot, const WrongModel& wrong) {
  TenSeconds run(robot, wrong);
  RobotDrive out;
  Stand(run, out);
  Straight(run, out);
  Brake(run, out);
  Turn(run, out);
  return out;
}

}  // namespace floorproof

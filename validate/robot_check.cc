// SPDX-License-Identifier: Apache-2.0
#include "validate/robot_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validate/robot_findings.h"

namespace floorproof {
namespace {

// At full voltage, with its share of what holds the robot back: as a share of the speed without
// load (validate/laws/motors.cc).
double LoadedShare(const mjModel* m, const RobotSpec& robot, double rolling_n) {
  double share = 1;
  for (const WheelSpec& wheel : robot.wheels) {
    const int a = mj_name2id(m, mjOBJ_ACTUATOR, wheel.name.c_str());
    const mjtNum* gain = m->actuator_gainprm + mjNGAIN * a;
    const double damping = m->dof_damping[m->jnt_dofadr[m->actuator_trnid[2 * a]]];
    const double slope = gain[1] * gain[1] / gain[0];  // of torque over speed
    const double load_nm = rolling_n * wheel.radius_m / static_cast<double>(robot.wheels.size());
    const double speed_radps = (slope * wheel.max_speed_radps - load_nm) / (slope + damping);
    share = std::min(share, std::max(0.0, speed_radps) / wheel.max_speed_radps);
  }
  return share;
}

// What the wheels give at the motors' speeds without load, asked for far more.
void ReadTopSpeeds(const RobotModel& robot, RobotCheck& out) {
  constexpr double kFar = 1e4;
  const auto drive = MakePlugin(Drives(), out.spec.drive, "drive");
  drive->Configure(out.spec);
  std::vector<double> wheels(out.spec.wheels.size());
  const ModelPtr model = CompileAlone(robot);
  const double share = LoadedShare(model.get(), out.spec, out.drive.rolling_n);
  drive->ToWheels({kFar, 0, 0}, wheels);
  out.top_speed_mps = share * drive->ToTwist(wheels).vx_mps;
  if (!drive->turns_on_the_spot()) return;
  drive->ToWheels({0, 0, kFar}, wheels);
  out.top_yaw_radps = share * drive->ToTwist(wheels).wz_radps;
}

}  // namespace

std::string Finding::Line() const {
  const std::string text = mend.empty() ? what : what + ": " + mend;
  return (kind == Kind::kWrong ? "wrong: " : "note: ") + text;
}

bool RobotCheck::ok() const {
  return std::ranges::none_of(findings,
                              [](const Finding& f) { return f.kind == Finding::Kind::kWrong; });
}

RobotCheck CheckRobot(const std::string& name, const WrongModel& wrong) {
  const RobotModel robot = ReadRobot(FindRobotFile(name, {}));
  RobotCheck out;
  out.spec = robot.spec;
  out.stance = StanceOf(robot);
  out.drive = DriveTenSeconds(name, wrong);
  const auto [right, left] = std::ranges::minmax(
      out.spec.wheels, {}, [](const WheelSpec& wheel) { return wheel.p_BW.y(); });
  out.track_m = left.p_BW.y() - right.p_BW.y();
  for (const WheelSpec& wheel : out.spec.wheels)
    out.stall_force_n += wheel.max_torque_nm / wheel.radius_m;
  ReadTopSpeeds(robot, out);
  AddFindings(robot, out);
  return out;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "validate/audit_tour.h"

#include <Eigen/Dense>
#include <vector>

#include "controllers/tracker.h"

namespace floorproof {
namespace {

constexpr int kCalibrated = 1;  // the environment

// Round a square, counterclockwise: the first leg ahead of the robot.
Path SquareTour(const AuditTrial& trial, const AuditPace& pace) {
  const double leg_m = trial.path_m / trial.stops;
  Path path(1);
  for (int k = 0; k < trial.stops; ++k) {
    const int side = k % 4;
    const Vec2 way = side % 2 == 0 ? Vec2(1 - side, 0) : Vec2(0, 2 - side);
    Waypoint stop;
    stop.p_W = path.back().p_W + leg_m * way;
    stop.speed_mps = pace.speed_mps;
    stop.dwell_s = pace.dwell_s;
    path.push_back(stop);
  }
  return path;
}

}  // namespace

std::span<const AuditTrial> AuditTrials() {
  static constexpr AuditTrial kTable[] = {
      {"pso", 1, 29, 12.27, 470, 23'720},     {"aco", 1, 29, 9.5, 427, 22'550},
      {"zigzag", 1, 29, 16.33, 511, 27'980},  {"random", 1, 29, 25.15, 602, 31'780},
      {"pso", 2, 39, 37.66, 889, 44'820},     {"aco", 2, 39, 17.04, 642, 32'350},
      {"zigzag", 2, 39, 17.85, 665, 35'130},  {"random", 2, 39, 73.31, 1220, 64'440},
      {"pso", 3, 59, 58.21, 1320, 66'840},    {"aco", 3, 59, 23.8, 951, 47'890},
      {"zigzag", 3, 59, 53.42, 1248, 65'880}, {"random", 3, 59, 106.75, 1785, 94'390},
  };
  return kTable;
}

AuditRun DriveAudit(const AuditTrial& trial, const AuditPace& pace, const WrongModel& wrong) {
  constexpr int kStepsAControl = 5;
  constexpr double kLongest = 3;  // times the paper's time
  Rig rig("beluga", {.wrong = wrong});
  const double step_s = rig.scene().model->opt.timestep, control_s = kStepsAControl * step_s;
  const auto tracker = MakePlugin(Trackers(), DefaultTracker(rig.robot().drive), "controller");
  tracker->Start(SquareTour(trial, pace), rig.robot(), nullptr);
  AuditRun run;
  while (run.time_s < kLongest * trial.time_s) {
    const Truth& sample = rig.truth();
    const Command command =
        tracker->Update({sample.X_WB(), sample.V_WB_B, {}}, sample.t_s, control_s);
    if (command.done) return run;
    rig.Command(command.twist);
    for (int k = 0; k < kStepsAControl; ++k) {
      rig.Step();
      run.energy_j += sample.power_w * step_s;
    }
    run.time_s = sample.t_s;
  }
  throw InternalError("an audit's tour does not end");
}

AuditCalibration CalibrateAudit(const AuditPace& guess) {
  constexpr int kMaxRounds = 6;
  constexpr double kStill_s = 1e-3;  // of the dwell
  const double known_hotel_w = Rig("beluga").robot().hotel_load_w;
  std::vector<AuditTrial> trials;
  for (const auto& trial : AuditTrials())
    if (trial.environment == kCalibrated) trials.push_back(trial);
  const auto n = static_cast<Eigen::Index>(trials.size());
  Eigen::MatrixXd slope(n, 2);  // of T by dwell and by seconds a metre
  Eigen::VectorXd late_s(n), time_s(n), rest_j(n);
  AuditCalibration out{guess, 0};
  for (int round = 0; round < kMaxRounds; ++round) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const AuditTrial& trial = trials[static_cast<std::size_t>(i)];
      const AuditRun run = DriveAudit(trial, out.pace);
      slope.row(i) << trial.stops, trial.path_m;
      late_s[i] = trial.time_s - run.time_s;
      time_s[i] = run.time_s;
      rest_j[i] = trial.energy_j - (run.energy_j - known_hotel_w * run.time_s);
    }
    out.hotel_load_w = time_s.dot(rest_j) / time_s.squaredNorm();
    const Eigen::Vector2d change = slope.colPivHouseholderQr().solve(late_s);
    if (std::abs(change[0]) < kStill_s) break;
    out.pace.dwell_s += change[0];
    out.pace.speed_mps = 1 / (1 / out.pace.speed_mps + change[1]);
  }
  return out;
}

}  // namespace floorproof

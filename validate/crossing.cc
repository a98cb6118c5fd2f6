// SPDX-License-Identifier: Apache-2.0
#include "validate/crossing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "controllers/drive.h"
#include "controllers/tracker.h"
#include "env/core/driven_floor.h"
#include "env/failures/detector.h"
#include "env/sim/simulation.h"
#include "run/episode/path_error.h"

namespace floorproof {
namespace {

constexpr int kControlHz = 50;     // a scenario's default
constexpr double kLag_s = 0.15;    // wheels reach their speed some 0.1 s late
constexpr double kRunOut_m = 1.5;  // the plan ends this far beyond: it does not slow down before

// A bench of 12 x 12 m without walls near.
HazardMap Bench(Hazard hazard, double friction) {
  constexpr int kCells = 12;
  HazardMap map;
  map.frame = {kCells, kCells, 1.0, {-kCells / 2.0, -kCells / 2.0, 0}};
  map.occupancy = Grid<CellState>(kCells, kCells);
  map.floor_friction = friction;
  map.hazards = {std::move(hazard)};
  return map;
}

Path PathOver(const CrossingPlan& plan, double from_m) {
  const Vec2 along(std::cos(plan.travel_rad), std::sin(plan.travel_rad));
  Path path(2);
  path[0].p_W = -from_m * along;
  path[1].p_W = (plan.beyond_m + kRunOut_m) * along;
  for (Waypoint& waypoint : path) {
    waypoint.yaw_rad = plan.yaw_rad;
    waypoint.speed_mps = plan.speed_mps;
  }
  return path;
}

// Notices when the robot makes no more progress.
class Progress {
 public:
  explicit Progress(double speed_mps) : least_m_(0.02 * speed_mps * kWindow_s) {}
  // False when it moved by less than that within the window; `s_m` is measured along the way.
  bool Update(double s_m, double t_s) {
    if (s_m > mark_m_ + least_m_) {
      mark_m_ = s_m;
      mark_s_ = t_s;
    }
    return t_s - mark_s_ < kWindow_s;
  }

 private:
  static constexpr double kWindow_s = 2;
  double least_m_, mark_m_ = -1e9, mark_s_ = 0;
};

std::string Why(const Event& event) {
  std::string why(Name(event.mode));
  return event.kind.empty() ? why : why + "/" + event.kind;
}

}  // namespace

CrossingResult Cross(const RobotModel& model, Hazard hazard, const CrossingPlan& plan) {
  const RobotSpec& robot = model.spec;
  const HazardMap map = Bench(std::move(hazard), plan.friction);
  const double run_up_m = plan.run_up_m + kLag_s * plan.speed_mps +
                          plan.speed_mps * plan.speed_mps / (2 * robot.max_accel_mps2);
  // An edge met at an angle comes nearer to the circle that the robot fits in.
  const double from_m = robot.circumscribed_radius_m / std::cos(plan.travel_rad) + run_up_m;
  const Path path = PathOver(plan, from_m);
  const Pose2 start{path[0].p_W.x(), path[0].p_W.y(), plan.yaw_rad};
  const Vec2 along = (path[1].p_W - path[0].p_W).normalized();

  const Scene scene = BuildScene(map, model, plan.physics, start);
  Simulation sim(scene, map, robot);
  sim.Reset(start);
  const auto drive = MakePlugin(Drives(), robot.drive, "drive");
  drive->Configure(robot);
  const auto tracker = MakePlugin(Trackers(), DefaultTracker(robot.drive), "controller");
  const ClearanceField clearance =
      ClearanceOnTheWay(map, LevelChangesOnTheWay(map, path), robot.step_m);
  tracker->Start(path, robot, &clearance);
  std::vector<std::unique_ptr<Detector>> detectors;
  for (const auto& entry : Detectors()) {
    detectors.push_back(entry.make());
    detectors.back()->Start({map, robot, plan.physics.timestep_s});
  }

  const double limit_s = 10 + 4 * (from_m + plan.beyond_m) / plan.speed_mps;
  const auto steps_a_control = std::lround(1.0 / kControlHz / plan.physics.timestep_s);
  std::vector<double> wheels(robot.wheels.size());
  Progress progress(plan.speed_mps);
  Sample sample;
  static_cast<Truth&>(sample) = sim.truth();
  for (std::int64_t step = 0;; ++step) {
    if (step % steps_a_control == 0) {
      const Estimate estimate = {sample.X_WB(), sample.V_WB_B, sample.hinges};
      sample.command = tracker->Update(estimate, sample.t_s, 1.0 / kControlHz);
      sample.command.hinges.TakeSteering(sample.hinges);
      drive->ToWheels(sample.command.twist, sample.command.hinges, wheels);
      sim.SetWheelSpeeds(wheels);
      sim.SetHingeSpeeds(sample.command.hinges);
    }
    if (!sim.Step()) throw InternalError("the physics diverged on the ladder: " + sim.divergence());
    static_cast<Truth&>(sample) = sim.truth();
    sample.off_track_W = OffTrack(path, sample.command.segment, sample.p_WB.head<2>());
    sample.cross_track_m = sample.off_track_W.norm();
    const double s_m = sample.p_WB.head<2>().dot(along);
    const auto held = [&](std::string by) {
      return CrossingResult{false, std::move(by), sample.t_s, s_m};
    };
    for (auto& detector : detectors)
      if (detector->Update(sample)) return held(Why(detector->event()));
    if (s_m > plan.beyond_m) return {true, "", sample.t_s, s_m};
    if (plan.early && !progress.Update(s_m, sample.t_s)) return held("no progress");
    if (sample.t_s > limit_s) return held("time");
  }
}

}  // namespace floorproof

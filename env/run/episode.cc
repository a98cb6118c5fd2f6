// SPDX-License-Identifier: Apache-2.0
#include "env/run/episode.h"

#include <algorithm>
#include <cmath>

#include "env/run/plan_file.h"

namespace floorproof {
namespace {

// Half the free width across the tracked segment at the robot: the plan's neighbourhood as built,
// by stepping sideways through the clearance field, at most kMost to either side.
double HalfWidth(const ClearanceField& clearance, const Path& path, std::size_t segment,
                 const Vec2& p_W) {
  constexpr double kMost_m = 1.0, kTouch_m = 0.02;
  if (segment + 1 >= path.size()) return kMost_m;
  const Vec2 &a = path[segment].p_W, &b = path[segment + 1].p_W;
  const double length = (b - a).norm();
  if (length < 1e-9) return kMost_m;
  const Vec2 on_path = a + NearestFraction(a, b, p_W) * (b - a);
  const Vec2 left((a - b).y() / length, (b - a).x() / length);
  double width = 0;
  for (const double side : {1.0, -1.0}) {
    double s = 0;
    while (s < kMost_m) {
      const double free = clearance.At(on_path + side * s * left);
      if (free < kTouch_m) break;
      s += free;
    }
    width += std::min(s, kMost_m);
  }
  return width / 2;
}

double CrossTrack(const Path& path, std::size_t segment, const Vec2& p_W) {
  if (path.size() < 2) return (path.front().p_W - p_W).norm();
  segment = std::min(segment, path.size() - 2);
  return DistanceToSegment(path[segment].p_W, path[segment + 1].p_W, p_W);
}

// Keeps what an episode leaves behind. Allocates up front; a longer episode than planned for grows
// by halves.
class Recorder {
 public:
  Recorder(const Scenario& s, const SweepArea& area, double expected_s)
      : area_(area), meter_(area, s.robot.robot.tool), dt_s_(s.physics.timestep_s) {
    trace_every_ = s.episode.control_hz / s.episode.trace_hz;
    record.trace.reserve(
        static_cast<std::size_t>(std::min(2e6, (expected_s + 60) * s.episode.trace_hz)));
  }

  void OnControl(const Sample& sample, const Estimate& estimate) {
    meter_.Add(sample.X_WB());
    if (control_++ % trace_every_ != 0) return;
    const auto f = [](double v) { return static_cast<float>(v); };
    const BodyTwist& cmd = sample.command.twist;
    record.trace.push_back(
        {sample.t_s, f(sample.p_WB.x()), f(sample.p_WB.y()), f(sample.p_WB.z()), f(sample.roll_rad),
         f(sample.pitch_rad), f(sample.yaw_rad), f(sample.V_WB_B.vx_mps), f(sample.V_WB_B.vy_mps),
         f(sample.V_WB_B.wz_radps), f(cmd.vx_mps), f(cmd.vy_mps), f(cmd.wz_radps),
         f(estimate.X_WB.x_m), f(estimate.X_WB.y_m), f(estimate.X_WB.yaw_rad),
         f(sample.cross_track_m), f(sample.power_w), f(meter_.coverage())});
  }

  void OnStep(const Sample& sample) {
    Metrics& m = record.metrics;
    ++record.steps;
    m.path_length_m += std::hypot(sample.v_WB_W.x(), sample.v_WB_W.y()) * dt_s_;
    m.energy_j += sample.power_w * dt_s_;
    m.max_cross_track_m = std::max(m.max_cross_track_m, sample.cross_track_m);
    cross_track_sum_ += sample.cross_track_m;
    if (sample.num_contacts > 0) {
      // A body pressed against a wall lets go for single steps; that is one meeting.
      constexpr double kApart_s = 0.25;
      if (sample.t_s - last_touch_s_ > kApart_s) ++m.contacts;
      last_touch_s_ = sample.t_s;
    }
    for (int i = 0; i < sample.num_contacts; ++i)
      m.max_impulse_ns =
          std::max(m.max_impulse_ns, sample.contacts[static_cast<std::size_t>(i)].impulse_ns);
  }

  double coverage() const { return meter_.coverage(); }

  EpisodeRecord Finish(const Sample& last, const PlanResult& plan,
                       const std::vector<std::unique_ptr<Detector>>& detectors) {
    Metrics& m = record.metrics;
    meter_.Add(last.X_WB());
    m.coverage = meter_.coverage();
    m.overlap = meter_.overlap();
    m.duration_s = last.t_s;
    m.mean_cross_track_m =
        record.steps > 0 ? cross_track_sum_ / static_cast<double>(record.steps) : 0;
    m.turns = CountTurns(plan.path);
    for (const auto& detector : detectors)
      record.margins.push_back({std::string(Name(detector->mode())), detector->margin()});
    record.passes = meter_.passes();
    record.passes_frame = area_.frame;
    record.sweepable = area_.sweepable;
    return std::move(record);
  }

  EpisodeRecord record;

 private:
  const SweepArea& area_;
  CoverageMeter meter_;
  double dt_s_, cross_track_sum_ = 0;
  int trace_every_ = 1;
  std::int64_t control_ = 0;
  double last_touch_s_ = -1e9;
};

}  // namespace

std::string_view Name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kSuccess:
      return "success";
    case Outcome::kFailure:
      return "failure";
    case Outcome::kTimeout:
      return "timeout";
    case Outcome::kNotPlanned:
      return "not_planned";
    case Outcome::kError:
      return "error";
    case Outcome::kInterrupted:
      return "interrupted";
  }
  return "?";
}

double PlanDuration(const Path& path, double cruise_mps) {
  double t_s = path.empty() ? 0 : path.front().dwell_s;
  for (std::size_t i = 1; i < path.size(); ++i)
    t_s += (path[i].p_W - path[i - 1].p_W).norm() /
               (path[i].speed_mps > 0 ? path[i].speed_mps : cruise_mps) +
           path[i].dwell_s;
  return t_s;
}

PlanResult MakePlan(const Scenario& s) {
  if (s.planner) {
    const HazardMap known = KnownPart(s.site.map);
    return s.planner->Plan(
        {known, s.robot.robot, s.start, s.goal, static_cast<std::uint64_t>(s.episode.seed)});
  }
  PlanResult plan;
  plan.path = ReadPlan(s.plan_file, s.site.map.frame);
  // A user's plan need not begin where the robot stands: it drives there first, and is judged on
  // the way as on any other.
  if ((plan.path.front().p_W - s.start.p()).norm() > 1e-6) {
    Waypoint start;
    start.p_W = s.start.p();
    plan.path.insert(plan.path.begin(), start);
  }
  plan.status = PlanStatus::kSuccess;
  plan.clear = s.robot.robot.clear;
  plan.tool = s.robot.robot.tool;
  plan.tool_width_m = s.robot.robot.tool_width_m;
  return plan;
}

EpisodeRecord RunEpisode(Scenario& s, const Scene& scene, const PlanResult& plan,
                         EpisodeObserver* observer) {
  const RobotSpec& robot = s.robot.robot;
  const HazardMap& map = s.site.map;
  const HazardMap known = KnownPart(map);
  const ClearanceField clearance = ComputeClearance(known, robot.step_m);
  const SweepArea area = ComputeSweepArea(map, robot.clear, robot.tool, robot.step_m, s.start.p());
  const double plan_s = PlanDuration(plan.path, robot.cruise_mps);
  const double limit_s = s.episode.time_limit_s.value_or(60 + 3 * plan_s);
  const double control_s = 1.0 / s.episode.control_hz, plan_m = Length(plan.path);
  const auto steps_a_control =
      static_cast<std::int64_t>(std::round(control_s / s.physics.timestep_s));

  Recorder recorder(s, area, plan_s);
  EpisodeRecord& record = recorder.record;
  const auto drive = MakePlugin(Drives(), robot.drive, "drive");
  drive->Configure(robot);
  std::vector<double> wheels(robot.wheels.size());
  Simulation sim(scene, map, robot);
  Sample& sample = sim.sample();
  sim.Reset(s.start);
  s.estimator->Start(s.start);
  s.tracker->Start(plan.path, robot, &clearance);
  for (auto& detector : s.detectors) detector->Start({map, robot, s.physics.timestep_s});

  for (std::int64_t step = 0;; ++step) {
    if (step % steps_a_control == 0) {
      const Estimate estimate = s.estimator->Update(sample, control_s);
      sample.command = s.tracker->Update(estimate, sample.t_s, control_s);
      sample.command.cross_track_half_width_m =
          HalfWidth(clearance, plan.path, sample.command.segment, sample.p_WB.head<2>());
      drive->ToWheels(sample.command.twist, wheels);
      sim.SetWheelSpeeds(wheels);
      recorder.OnControl(sample, estimate);
      const double done = plan_m > 0 ? recorder.record.metrics.path_length_m / plan_m : 1;
      if (observer && !observer->OnControl(sim, recorder.coverage(), done)) {
        record.outcome = Outcome::kInterrupted;
        break;
      }
      if (sample.command.done) {
        record.outcome = record.events.empty() ? Outcome::kSuccess : Outcome::kFailure;
        break;
      }
      if (sample.t_s >= limit_s) {
        record.outcome = record.events.empty() ? Outcome::kTimeout : Outcome::kFailure;
        break;
      }
    }
    if (!sim.Step()) {
      record.outcome = Outcome::kError;
      record.message = "the physics diverged";
      break;
    }
    sample.cross_track_m = CrossTrack(plan.path, sample.command.segment, sample.p_WB.head<2>());
    recorder.OnStep(sample);
    bool failed = false;
    for (auto& detector : s.detectors) {
      if (!detector->Update(sample)) continue;
      record.events.push_back(detector->event());
      failed = true;
    }
    if (failed && s.episode.on_failure == "stop") {
      record.outcome = Outcome::kFailure;
      break;
    }
  }
  EpisodeRecord out = recorder.Finish(sample, plan, s.detectors);
  if (out.outcome == Outcome::kSuccess && out.metrics.coverage < s.episode.min_coverage) {
    out.outcome = Outcome::kFailure;
    out.message =
        "coverage " + FormatDouble(out.metrics.coverage) + " is below success.min_coverage";
  }
  return out;
}

}  // namespace floorproof

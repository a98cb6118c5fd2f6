// SPDX-License-Identifier: Apache-2.0
#include "run/episode/episode.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/streams.h"
#include "run/episode/intervention.h"
#include "run/episode/path_error.h"
#include "run/episode/pilot.h"
#include "run/episode/recorder.h"
#include "run/scenario/plan_file.h"

namespace floorproof {

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
  constexpr double kFold_s = 30;  // for each change of shape: three hinges, half a turn each
  double t_s = path.empty() ? 0 : path.front().dwell_s;
  for (std::size_t i = 1; i < path.size(); ++i)
    t_s += (path[i].p_W - path[i - 1].p_W).norm() /
               (path[i].speed_mps > 0 ? path[i].speed_mps : cruise_mps) +
           path[i].dwell_s + (path[i].shape != path[i - 1].shape ? kFold_s : 0);
  return t_s;
}

PlanResult MakePlan(const Scenario& s) {
  const RobotSpec& robot = s.robot.spec;
  const HazardMap known = KnownPart(s.site.map);
  auto risk = std::make_shared<const RiskMap>(ComputeRisk(known, robot, s.fmea, s.risk));
  PlanResult plan;
  if (s.planner) {
    Stream stream(static_cast<std::uint64_t>(s.episode.seed), s.episode_id, "plan");
    plan = s.planner->Plan({known, robot, s.start, s.goal, stream.Next(), risk.get()});
  } else {
    plan.path = s.user_plan;
    // A user's plan need not begin where the robot stands: it drives there first, and is judged on
    // the way as on any other.
    if ((plan.path.front().p_W - s.start.p()).norm() > 1e-6) {
      Waypoint start;
      start.p_W = s.start.p();
      plan.path.insert(plan.path.begin(), start);
    }
    plan.status = PlanStatus::kSuccess;
    plan.clear = robot.clear;
    plan.tool = robot.tool;
    plan.tool_width_m = robot.tool_width_m;
  }
  plan.risk = std::move(risk);
  return plan;
}

EpisodeRecord RunEpisode(Scenario& s, const Scene& scene, const PlanResult& plan,
                         EpisodeObserver* observer) {
  const RobotSpec& robot = s.robot.spec;
  const HazardMap known = KnownPart(s.site.map);
  const SweepArea area =
      ComputeSweepArea(s.site.map, robot.clear, robot.tool, robot.step_m, s.start.p());
  const double plan_s = PlanDuration(plan.path, robot.cruise_mps),
               plan_m = std::max(Length(plan.path), 1e-9);
  const double limit_s = s.episode.time_limit_s.value_or(60 + 3 * plan_s);
  const auto steps_a_control = std::lround(1.0 / (s.episode.control_hz * s.physics.timestep_s));

  Recorder recorder(s, area, *plan.risk, plan_s);
  Simulation sim(scene, s.site.map, robot);
  Sample& sample = sim.sample();
  sim.Reset(s.start);
  Pilot pilot(s, scene, known, plan);
  pilot.Start(sim);
  Interventions helper(s);
  const auto start_detectors = [&] {
    for (auto& detector : s.detectors) detector->Start({s.site.map, robot, s.physics.timestep_s});
  };
  start_detectors();

  std::optional<Outcome> ended;
  for (std::int64_t step = 0; !ended; ++step) {
    if (step % steps_a_control == 0) {
      if (helper.awaited())
        pilot.Stand(sim);
      else
        pilot.Control(sim);
      recorder.OnControl(sample, pilot.estimate());
      if (sample.command.done) ended = Outcome::kSuccess;
      if (sample.t_s >= limit_s + helper.extra_s()) ended = Outcome::kTimeout;
      if (observer && !observer->OnControl({sim, pilot.sensed(), pilot.estimate(),
                                            recorder.coverage(), recorder.driven_m() / plan_m}))
        ended = Outcome::kInterrupted;
      if (ended) break;
      if (helper.HasCome(sample.t_s)) {  // after sensing: a bump was where it lay
        recorder.OnIntervention(helper.SetDown(sim, pilot), s.detectors);
        start_detectors();
      }
    }

    if (!sim.Step()) {
      ended = Outcome::kError;
      break;
    }
    sample.cross_track_m = CrossTrack(pilot.path(), sample.command.segment, sample.p_WB.head<2>());
    recorder.OnStep(sample);
    pilot.OnStep(sample);

    if (helper.awaited()) continue;  // that it does not get on is known
    bool failed = false;
    for (auto& detector : s.detectors) {
      if (!detector->Update(sample)) continue;
      recorder.OnEvent(detector->event());
      failed = true;
    }
    if (failed && s.episode.on_failure != "ignore" && !helper.Call(pilot.path(), sample))
      ended = Outcome::kFailure;
  }
  EpisodeRecord record = recorder.Finish(*ended, sample, plan, pilot, s.detectors,
                                         s.episode.min_coverage, sim.battery().left());
  if (record.message.empty()) record.message = helper.why_not();
  return record;
}

}  // namespace floorproof

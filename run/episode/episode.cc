// SPDX-License-Identifier: Apache-2.0
#include "run/episode/episode.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/streams.h"
#include "env/sim/physics_plant.h"
#include "run/episode/intervention.h"
#include "run/episode/make_plan.h"
#include "run/episode/path_error.h"
#include "run/episode/plan_navigator.h"
#include "run/episode/recorder.h"
#include "run/episode/robot_side.h"

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

namespace {

Stream StreamOf(const Scenario& s, const std::string& name) {
  return {static_cast<std::uint64_t>(s.episode.seed), s.episode_id, name};
}

void StartDetectors(Scenario& s) {
  for (auto& detector : s.detectors)
    detector->Start({s.site.map, s.robot.spec, s.physics.timestep_s});
}

// True when one of them fired; all see every sample.
bool Detect(Scenario& s, const Sample& sample, Recorder& recorder) {
  bool failed = false;
  for (auto& detector : s.detectors) {
    if (!detector->Update(sample)) continue;
    recorder.OnEvent(detector->event());
    failed = true;
  }
  return failed;
}

}  // namespace

EpisodeRecord RunEpisode(Scenario& s, const Scene& scene, const PlanResult& plan,
                         EpisodeObserver* observer) {
  PhysicsPlant plant(scene, s.site.map, s.robot.spec, s.sensors, 1.0 / s.episode.control_hz,
                     [&s](const std::string& name) { return StreamOf(s, name); });
  return RunEpisode(s, plant, &plant.simulation(), plan, observer);
}

EpisodeRecord RunEpisode(Scenario& s, Plant& plant, Simulation* simulation, const PlanResult& plan,
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
  Interventions interventions(s);
  PlanNavigator navigator(plan, known, robot, s.recovery ? &*s.recovery : nullptr);
  RobotSide side(robot, known, navigator,
                 {*s.tracker, *s.estimator, s.mapper ? &*s.mapper : nullptr,
                  s.recovery ? &*s.recovery : nullptr},
                 1.0 / s.episode.control_hz);
  Observation sensed;
  Sample sample;
  const auto look = [&] { static_cast<Truth&>(sample) = plant.truth(); };
  const auto act = [&](const Actuation& actuation) {
    plant.Apply(actuation);
    sample.command = side.command();
    sample.command.hinges = actuation.hinges;
    sample.cross_track_half_width_m =
        HalfWidth(side.clearance(), side.path(), sample.command.segment, sample.p_WB.head<2>());
  };
  plant.Reset(s.start, sensed);
  look();
  side.Start(s.start, StreamOf(s, "estimator"));
  StartDetectors(s);

  std::optional<Outcome> ended;
  for (std::int64_t step = 0; !ended; ++step) {
    if (step % steps_a_control == 0) {
      plant.Sense(sensed);
      act(interventions.awaited() ? side.Stand(sensed) : side.Control(sensed));
      recorder.OnControl(sample, side.estimate());
      if (sample.command.done) ended = Outcome::kSuccess;
      if (sample.t_s >= limit_s + interventions.extra_s()) ended = Outcome::kTimeout;
      if (observer && !observer->OnControl({sample, sensed, side.estimate(), simulation,
                                            recorder.coverage(), recorder.driven_m() / plan_m}))
        ended = Outcome::kInterrupted;
      if (ended) break;
      if (interventions.HasCome(sample.t_s)) {  // after sensing: a bump was where it lay
        recorder.OnIntervention(interventions.SetDown(plant, side), s.detectors);
        look();
        act(side.actuation());
        StartDetectors(s);
      }
    }
    const bool good = plant.Step();
    look();
    if (!good) {
      ended = Outcome::kError;
      break;
    }
    sample.cross_track_m = CrossTrack(side.path(), sample.command.segment, sample.p_WB.head<2>());
    recorder.OnStep(sample);
    if (interventions.awaited()) continue;  // that it does not get on is known
    if (Detect(s, sample, recorder) && s.episode.on_failure != "ignore" &&
        !interventions.Call(side.path(), sample))
      ended = Outcome::kFailure;
  }
  EpisodeRecord record = recorder.Finish(*ended, sample, plan, side, s.detectors,
                                         s.episode.min_coverage, plant.battery_left());
  if (record.message.empty()) record.message = interventions.why_not();
  return record;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Gathers an episode's record while it is driven.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "env/failures/detector.h"
#include "planners/risk/risk_meter.h"
#include "run/episode/driven_way.h"
#include "run/episode/episode.h"
#include "run/episode/robot_side.h"
#include "run/episode/sample_log.h"
#include "run/episode/tool_meter.h"

namespace floorproof {

struct ScenarioSpec;
struct World;

// Keeps what an episode leaves behind. Allocates up front; a longer episode than expected grows by
// halves.
class Recorder {
 public:
  // All outlive it.
  Recorder(const ScenarioSpec& spec, const World& world, const SweepArea& area,
           const PlanResult& plan);

  // Before the drive: how long it will take.
  void Expect(double duration_s);

  // What the tool swept until now; the next OnControl, of the same moment, finds it done.
  void Sweep(const Sample& sample);

  void OnControl(const Sample& sample, const Estimate& estimate);

  void OnStep(const Sample& sample);

  void OnEvent(const Event& event) { record_.events.push_back(event); }

  // Before the detectors start afresh. What the tool is carried over is not swept.
  void OnIntervention(const Intervention& assist, const std::vector<NamedDetector>& detectors);

  // The same of a robot that something has carried off.
  void OnCarried(const std::vector<NamedDetector>& detectors);

  const std::vector<Event>& events() const { return record_.events; }
  const CoverageMeter& swept() const { return meter_.swept(); }
  double coverage() const { return meter_.swept().coverage(); }
  double driven_m() const { return record_.metrics.path_length_m; }

  // `ended`: why the loop stopped. A drive that was completed, or that ran out of time, is a
  // failure when something failed on the way, helped or not; a completed one that covered too
  // little is one as well.
  EpisodeRecord Finish(Outcome ended, const Sample& last, const RobotSide& side,
                       const std::vector<NamedDetector>& detectors, double min_coverage,
                       std::optional<double> battery_left);

 private:
  // What the robot noticed beside what was broken, which it is not told.
  void MeasureSafety(const Supervisor& supervisor);

  // Of the body; wheels meet every edge that they climb.
  void AddContacts(const Sample& sample);
  void AddEstimateError(double error_m);
  void FinishEstimateError();

  // Of the speed that is commanded, what is missing in its direction.
  static double LostSpeed(const Sample& sample);

  // The least share of all that the detectors said since each of their starts.
  void KeepMargins(const std::vector<NamedDetector>& detectors);

  EpisodeRecord record_;
  const SweepArea& area_;
  ToolMeter meter_;
  bool is_swept_ = false;  // up to the present moment
  RiskMeter risk_;
  SampleLog samples_;
  bool asks_for_risk_;
  double dt_s_, cross_track_sum_ = 0, estimate_error_sum_ = 0, position_std_sum_ = 0;
  static constexpr double kMaxMm = 10000;  // errors beyond are counted together
  std::vector<std::int64_t> errors_mm_ =
      std::vector<std::int64_t>(static_cast<std::size_t>(kMaxMm));
  int trace_hz_, trace_every_;
  double first_fault_s_ = std::numeric_limits<double>::infinity();
  std::int64_t control_ = 0;
  // The last time that the body touched something, and the way driven until then.
  double last_touch_s_ = -1e9, last_touch_m_ = 0;
  DrivenWay way_;
  double empty_s_ = -1;  // when the battery had cut off; -1: it has not
};

}  // namespace floorproof

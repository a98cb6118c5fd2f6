// SPDX-License-Identifier: Apache-2.0
#include "run/episode/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "run/scenario/scenario_spec.h"
#include "run/scenario/world.h"

namespace floorproof {

Recorder::Recorder(const ScenarioSpec& spec, const World& world, const SweepArea& area,
                   const PlanResult& plan)
    : area_(area),
      meter_(area, world.robot.spec),
      risk_(*plan.risk),
      samples_(plan.samples.size()),
      asks_for_risk_(AsksForRisk(spec)),
      dt_s_(world.physics.timestep_s),
      trace_hz_(spec.episode.trace_hz),
      trace_every_(spec.episode.control_hz / spec.episode.trace_hz) {
  for (const ScheduledFault& fault : world.faults)
    first_fault_s_ = std::min(first_fault_s_, fault.timing.onset_s);
}

void Recorder::Expect(double duration_s) {
  record_.trace.reserve(static_cast<std::size_t>(std::min(2e6, (duration_s + 60) * trace_hz_)));
}

void Recorder::Sweep(const Sample& sample) {
  meter_.Take(sample.shape);
  meter_.Add(sample.X_WB());
  is_swept_ = true;
}

void Recorder::OnControl(const Sample& sample, const Estimate& estimate) {
  if (!is_swept_) Sweep(sample);
  is_swept_ = false;
  risk_.Add(sample.p_WB.head<2>());
  samples_.OnControl(sample);
  AddEstimateError((estimate.X_WB.p() - sample.p_WB.head<2>()).norm());
  position_std_sum_ += estimate.position_std_m;
  if (control_++ % trace_every_ != 0) return;
  const auto f = [](double v) { return static_cast<float>(v); };
  const BodyTwist& cmd = sample.command.twist;
  record_.trace.push_back({.t_s = sample.t_s,
                           .x_m = sample.p_WB.x(),
                           .y_m = sample.p_WB.y(),
                           .est_x_m = estimate.X_WB.x_m,
                           .est_y_m = estimate.X_WB.y_m,
                           .z_m = f(sample.p_WB.z()),
                           .roll_rad = f(sample.roll_rad),
                           .pitch_rad = f(sample.pitch_rad),
                           .yaw_rad = f(sample.yaw_rad),
                           .vx_mps = f(sample.V_WB_B.vx_mps),
                           .vy_mps = f(sample.V_WB_B.vy_mps),
                           .wz_radps = f(sample.V_WB_B.wz_radps),
                           .cmd_vx_mps = f(cmd.vx_mps),
                           .cmd_vy_mps = f(cmd.vy_mps),
                           .cmd_wz_radps = f(cmd.wz_radps),
                           .est_yaw_rad = f(estimate.X_WB.yaw_rad),
                           .cross_track_m = f(sample.cross_track_m),
                           .power_w = f(sample.power_w),
                           .coverage = f(meter_.swept().coverage()),
                           .revisited = f(meter_.swept().revisited()),
                           .shape = sample.shape,
                           .est_position_std_m = f(estimate.position_std_m)});
}

void Recorder::OnStep(const Sample& sample) {
  Metrics& m = record_.metrics;
  ++record_.steps;
  way_.Add(sample.p_WB.head<2>());
  m.path_length_m = way_.length_m();
  m.way_lost_m += LostSpeed(sample) * dt_s_;
  m.energy_j += sample.power_w * dt_s_;
  m.charge_ah += sample.battery_a * dt_s_ / 3600;
  m.least_battery_v =
      record_.steps == 1 ? sample.battery_v : std::min(m.least_battery_v, sample.battery_v);
  if (sample.battery_v == 0 && empty_s_ < 0) empty_s_ = sample.t_s;
  m.max_cross_track_m = std::max(m.max_cross_track_m, sample.cross_track_m);
  cross_track_sum_ += sample.cross_track_m;
  AddContacts(sample);
}

void Recorder::OnIntervention(const Intervention& assist,
                              const std::vector<NamedDetector>& detectors) {
  record_.interventions.push_back(assist);
  ++record_.metrics.interventions;
  OnCarried(detectors);
}

void Recorder::OnCarried(const std::vector<NamedDetector>& detectors) {
  KeepMargins(detectors);
  meter_.Lift();
  samples_.BreakOff();
  risk_.Lift();
  way_.Lift();
}

EpisodeRecord Recorder::Finish(Outcome ended, const Sample& last, const RobotSide& side,
                               const std::vector<NamedDetector>& detectors, double min_coverage,
                               std::optional<double> battery_left) {
  Metrics& m = record_.metrics;
  meter_.Add(last.X_WB());
  const CoverageMeter& swept = meter_.swept();
  m.coverage = swept.coverage();
  if (asks_for_risk_) m.cumulative_risk = risk_.cumulative_risk();
  m.overlap = swept.overlap();
  m.revisited = swept.revisited();
  m.extra_visits = swept.extra();
  m.duration_s = last.t_s;
  m.battery_left = battery_left;
  m.mean_cross_track_m =
      record_.steps > 0 ? cross_track_sum_ / static_cast<double>(record_.steps) : 0;
  m.turns = CountTurns(side.navigator().plan());
  m.reactions = side.recoveries();
  FinishEstimateError();
  if (const Supervisor* supervisor = side.supervisor()) MeasureSafety(*supervisor);
  if (side.known() != nullptr) record_.known = *side.known();
  KeepMargins(detectors);
  for (const Margin& margin : record_.margins) {
    std::optional<double>& least = m.*MarginOf(margin.mode);
    least = std::min(least.value_or(margin.share), margin.share);
  }
  record_.sample_stops = samples_.stops();
  record_.passes = swept.passes();
  record_.passes_frame = area_.frame;
  record_.sweepable = area_.sweepable;
  const bool judged =
      ended == Outcome::kSuccess || ended == Outcome::kTimeout || ended == Outcome::kAborted;
  record_.outcome = judged && !record_.events.empty() ? Outcome::kFailure : ended;
  record_.RequireCoverage(min_coverage);
  if (empty_s_ >= 0)
    record_.message = fmt::format(
        "the battery cut off after {:.1f} s: {}", empty_s_,
        m.battery_left && *m.battery_left <= 0 ? "it was empty" : "it cannot feed that load");
  return std::move(record_);
}

void Recorder::MeasureSafety(const Supervisor& supervisor) {
  Metrics& m = record_.metrics;
  record_.safety.assign(supervisor.rows().begin(), supervisor.rows().end());
  record_.alarms.assign(supervisor.alarms().begin(), supervisor.alarms().end());
  record_.speed_shares.assign(supervisor.speed_shares().begin(), supervisor.speed_shares().end());
  const auto early = [&](const RaisedAlarm& alarm) { return alarm.t_s < first_fault_s_; };
  m.alarms = static_cast<double>(record_.alarms.size());
  m.false_alarms = static_cast<double>(std::ranges::count_if(record_.alarms, early));
  m.held_s = supervisor.held_s();
  if (const auto noticed = std::ranges::find_if_not(record_.alarms, early);
      noticed != record_.alarms.end())
    m.detection_s = noticed->t_s - first_fault_s_;
}

void Recorder::AddContacts(const Sample& sample) {
  Metrics& m = record_.metrics;
  double impulse_ns = 0;
  bool touches = false;
  for (int i = 0; i < sample.num_contacts; ++i) {
    const ObstacleContact& contact = sample.contacts[static_cast<std::size_t>(i)];
    if (contact.wheel) continue;
    touches = true;
    impulse_ns += contact.impulse_ns;
    m.max_impulse_ns = std::max(m.max_impulse_ns, contact.impulse_ns);
  }
  if (!touches) return;
  // A body that is pressed against a wall or scrapes along it lets go for single steps; that is
  // one meeting.
  constexpr double kApart_s = 0.25;
  const bool anew = sample.t_s - last_touch_s_ > kApart_s;
  m.contacts += anew ? 1 : 0;
  m.contact_s += anew ? dt_s_ : sample.t_s - last_touch_s_;
  m.contact_m += anew ? 0 : m.path_length_m - last_touch_m_;
  m.max_contact_n = std::max(m.max_contact_n, impulse_ns / dt_s_);
  last_touch_s_ = sample.t_s;
  last_touch_m_ = m.path_length_m;
}

void Recorder::AddEstimateError(double error_m) {
  record_.metrics.max_estimate_error_m = std::max(record_.metrics.max_estimate_error_m, error_m);
  estimate_error_sum_ += error_m;
  const auto mm = static_cast<std::size_t>(std::clamp(error_m * 1000, 0.0, kMaxMm - 1.0));
  ++errors_mm_[mm];
}

void Recorder::FinishEstimateError() {
  Metrics& m = record_.metrics;
  const auto all =
      static_cast<double>(std::accumulate(errors_mm_.begin(), errors_mm_.end(), std::int64_t{0}));
  if (all == 0) return;
  m.mean_estimate_error_m = estimate_error_sum_ / all;
  m.mean_estimate_position_std_m = position_std_sum_ / all;
  std::size_t mm = 0;
  for (auto below = static_cast<double>(errors_mm_[0]);
       below < 0.95 * all && mm + 1 < errors_mm_.size();)
    below += static_cast<double>(errors_mm_[++mm]);
  if (m.max_estimate_error_m > 0)
    m.p95_estimate_error_m = std::min(m.max_estimate_error_m, static_cast<double>(mm + 1) / 1000);
}

double Recorder::LostSpeed(const Sample& sample) {
  const BodyTwist &cmd = sample.command.twist, &v = sample.V_WB_B;
  const double speed_mps = std::hypot(cmd.vx_mps, cmd.vy_mps);
  if (speed_mps == 0) return 0;
  return speed_mps - (v.vx_mps * cmd.vx_mps + v.vy_mps * cmd.vy_mps) / speed_mps;
}

void Recorder::KeepMargins(const std::vector<NamedDetector>& detectors) {
  std::vector<Margin>& kept = record_.margins;
  for (std::size_t i = 0; i < detectors.size(); ++i) {
    const Detector& detector = *detectors[i].detector;
    const Margin margin{detectors[i].name, detector.mode(), detector.margin(),
                        detector.margin_share()};
    if (i == kept.size())
      kept.push_back(margin);
    else if (margin.share < kept[i].share)
      kept[i] = margin;
  }
}

}  // namespace floorproof

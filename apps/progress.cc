// SPDX-License-Identifier: Apache-2.0
#include "apps/progress.h"

#include <fmt/format.h>

#include <algorithm>

namespace floorproof {
namespace {

// A film shows 30 pictures a second in real time around an event; 25 recorded are enough.
constexpr int kRecordHz = 25;

}  // namespace

ProgressObserver::ProgressObserver(const Globals& globals, const RobotSpec& robot, int control_hz,
                                   Recording* recording)
    : line_(globals),
      robot_(robot),
      recording_(recording),
      record_every_(std::max(1, control_hz / kRecordHz)) {}

bool ProgressObserver::OnControl(Simulation& simulation, double coverage, double plan_fraction) {
  if (!hold_) hold_.emplace();
  const bool keep = count_++ % record_every_ == 0;
  const Sample& sample = simulation.sample();
  const double t_s = sample.t_s;
  if (keep && recording_)
    recording_->Add(t_s, simulation.data()->qpos, sample.p_WB, ToolWidth(robot_, sample.shape),
                    coverage);
  if (Interrupted()) return false;
  if (count_ % 64 != 0 || !line_.IsDue()) return true;
  const double eta_s = plan_fraction > 0.01
                           ? line_.wall_s() * (1 - std::min(plan_fraction, 1.0)) / plan_fraction
                           : -1;
  line_.Show(fmt::format("  driven {:.0f} s  covered {:.1f} %  {:.0f}x real time  {}", t_s,
                         100 * coverage, t_s / line_.wall_s(),
                         eta_s < 0 ? "" : fmt::format("about {:.0f} s to go", eta_s)));
  return true;
}

}  // namespace floorproof

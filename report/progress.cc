// SPDX-License-Identifier: Apache-2.0
#include "report/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace floorproof {
namespace {

// A film shows 30 pictures a second in real time around an event; 25 recorded are enough.
constexpr int kRecordHz = 25;

}  // namespace

StateRecorder::StateRecorder(const RobotSpec& robot, int control_hz, Recording& recording)
    : robot_(robot), recording_(recording), every_(std::max(1, control_hz / kRecordHz)) {}

void StateRecorder::OnControl(const EpisodeView& now) {
  if (now.sensed.scan.fresh) scan_ = true;
  if (count_++ % every_ == 0) Keep(now);
}

void StateRecorder::Keep(const EpisodeView& now) {
  const Sample& sample = now.sample;
  if (recording_.size() > 0 && recording_.t_s(recording_.size() - 1) >= sample.t_s) return;
  recording_.Add(sample.t_s, now.simulation->data()->qpos, sample.p_WB,
                 ToolWidth(robot_, sample.shape), now.coverage);
  if (!scan_) return;
  const LidarScan& scan = now.sensed.scan;
  const Pose2 X_WL = sample.X_WB() * scan.X_BL;
  std::vector<Vec2> ends_W;
  scan.ForEachEnd([&](const Vec2& p_L) { ends_W.push_back(X_WL * p_L); });
  recording_.AddSenses(now.estimate.X_WB, X_WL.p(), ends_W);
  scan_ = false;
}

ProgressObserver::ProgressObserver(const Console& console, const RobotSpec& robot, int control_hz,
                                   Recording* recording)
    : line_(console) {
  if (recording) recorder_.emplace(robot, control_hz, *recording);
}

bool ProgressObserver::OnControl(const EpisodeView& now) {
  if (!hold_) hold_.emplace();
  ++count_;
  if (recorder_) recorder_->OnControl(now);
  if (Interrupted()) return false;
  const double t_s = now.sample.t_s;
  if (count_ % 64 != 0 || !line_.IsDue()) return true;
  const double eta_s =
      now.plan_fraction > 0.01
          ? line_.wall_s() * (1 - std::min(now.plan_fraction, 1.0)) / now.plan_fraction
          : -1;
  line_.Show(fmt::format("  driven {:.0f} s  covered {:.1f} %  {:.0f}x real time  {}", t_s,
                         100 * now.coverage, t_s / line_.wall_s(),
                         eta_s < 0 ? "" : fmt::format("about {:.0f} s to go", eta_s)));
  return true;
}

}  // namespace floorproof

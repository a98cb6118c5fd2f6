// SPDX-License-Identifier: Apache-2.0
#include "apps/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace floorproof {
namespace {

// A film shows 30 pictures a second in real time around an event; 25 recorded are enough.
constexpr int kRecordHz = 25;

}  // namespace

ProgressObserver::ProgressObserver(const Globals& globals, const RobotSpec& robot, int control_hz,
                                   Recording* recording)
    : globals_(globals),
      robot_(robot),
      recording_(recording),
      record_every_(std::max(1, control_hz / kRecordHz)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

void ProgressObserver::EndLine() {
  if (shown_ && terminal_) std::fprintf(stderr, "\r\033[K");
  shown_ = false;
}

bool ProgressObserver::OnControl(Simulation& simulation, double coverage, double plan_fraction) {
  if (!hold_) hold_.emplace();
  const bool keep = count_++ % record_every_ == 0;
  const Sample& sample = simulation.sample();
  const double t_s = sample.t_s;
  if (keep && recording_)
    recording_->Add(t_s, simulation.data()->qpos, sample.p_WB, ToolWidth(robot_, sample.shape),
                    coverage);
  if (Interrupted()) return false;
  if (globals_.quiet || count_ % 64 != 0) return true;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < (terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(10000)))
    return true;
  last_ = now;
  Print(t_s, coverage, plan_fraction, std::chrono::duration<double>(now - start_).count());
  return true;
}

void ProgressObserver::Print(double t_s, double coverage, double plan_fraction, double wall_s) {
  const double eta_s =
      plan_fraction > 0.01 ? wall_s * (1 - std::min(plan_fraction, 1.0)) / plan_fraction : -1;
  const std::string line =
      fmt::format("  driven {:.0f} s  covered {:.1f} %  {:.0f}x real time  {}", t_s, 100 * coverage,
                  t_s / wall_s, eta_s < 0 ? "" : fmt::format("about {:.0f} s to go", eta_s));
  std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", line.c_str());
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace floorproof

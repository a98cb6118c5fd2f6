// SPDX-License-Identifier: Apache-2.0
// Whether a robot gets on alone after a failure (the key `on_failure: watch`): the drive goes on,
// nobody helps, and nothing more is judged, for ten seconds; shorter, where it is at its end or
// gains no way for five.
#pragma once

#include <algorithm>
#include <limits>

namespace floorproof {

class Aftermath {
 public:
  // Every physics step. `progress_m`: the way gone along its path.
  void OnStep(double t_s, double progress_m) {
    if (progress_m < most_m_ + kGain_m) return;
    most_m_ = progress_m;
    gained_s_ = t_s;
  }
  void OnFailure(double t_s) { failed_s_ = std::min(failed_s_, t_s); }

  bool watched() const { return failed_s_ < std::numeric_limits<double>::infinity(); }
  // Whether it has come on within the last seconds.
  bool Gains(double t_s) const { return t_s - std::max(gained_s_, failed_s_) < kNoGain_s; }
  bool HasEnded(double t_s) const { return !Gains(t_s) || t_s - failed_s_ >= kWatched_s; }

 private:
  static constexpr double kGain_m = 0.1, kNoGain_s = 5, kWatched_s = 10;
  double most_m_ = 0, gained_s_ = 0;
  double failed_s_ = std::numeric_limits<double>::infinity();
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Whether a robot on a flat floor feels seams: how it heaves while it drives.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "env/core/motion.h"

namespace floorproof {

// The bounds on a flat floor, whatever slabs it is made of. MuJoCo's contacts are a few micrometres
// deep. Where a wheel stands on two slabs at once, or scrubs, it may leave the floor for a step of
// 4 ms and fall by a tenth of a millimetre. So the acceleration of a single step can be g and says
// nothing. The mean over 20 ms shows what a body of kilograms feels; a seam of 1 mm gives 4 m/s^2.
inline constexpr double kMaxHeave_mps2 = 2.5;
inline constexpr double kMaxHeave_m = 0.0003;

class VerticalMotion {
 public:
  // Over how many updates accelerations are averaged: what makes 20 ms.
  explicit VerticalMotion(int window = kMaxWindow) : window_(window) {}

  void Update(const Truth& sample) {
    if (count_ >= window_) {
      const Moment& before = last_[static_cast<std::size_t>(count_ % window_)];
      accel_mps2_ = std::max(
          accel_mps2_, std::abs((sample.v_WB_W.z() - before.v_mps) / (sample.t_s - before.t_s)));
    }
    if (count_ == 0) rest_m_ = sample.p_WB.z();
    height_m_ = std::max(height_m_, std::abs(sample.p_WB.z() - rest_m_));
    last_[static_cast<std::size_t>(count_++ % window_)] = {sample.t_s, sample.v_WB_W.z()};
  }
  // The largest vertical acceleration, a mean over the window.
  double accel_mps2() const { return accel_mps2_; }
  // The largest distance of the body's origin from its height at first: tyres give under its
  // weight.
  double height_m() const { return height_m_; }

 private:
  static constexpr int kMaxWindow = 5;  // steps of 4 ms
  struct Moment {
    double t_s = 0, v_mps = 0;
  };
  int window_;
  std::array<Moment, kMaxWindow> last_;
  int count_ = 0;
  double accel_mps2_ = 0, rest_m_ = 0, height_m_ = 0;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How far a robot has driven, from the places where it was.
#pragma once

#include <algorithm>
#include <optional>

#include "env/geometry/geometry.h"

namespace floorproof {

// In chords of a centimetre: a robot that is held trembles, and gets nowhere.
class DrivenWay {
 public:
  void Add(const Vec2& p_W) {
    constexpr double kChord_m = 0.01;
    if (!chord_end_W_) chord_end_W_ = p_W;
    const double chord_m = (p_W - *chord_end_W_).norm();
    length_m_ = std::max(length_m_, chords_m_ + chord_m);
    if (chord_m < kChord_m) return;
    chords_m_ += chord_m;
    chord_end_W_ = p_W;
  }
  // The robot was carried: the next place is no way from the last one.
  void Lift() {
    chords_m_ = length_m_;
    chord_end_W_.reset();
  }
  double length_m() const { return length_m_; }

 private:
  double length_m_ = 0, chords_m_ = 0;  // up to the last place, and to the last chord's end
  std::optional<Vec2> chord_end_W_;
};

}  // namespace floorproof

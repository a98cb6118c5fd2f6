// SPDX-License-Identifier: Apache-2.0
// The engine alone: an episode's controls played again in a bare loop of mj_step.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "run/episode/episode.h"

namespace floorproof {

// Notes the state at the first control period, the controls of each, and the time of the loop.
class Notes : public EpisodeObserver {
 public:
  using Clock = std::chrono::steady_clock;
  bool OnControl(const EpisodeView& now) override {
    const mjModel* m = now.simulation->model();
    mjData* d = now.simulation->data();
    if (controls_.empty()) {
      state_.resize(static_cast<std::size_t>(mj_stateSize(m, mjSTATE_INTEGRATION)));
      mj_getState(m, d, state_.data(), mjSTATE_INTEGRATION);
      controls_.reserve(1 << 22);
      begin_ = Clock::now();
    }
    controls_.insert(controls_.end(), d->ctrl, d->ctrl + m->nu);
    end_ = Clock::now();
    return true;
  }
  double seconds() const { return std::chrono::duration<double>(end_ - begin_).count(); }
  const std::vector<double>& controls() const { return controls_; }
  const std::vector<mjtNum>& state() const { return state_; }

 private:
  std::vector<double> controls_;
  std::vector<mjtNum> state_;
  Clock::time_point begin_, end_;
};

// Seconds that the bare loop takes over the same controls.
inline double BareLoop(const mjModel* m, const Notes& notes, int steps_a_control) {
  const DataPtr data = MakeData(m);
  mj_setState(m, data.get(), notes.state().data(), mjSTATE_INTEGRATION);
  const auto begin = Notes::Clock::now();
  for (std::size_t i = 0; i + static_cast<std::size_t>(m->nu) < notes.controls().size();
       i += static_cast<std::size_t>(m->nu)) {
    std::copy_n(notes.controls().data() + i, m->nu, data->ctrl);
    for (int k = 0; k < steps_a_control; ++k) mj_step(m, data.get());
  }
  return std::chrono::duration<double>(Notes::Clock::now() - begin).count();
}

}  // namespace floorproof

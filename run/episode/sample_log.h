// SPDX-License-Identifier: Apache-2.0
// Where a robot stood as it took its samples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "env/core/motion.h"

namespace floorproof {

struct SampleStop {
  int place = 0;   // index into PlanResult::samples
  double t_s = 0;  // as its dwell ended
  Pose2 X_WB;
};

// A sample is taken as its dwell ends, where the robot then truly stands. A dwell that is broken
// off, by a reaction or by help, took none; if the robot dwells there again it takes it then.
class SampleLog {
 public:
  // `places`: of the plan; tasks of others are none of its samples.
  explicit SampleLog(std::size_t places) : places_(places) {
    stops_.reserve(places);
    constexpr std::size_t kAtOnePlace = 8;
    at_.reserve(kAtOnePlace);
  }

  // Once a control period. Allocates nothing, but at a place of more than eight samples.
  void OnControl(const Sample& sample) {
    const Command& command = sample.command;
    if (command.reacting) at_.clear();
    if (!command.dwelling || (!at_.empty() && !Same(command.tasks))) TakeThose();
    if (!command.dwelling) return;
    at_.clear();
    for (const WaypointTask& task : command.tasks)
      if (task.kind == WaypointTask::Kind::kSample && static_cast<std::size_t>(task.id) < places_)
        at_.push_back({task.id, sample.t_s, sample.X_WB()});
  }
  void BreakOff() { at_.clear(); }

  const std::vector<SampleStop>& stops() const { return stops_; }  // in the order of visit

 private:
  bool Same(std::span<const WaypointTask> tasks) const {
    return !tasks.empty() && tasks.front().id == at_.front().place;
  }
  void TakeThose() {
    for (const SampleStop& stop : at_)  // each once
      if (std::ranges::find(stops_, stop.place, &SampleStop::place) == stops_.end())
        stops_.push_back(stop);
    at_.clear();
  }

  std::size_t places_;
  std::vector<SampleStop> stops_, at_;  // at_: of the dwell that goes on
};

}  // namespace floorproof

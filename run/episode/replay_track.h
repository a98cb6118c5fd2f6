// SPDX-License-Identifier: Apache-2.0
// replay.bin: a drive for the page's 3D replay. The scene's shapes once, then the positions of the
// robot's joints over time. docs/results.md states the format; web/replay_file.js reads it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "env/scene/scene.h"
#include "run/episode/episode.h"

namespace floorproof {

// Keeps what a replay shows of a model's states, 25 a second, rounded: 0.1 mm, a ten-thousandth of
// a unit quaternion, a thousandth of a radian. That rollers turn cannot be seen, and is left out.
class ReplayTrack {
 public:
  explicit ReplayTrack(const mjModel* model);

  // The state at this time: `nq` positions. One no later than the last is left out. Allocates only
  // as a vector grows.
  void Add(double t_s, const double* qpos);
  bool empty() const { return t_ms_.empty(); }

  // The file. `scene`: whose model this track is of; of the world's shapes those near the way that
  // the robot went are kept. Of a drive longer than ten minutes states are left out evenly, but for
  // the seconds around each of the times `keep_s`. `plan`: what was to be driven, if it was
  // planned.
  std::string Bytes(const Scene& scene, std::span<const double> keep_s,
                    std::span<const Waypoint> plan = {}) const;

 private:
  std::vector<int> first_of_;  // by the model's joints: where its positions begin; -1: left out
  std::vector<int> from_;      // of each position of a state, where it stands in qpos ...
  std::vector<double> per_;    // ... and by what it is multiplied before it is rounded
  std::vector<std::int64_t> t_ms_;
  std::vector<std::int32_t> rounded_;  // as many as from_ a state
};

// Keeps the track of an episode, and hands everything on.
class ReplayObserver : public EpisodeObserver {
 public:
  // `next` may be nullptr. `control_hz` as in the scenario.
  ReplayObserver(int control_hz, EpisodeObserver* next);
  void OnPlan(const PlanResult& plan) override;
  void OnScene(const Scene& scene) override;
  bool OnControl(const EpisodeView& now) override;
  // replay.bin of what was driven; empty where there was no physics.
  std::string Bytes(const std::optional<Scene>& scene, const EpisodeRecord& record) const;

 private:
  EpisodeObserver* next_;
  int every_;
  long count_ = 0;
  Path plan_;
  std::optional<ReplayTrack> track_;
};

}  // namespace floorproof

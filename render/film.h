// SPDX-License-Identifier: Apache-2.0
// A film of a recorded episode: posed, not simulated again.
#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "env/core/event.h"
#include "env/core/hazard_map.h"
#include "env/core/path.h"
#include "render/camera.h"
#include "render/film_reel.h"
#include "render/overlay.h"
#include "render/renderer.h"
#include "render/timeline.h"

namespace floorproof {

// An episode's states, in order of time.
class Recording {
 public:
  explicit Recording(int nq) : nq_(nq) {}
  // `qpos` holds nq values; `p_WB`: the robot's own place, on which the camera looks and where the
  // tool sweeps a stripe `tool_width_m` wide (0: none now); coverage 0 to 1, negative: unknown.
  void Add(double t_s, const double* qpos, const Vec3& p_WB, double tool_width_m, double coverage);
  // What the robot senses and thinks at the last state: where its lidar stands and its beams end
  // (world frame), and the pose that it thinks it has.
  void AddSenses(const Pose2& estimate, const Vec2& lidar_W, const std::vector<Vec2>& ends_W);
  std::size_t size() const { return t_s_.size(); }
  // The last state at or before t_s, looked for from the `from`-th on.
  std::size_t StateAt(double t_s, std::size_t from) const {
    while (from + 1 < size() && t_s_[from + 1] <= t_s) ++from;
    return from;
  }
  int nq() const { return nq_; }
  double t_s(std::size_t i) const { return t_s_[i]; }
  double coverage(std::size_t i) const { return coverage_[i]; }
  const Vec3& p_WB(std::size_t i) const { return p_WB_[i]; }
  double tool_width_m(std::size_t i) const { return tool_width_m_[i]; }
  const double* qpos(std::size_t i) const { return qpos_.data() + i * nq_; }

  struct Senses {
    std::size_t state = 0;
    Pose2 estimate;
    Vec2 lidar_W = Vec2::Zero();
    std::vector<Eigen::Vector2f> ends_W;
  };
  const std::vector<Senses>& senses() const { return senses_; }  // ascending in state

 private:
  int nq_;
  std::vector<double> t_s_, coverage_, tool_width_m_, qpos_;
  std::vector<Vec3> p_WB_;
  std::vector<Senses> senses_;
};

// Shown by its banner from its time on, until an event or another notice.
struct Notice {
  double t_s = 0;
  Banner banner;
};

// Floor that is swept a second time, from t_s on: a stripe from a to b.
struct FloorPatch {
  double t_s = 0;
  Vec2 a_W = Vec2::Zero(), b_W = Vec2::Zero();
  double width_m = 0, floor_m = 0;  // floor_m: how high it lies there
};

struct FilmScript {
  const mjModel* model = nullptr;
  int base_body = -1;  // the robot's; stands on a free joint, its origin at the floor
  const Recording* recording = nullptr;
  std::span<const Event> events;   // ascending in time; each is shown by a banner from its time on
  std::vector<int> shell;          // geoms of the robot that would hide where its wheels stand
  const HazardMap* map = nullptr;  // whose hazards the events name; none: by their ids alone
  std::vector<Notice> notices;     // ascending in time
  std::optional<Banner> closing;   // over the last picture
  std::optional<Timeline> timeline = {};  // as a strip, with a line at the frame's time
  std::string title;                      // "beluga on staircase hall"
  FilmSet set;                            // `aspect` is taken from the options
  const Path* plan = nullptr;             // drawn on the floor
  bool senses = true;                     // what the recording holds of them, too
  int beams = 0;                        // of a recording that grows: the most that a scan may have
  std::vector<FloorPatch> swept_again;  // ascending in time
  double window_m = 0;  // radius of a circle around the place that the robot thinks it has; 0: none
};

struct FilmOptions : ReelOptions {
  std::string camera = "auto";  // a name of Cameras()
  RenderQuality quality = RenderQuality::kGood;
  int processes = 0;  // that draw at once; 0: one a core, as far as they are worth it
  // Not empty: only the seconds around these events, as the pace has them; ascending.
  std::vector<double> only_around_s;
};

// Pictures of the film, as it looks at these times, ascending; each as if it were alone.
std::vector<Image> FilmPictures(const FilmScript& script, const FilmOptions& options,
                                std::span<const double> t_s);

// Pictures of a drive that goes on: of the last state each, with one renderer for all.
class LiveFilm {
 public:
  // The script outlives it; its recording, of a state at least, and its events may grow. The pace
  // is the drive's own.
  LiveFilm(const FilmScript& script, const FilmOptions& options);
  // Stands until the next call.
  const Image& Draw() { return draw_(); }

 private:
  std::function<const Image&()> draw_;
};

// Writes an MP4. Throws InputError (a file that cannot be written, an unknown camera, an odd size)
// or InternalError (no GL).
FilmResult WriteFilm(const FilmScript& script, const FilmOptions& options,
                     const std::filesystem::path& path);

}  // namespace floorproof

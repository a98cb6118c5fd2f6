// SPDX-License-Identifier: Apache-2.0
#include "render/film.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/usable_cores.h"
#include "env/core/event_evidence.h"
#include "render/film_floor.h"
#include "render/gl_context.h"
#include "render/picture_processes.h"

namespace floorproof {
namespace {

struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

// Poses of the robot between recorded states.
class Puppet {
 public:
  Puppet(const FilmScript& script)
      : model_(script.model),
        recording_(*script.recording),
        data_(mj_makeData(script.model)),
        velocity_(static_cast<std::size_t>(model_->nv)) {
    const int joint = model_->body_jntadr[script.base_body];
    if (joint < 0 || model_->jnt_type[joint] != mjJNT_FREE) {
      throw InternalError("the filmed body stands on no free joint");
    }
    root_ = model_->jnt_qposadr[joint];
  }

  // The last state at or before t_s; times only ascend.
  std::size_t StateAt(double t_s) { return at_ = recording_.StateAt(t_s, at_); }
  mjData* data() { return data_.get(); }
  void Pose(double t_s) {
    const std::size_t i = StateAt(t_s);
    mju_copy(data_->qpos, recording_.qpos(i), static_cast<int>(model_->nq));
    p_WB_ = recording_.p_WB(i);
    const Vec3 way = recording_.p_WB(std::min(i + 1, recording_.size() - 1)) - p_WB_;
    if (i + 1 < recording_.size() && way.norm() < kFilmJump_m) {
      const double span_s = recording_.t_s(i + 1) - recording_.t_s(i);
      const double share = std::clamp((t_s - recording_.t_s(i)) / span_s, 0.0, 1.0);
      mj_differentiatePos(model_, velocity_.data(), 1, recording_.qpos(i), recording_.qpos(i + 1));
      mj_integratePos(model_, data_->qpos, velocity_.data(), share);
      p_WB_ += share * way;
    }
    PoseForPicture(model_, data_.get());
  }
  Pose2 X_WB() const {
    const double* q = data_->qpos + root_;
    const double yaw =
        std::atan2(2 * (q[3] * q[6] + q[4] * q[5]), 1 - 2 * (q[5] * q[5] + q[6] * q[6]));
    return {p_WB_.x(), p_WB_.y(), yaw};
  }

 private:
  const mjModel* model_;
  const Recording& recording_;
  std::unique_ptr<mjData, DataDeleter> data_;
  std::vector<mjtNum> velocity_;
  Vec3 p_WB_ = Vec3::Zero();
  int root_ = 0;
  std::size_t at_ = 0;
};

void Check(const FilmScript& script, const FilmOptions& options) {
  if (script.recording->size() == 0) throw InternalError("there are no states to film");
  if (script.recording->nq() != script.model->nq) {
    throw InternalError("the recording is of another model");
  }
  CheckReel(options);
}

FilmSet WithAspect(FilmSet set, const FilmOptions& options) {
  set.aspect = static_cast<double>(options.width) / options.height;
  return set;
}

// Draws what lies over a film's pictures.
class Captions {
 public:
  explicit Captions(const FilmScript& script) : script_(script) {}

  void Draw(const FilmFrame& frame, bool last, Image& image) {
    const Recording& recording = *script_.recording;
    state_ = recording.StateAt(frame.t_s, state_);
    std::optional<Banner> banner = last ? script_.closing : std::nullopt;
    if (!banner) banner = BannerAt(frame.t_s + 1e-9, last);
    // The last picture stands.
    DrawOverlay({script_.title, frame.t_s, recording.coverage(state_), last ? 0 : frame.speed_up,
                 banner ? &*banner : nullptr},
                image);
    if (script_.timeline) DrawTimelineStrip(*script_.timeline, frame.t_s, image);
  }

 private:
  // Of the last event or notice.
  std::optional<Banner> BannerAt(double t_s, bool last) const {
    std::optional<Banner> banner;
    double since_s = -1;
    for (const Event& event : script_.events) {
      // The event that ended the episode may lie a step behind the last recorded state.
      if (!last && event.t_s > t_s) break;
      banner = FailureBanner(event, script_.map ? *script_.map : HazardMap{});
      since_s = event.t_s;
    }
    for (const Notice& notice : script_.notices)
      if (notice.t_s >= since_s && notice.t_s <= t_s) banner = notice.banner;
    return banner;
  }

  const FilmScript& script_;
  std::size_t state_ = 0;
};

// Draws the frames of a film in order.
class Studio {
 public:
  Studio(const FilmScript& script, const FilmOptions& options)
      : script_(script),
        set_(WithAspect(script.set, options)),
        frame_s_(1 / options.pace.fps),
        camera_(MakePlugin(Cameras(), options.camera, "video.camera")),
        puppet_(script),
        paint_((script.plan == nullptr ? 0 : static_cast<int>(script.plan->size())) +
               static_cast<int>(script.swept_again.size()) + 6000),
        floor_(script.map),
        trail_(floor_, paint_),
        again_(script.swept_again, floor_, paint_),
        fan_(script.senses ? &script.recording->senses() : nullptr, script.beams,
             2 * script.set.robot_radius_m, paint_),
        window_(script.window_m, LineWidth(), paint_),
        renderer_(script.model, options.width, options.height, paint_.max_marks(), options.quality),
        image_(renderer_.MakeImage()),
        pace_(options.pace) {
    if (script.plan != nullptr) PaintPlan(*script.plan, LineWidth(), floor_, paint_);
    paint_.Keep();
  }

  // The next picture's camera follows from none before.
  void Cut() { cut_ = true; }
  // The next frame is so much of film after the last one.
  void Pace(double frame_s) { frame_s_ = frame_s; }
  // Without what lies over it. Stands until the next call.
  Image& Draw(const FilmFrame& frame) {
    const CameraView view = Look(frame);
    const std::size_t state = puppet_.StateAt(frame.t_s);
    for (; trodden_ <= state; ++trodden_)
      trail_.Add(script_.recording->p_WB(trodden_), script_.recording->tool_width_m(trodden_));
    again_.Show(script_.recording->t_s(state));
    fan_.Show(state);
    window_.Show(ThoughtPlace(state));
    const bool thin = ContactAt(frame.t_s) != nullptr && IsLow(view);
    if (thin != shell_thin_) renderer_.SeeThrough(thin ? script_.shell : std::vector<int>{});
    shell_thin_ = thin;
    renderer_.Render(puppet_.data(), view, &paint_, image_);
    return image_;
  }
  // A frame that another draws: the camera follows the robot through all of them.
  void Pass(const FilmFrame& frame) { Look(frame); }

 private:
  CameraView Look(const FilmFrame& frame) {
    puppet_.Pose(frame.t_s);
    if (cut_) camera_->Reset(set_, puppet_.X_WB());
    cut_ = false;
    CameraCue cue{frame_s_, frame.speed_up, {}};
    if (const Event* contact = ContactAt(frame.t_s)) cue.contact_rad = CameInto(*contact);
    return camera_->Next(puppet_.X_WB(), cue);
  }
  // Of lines on the floor: they are to be seen from above.
  double LineWidth() const { return 0.012 + 0.0012 * (set_.high_W - set_.low_W).maxCoeff(); }
  // Where the robot thinks it is; without a scan so far, where it is. States only ascend.
  Vec2 ThoughtPlace(std::size_t state) {
    const std::vector<Recording::Senses>& all = script_.recording->senses();
    while (sensed_ < all.size() && all[sensed_].state <= state) ++sensed_;
    return sensed_ == 0 ? puppet_.X_WB().p() : all[sensed_ - 1].estimate.p();
  }
  // What happens at the wheels or the shell now, from before it began; null: nothing.
  const Event* ContactAt(double t_s) const {
    const auto found = std::ranges::find_if(script_.events, [&](const Event& event) {
      return event.mode != FailureMode::kVeerOff && t_s >= BeganAt(event) - pace_.before_s - 1e-9 &&
             t_s <= event.t_s + pace_.after_s + 1e-9;
    });
    return found == script_.events.end() ? nullptr : &*found;
  }
  // The direction in which the robot drove there, over its last decimetres; its heading where it
  // had driven none. A robot on Mecanum wheels may come sideways.
  double CameInto(const Event& event) const {
    constexpr double kWay_m = 0.15;
    const Recording& recording = *script_.recording;
    const std::size_t at = recording.StateAt(BeganAt(event), 0);
    for (std::size_t i = at; i-- > 0;) {
      const Vec2 way = (recording.p_WB(at) - recording.p_WB(i)).head<2>();
      if (way.norm() > kWay_m) return std::atan2(way.y(), way.x());
    }
    return event.yaw_rad;
  }
  // Where the shell stands between camera and wheels.
  static bool IsLow(const CameraView& view) {
    constexpr double kLow = 0.4;  // sine of the elevation
    const Vec3 sight = view.target_W - view.eye_W;
    return -sight.z() < kLow * sight.norm();
  }

  const FilmScript& script_;
  FilmSet set_;
  double frame_s_;
  std::unique_ptr<Camera> camera_;
  Puppet puppet_;
  FloorPaint paint_;
  PaintedFloor floor_;
  Trail trail_;
  SweptAgain again_;
  Fan fan_;
  WindowRing window_;
  OffscreenRenderer renderer_;
  Image image_;
  std::size_t trodden_ = 0, sensed_ = 0;
  FilmPace pace_;
  bool cut_ = true, shell_thin_ = false;
};

// Each costs a context, so that few frames are drawn by few of them. One that has drawn before, in
// this process, goes on alone: its context cannot be shared.
int ProcessesFor(std::size_t frames, const FilmOptions& options) {
  constexpr std::size_t kFramesEach = 24;
  constexpr int kMost = 8;
  if (DrawsAlready()) return 1;
  if (options.processes > 0) return std::min(options.processes, static_cast<int>(frames));
  const int cores = std::min(kMost, UsableCores());
  return std::min(cores, static_cast<int>(frames / kFramesEach));
}

// In a process of its own, which draws some of the frames.
PictureProcesses::Draw DrawerOf(const FilmScript& script, const FilmOptions& options,
                                const std::vector<FilmFrame>& frames) {
  setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);  // there is a process for each core
  auto studio = std::make_shared<Studio>(script, options);
  return [studio, &frames, passed = std::size_t{0}](std::size_t i, std::uint8_t* pixels) mutable {
    for (; passed < i; ++passed) studio->Pass(frames[passed]);
    const Image& image = studio->Draw(frames[i]);
    passed = i + 1;
    std::memcpy(pixels, image.data.data(), image.data.size());
  };
}

}  // namespace

void Recording::Add(double t_s, const double* qpos, const Vec3& p_WB, double tool_width_m,
                    double coverage) {
  t_s_.push_back(t_s);
  coverage_.push_back(coverage);
  tool_width_m_.push_back(tool_width_m);
  p_WB_.push_back(p_WB);
  qpos_.insert(qpos_.end(), qpos, qpos + nq_);
}

void Recording::AddSenses(const Pose2& estimate, const Vec2& lidar_W,
                          const std::vector<Vec2>& ends_W) {
  Senses& now = senses_.emplace_back();
  now.state = size() - 1;
  now.estimate = estimate;
  now.lidar_W = lidar_W;
  for (const Vec2& end : ends_W) now.ends_W.push_back(end.cast<float>());
}

std::vector<Image> FilmPictures(const FilmScript& script, const FilmOptions& options,
                                std::span<const double> t_s) {
  Check(script, options);
  Studio studio(script, options);
  Captions captions(script);
  std::vector<Image> pictures;
  for (const double at_s : t_s) {
    studio.Cut();
    pictures.push_back(studio.Draw({.t_s = at_s}));
    captions.Draw({.t_s = at_s}, false, pictures.back());
  }
  return pictures;
}

LiveFilm::LiveFilm(const FilmScript& script, const FilmOptions& options) {
  Check(script, options);
  auto studio = std::make_shared<Studio>(script, options);
  draw_ = [studio, captions = Captions(script), &recording = *script.recording,
           drawn_s = 0.0]() mutable -> const Image& {
    const double now_s = recording.t_s(recording.size() - 1);
    studio->Pace(now_s - std::exchange(drawn_s, now_s));
    Image& image = studio->Draw({.t_s = now_s});
    captions.Draw({.t_s = now_s}, true, image);
    return image;
  };
}

FilmResult WriteFilm(const FilmScript& script, const FilmOptions& options,
                     const std::filesystem::path& path) {
  Check(script, options);
  const Recording& recording = *script.recording;
  const double begin_s = recording.t_s(0), end_s = recording.t_s(recording.size() - 1);
  const bool whole = options.only_around_s.empty();
  std::vector<double> shown_s = options.only_around_s, slow_s = shown_s;
  for (const Event& event : script.events) {
    if (whole) shown_s.push_back(event.t_s);
    if (std::ranges::find(shown_s, event.t_s) != shown_s.end()) slow_s.push_back(BeganAt(event));
  }
  std::ranges::sort(slow_s);
  const auto frames =
      whole ? ScheduleFilm(begin_s, end_s, slow_s, options.pace)
            : SchedulePassages(PassagesAround(begin_s, end_s, slow_s, options.pace), options.pace);
  FilmMoments moments{.frames = frames, .end_s = end_s, .failure_s = {}};
  if (!shown_s.empty()) moments.failure_s = shown_s.front();
  Captions captions(script);
  const std::vector<FilmFrame> drawn = moments.Drawn();
  const int processes = ProcessesFor(drawn.size(), options);
  if (processes < 2) {
    Studio studio(script, options);
    return WriteReel(
        moments, options,
        [&](const FilmFrame& frame, bool last) -> const Image& {
          Image& image = studio.Draw(frame);
          captions.Draw(frame, last, image);
          return image;
        },
        path);
  }
  Image image{options.width, options.height, 3, {}, false};
  image.data.resize(static_cast<std::size_t>(options.width) * options.height * 3);
  PictureProcesses pictures(drawn.size(), image.data.size(), processes,
                            [&] { return DrawerOf(script, options, drawn); });
  return WriteReel(
      moments, options,
      [&](const FilmFrame& frame, bool last) -> const Image& {
        std::memcpy(image.data.data(), pictures.Next(), image.data.size());
        captions.Draw(frame, last, image);
        return image;
      },
      path);
}

}  // namespace floorproof

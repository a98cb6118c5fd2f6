// SPDX-License-Identifier: Apache-2.0
#include "render/film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"

namespace floorproof {
namespace {

constexpr std::array<float, 4> kPlanRgba = {0.13f, 0.33f, 0.78f, 1.0f};
constexpr std::array<float, 4> kTraceRgba = {0.58f, 0.83f, 0.78f, 1.0f};
constexpr std::array<float, 4> kBeamRgba = {0.90f, 0.25f, 0.12f, 0.55f};
constexpr std::array<float, 4> kEstimateRgba = {0.62f, 0.12f, 0.55f, 1.0f};
constexpr double kBeamZ_m = 0.006, kEstimateZ_m = 0.0075;
constexpr double kTraceZ_m = 0.0020, kPlanZ_m = 0.0035;
constexpr double kJump_m = 0.3;  // between two states: the robot was carried

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
  std::size_t StateAt(double t_s) {
    while (at_ + 1 < recording_.size() && recording_.t_s(at_ + 1) <= t_s) ++at_;
    return at_;
  }
  mjData* Pose(double t_s) {
    const std::size_t i = StateAt(t_s);
    mju_copy(data_->qpos, recording_.qpos(i), static_cast<int>(model_->nq));
    p_WB_ = recording_.p_WB(i);
    const Vec3 way = recording_.p_WB(std::min(i + 1, recording_.size() - 1)) - p_WB_;
    if (i + 1 < recording_.size() && way.norm() < kJump_m) {
      const double span_s = recording_.t_s(i + 1) - recording_.t_s(i);
      const double share = std::clamp((t_s - recording_.t_s(i)) / span_s, 0.0, 1.0);
      mj_differentiatePos(model_, velocity_.data(), 1, recording_.qpos(i), recording_.qpos(i + 1));
      mj_integratePos(model_, data_->qpos, velocity_.data(), share);
      p_WB_ += share * way;
    }
    PoseForPicture(model_, data_.get());
    return data_.get();
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

// Paints what was driven as few straight stripes with round corners, as a disc-shaped tool sweeps.
class Trail {
 public:
  explicit Trail(FloorPaint& paint) : paint_(paint) {}

  void Add(const Vec3& p, double width_m) {
    constexpr double kStep_m = 0.02, kStray_m = 0.015;
    const double z_m = p.z() > 0.01 ? p.z() + kTraceZ_m : kTraceZ_m;
    const Vec2 q(p.x(), p.y());
    if (width_m != width_m_) run_.clear();
    width_m_ = width_m;
    if (width_m <= 0) return;
    if (run_.empty() || (q - run_.back()).norm() > kJump_m) {
      Begin(q, z_m);
      return;
    }
    if ((q - run_.back()).norm() < kStep_m) return;
    const bool strays = std::any_of(run_.begin() + 1, run_.end(), [&](const Vec2& between) {
      return DistanceToSegment(run_.front(), q, between) > kStray_m;
    });
    if (strays || std::abs(z_m - z_m_) > 0.005) Begin(run_.back(), z_m);
    run_.push_back(q);
    paint_.MoveStripe(stripe_, run_.front(), q);
  }

 private:
  void Begin(const Vec2& p, double z_m) {
    run_.assign(1, p);
    z_m_ = z_m;
    paint_.AddDisc(p, z_m, 0.5 * width_m_, kTraceRgba);
    stripe_ = paint_.AddStripe(p, p, z_m, width_m_, kTraceRgba);
  }

  FloorPaint& paint_;
  double width_m_ = 0, z_m_ = 0;
  std::vector<Vec2> run_;  // points since the last corner
  std::size_t stripe_ = 0;
};

void PaintPlan(const Path& plan, double width_m, FloorPaint& paint) {
  std::size_t from = 0;
  for (std::size_t i = 1; i < plan.size(); ++i) {
    const Vec2 &a = plan[from].p_W, &b = plan[i].p_W;
    const bool straight_on = i + 1 < plan.size() &&
                             DistanceToSegment(a, plan[i + 1].p_W, b) < 1e-3 &&
                             (b - a).dot(plan[i + 1].p_W - b) >= 0;
    if (straight_on || (b - a).norm() == 0) continue;
    paint.AddStripe(a, b, kPlanZ_m, width_m, kPlanRgba);
    from = i;
  }
}

// The last scan as a fan of beams on the floor, and the shaft of an arrow where the robot thinks it
// is. These stripes move.
class Fan {
 public:
  Fan(std::span<const Recording::Senses> senses, double reach_m, FloorPaint& paint)
      : all_(senses), paint_(paint), reach_m_(reach_m) {
    if (all_.empty()) return;
    std::size_t most = 0;
    for (const auto& one : all_) most = std::max(most, one.ends_W.size());
    for (std::size_t i = 0; i < most; ++i)
      beams_.push_back(paint.AddStripe({0, 0}, {0, 0}, kBeamZ_m, 0.008, kBeamRgba));
    estimate_ = paint.AddStripe({0, 0}, {0, 0}, kEstimateZ_m, 0.03, kEstimateRgba);
  }

  void Show(std::size_t state) {
    while (at_ + 1 < all_.size() && all_[at_ + 1].state <= state) ++at_;
    if (all_.empty() || all_[at_].state > state) return;
    const auto& now = all_[at_];
    for (std::size_t i = 0; i < beams_.size(); ++i)
      paint_.MoveStripe(beams_[i], now.lidar_W,
                        i < now.ends_W.size() ? now.ends_W[i].cast<double>() : now.lidar_W);
    paint_.MoveStripe(estimate_, now.estimate.p(), now.estimate * Vec2(reach_m_, 0));
  }

 private:
  std::span<const Recording::Senses> all_;
  FloorPaint& paint_;
  double reach_m_;
  std::vector<std::size_t> beams_;
  std::size_t estimate_ = 0, at_ = 0;
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

// Draws the frames of a film in order.
class Studio {
 public:
  Studio(const FilmScript& script, const FilmOptions& options)
      : script_(script),
        set_(WithAspect(script.set, options)),
        frame_s_(1 / options.pace.fps),
        camera_(MakePlugin(Cameras(), options.camera, "video.camera")),
        puppet_(script),
        paint_((script.plan == nullptr ? 0 : static_cast<int>(script.plan->size())) + 6000),
        trail_(paint_),
        fan_(script.senses ? std::span(script.recording->senses())
                           : std::span<const Recording::Senses>(),
             2 * script.set.robot_radius_m, paint_),
        renderer_(script.model, options.width, options.height, paint_.max_marks(), options.quality),
        image_(renderer_.MakeImage()) {
    if (script.plan != nullptr)
      PaintPlan(*script.plan, 0.012 + 0.0012 * (set_.high_W - set_.low_W).maxCoeff(), paint_);
    paint_.Keep();
  }

  const Image& Draw(const FilmFrame& frame, bool last) {
    mjData* data = puppet_.Pose(frame.t_s);
    const std::size_t state = puppet_.StateAt(frame.t_s);
    if (trodden_ == 0) camera_->Reset(set_, puppet_.X_WB());
    for (; trodden_ <= state; ++trodden_)
      trail_.Add(script_.recording->p_WB(trodden_), script_.recording->tool_width_m(trodden_));
    fan_.Show(state);
    renderer_.Render(data, camera_->Next(puppet_.X_WB(), frame_s_, frame.speed_up), &paint_,
                     image_);

    std::optional<Banner> banner = last ? script_.closing : std::nullopt;
    if (!banner) banner = BannerAt(frame.t_s + 1e-9, last);
    DrawOverlay({script_.title, frame.t_s, script_.recording->coverage(state), frame.speed_up,
                 banner ? &*banner : nullptr},
                image_);
    return image_;
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
  FilmSet set_;
  double frame_s_;
  std::unique_ptr<Camera> camera_;
  Puppet puppet_;
  FloorPaint paint_;
  Trail trail_;
  Fan fan_;
  OffscreenRenderer renderer_;
  Image image_;
  std::size_t trodden_ = 0;
};

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

FilmResult WriteFilm(const FilmScript& script, const FilmOptions& options,
                     const std::filesystem::path& path) {
  Check(script, options);
  const Recording& recording = *script.recording;
  const double begin_s = recording.t_s(0), end_s = recording.t_s(recording.size() - 1);
  std::vector<double> events_s;
  for (const Event& event : script.events) events_s.push_back(event.t_s);
  const bool whole = options.only_around_s.empty();
  const auto frames =
      whole ? ScheduleFilm(begin_s, end_s, events_s, options.pace)
            : SchedulePassages(PassagesAround(begin_s, end_s, options.only_around_s, options.pace),
                               options.pace);
  const std::vector<double>& shown_s = whole ? events_s : options.only_around_s;
  Studio studio(script, options);
  FilmMoments moments{.frames = frames, .end_s = end_s, .failure_s = {}};
  if (!shown_s.empty()) moments.failure_s = shown_s.front();
  return WriteReel(
      moments, options,
      [&](const FilmFrame& frame, bool last) -> const Image& { return studio.Draw(frame, last); },
      path);
}

}  // namespace floorproof

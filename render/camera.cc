// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace floorproof {
namespace {

constexpr double kDegree = kPi / 180;

// First-order low pass: the share of the way to go in dt_s.
double Share(double dt_s, double tau_s) { return 1 - std::exp(-dt_s / tau_s); }

Vec3 Lift(const Vec2& p, double z_m) { return {p.x(), p.y(), z_m}; }

// Follows a point with a lag of tau_s, but no farther behind than max_lag_m (a time lapse is fast).
class Follower {
 public:
  void Reset(const Vec2& p) { p_ = p; }
  Vec2 Next(const Vec2& p, double dt_s, double tau_s, double max_lag_m) {
    p_ += Share(dt_s, tau_s) * (p - p_);
    const Vec2 lag = p_ - p;
    if (lag.norm() > max_lag_m) p_ = p + lag.normalized() * max_lag_m;
    return p_;
  }

 private:
  Vec2 p_ = Vec2::Zero();
};

// Turns towards a heading. The heading is first averaged as a vector: for a robot that drives to
// and fro in a time lapse it averages out instead of swinging the camera. Then the rate is bounded.
class Panner {
 public:
  void Reset(double yaw_rad) {
    yaw_rad_ = yaw_rad;
    mean_ = {std::cos(yaw_rad), std::sin(yaw_rad)};
  }
  double Next(double yaw_rad, double dt_s) {
    constexpr double kAverage_s = 1.5, kTurn_s = 0.6, kMaxRate = 45 * kDegree;
    mean_ += Share(dt_s, kAverage_s) * (Vec2(std::cos(yaw_rad), std::sin(yaw_rad)) - mean_);
    const double trust = std::min(1.0, mean_.norm());  // a vector near zero points nowhere
    const double error = WrapAngle(std::atan2(mean_.y(), mean_.x()) - yaw_rad_);
    const double limit = kMaxRate * trust * dt_s;
    yaw_rad_ = WrapAngle(yaw_rad_ + std::clamp(Share(dt_s, kTurn_s) * error, -limit, limit));
    return yaw_rad_;
  }

 private:
  double yaw_rad_ = 0;
  Vec2 mean_ = Vec2::UnitX();
};

// Behind the robot and well above it, so that walls do not hide it.
class Chase : public Camera {
 public:
  void Reset(const FilmSet& set, const Pose2& X_WB) override {
    distance_m_ = 1.3 + 4.0 * set.robot_radius_m;
    follower_.Reset(X_WB.p());
    panner_.Reset(X_WB.yaw_rad);
  }
  CameraView Next(const Pose2& X_WB, const CameraCue& cue) override {
    const Vec2 p = follower_.Next(X_WB.p(), cue.dt_s, 0.25, 0.15 * distance_m_);
    const double yaw = panner_.Next(X_WB.yaw_rad, cue.dt_s);
    const Vec2 ahead(std::cos(yaw), std::sin(yaw));
    constexpr double kElevation = 38 * kDegree;
    CameraView view;
    view.target_W = Lift(p + 0.12 * distance_m_ * ahead, 0.05);
    view.eye_W =
        view.target_W + distance_m_ * Lift(-std::cos(kElevation) * ahead, std::sin(kElevation));
    view.fovy_rad = 45 * kDegree;
    return view;
  }

 private:
  double distance_m_ = 3;
  Follower follower_;
  Panner panner_;
};

// From straight above, north up: the whole site if the robot stays visible, else a part of it. That
// stands still, for a time lapse would make a camera that follows swim; where the robot comes near
// its edge, it is another part, around the robot.
class Top : public Camera {
 public:
  void Reset(const FilmSet& set, const Pose2& X_WB) override {
    set_ = set;
    const Vec2 size = (set.high_W - set.low_W).cwiseMax(0.1);
    // The overlay's bars take a tenth of the height.
    const double whole_m = std::max(1.26 * size.y(), 1.06 * size.x() / set.aspect);
    height_m_ = std::min(whole_m, 60 * set.robot_radius_m);
    LookAt(X_WB.p());
  }
  CameraView Next(const Pose2& X_WB, const CameraCue&) override {
    constexpr double kInner = 0.75;  // of the half picture; beyond lies its edge
    const Vec2 off = (X_WB.p() - middle_).cwiseAbs(), half = Half();
    const Vec2 before = middle_;
    if ((off.array() > kInner * half.array()).any()) LookAt(X_WB.p());
    // Along the site's own edge there may be nowhere else to look.
    if ((middle_ - before).norm() < 0.1 * height_m_) middle_ = before;
    CameraView view;
    constexpr double kFovy = 24 * kDegree;  // nearly parallel: walls hide little floor
    view.fovy_rad = kFovy;
    view.target_W = Lift(middle_, 0);
    view.eye_W = Lift(middle_, 0.5 * height_m_ / std::tan(0.5 * kFovy));
    view.up_W = Vec3::UnitY();
    return view;
  }

 private:
  Vec2 Half() const { return 0.5 * height_m_ * Vec2(set_.aspect, 1); }
  // Without looking far beyond the site.
  void LookAt(const Vec2& p) {
    const Vec2 centre = 0.5 * (set_.low_W + set_.high_W), half = Half();
    for (int i = 0; i < 2; ++i) {
      const double slack = std::max(0.0, 0.6 * (set_.high_W - set_.low_W)[i] - half[i]);
      middle_[i] = std::clamp(p[i], centre[i] - slack, centre[i] + slack);
    }
  }

  FilmSet set_;
  double height_m_ = 5;
  Vec2 middle_ = Vec2::Zero();
};

// Low beside the robot, to watch its wheels meet the floor.
class Side : public Camera {
 public:
  void Reset(const FilmSet& set, const Pose2& X_WB) override {
    distance_m_ = 0.45 + 3.6 * set.robot_radius_m;
    target_z_m_ = 0.03 + 0.5 * set.robot_radius_m;
    follower_.Reset(X_WB.p());
    panner_.Reset(X_WB.yaw_rad);
  }
  CameraView Next(const Pose2& X_WB, const CameraCue& cue) override {
    const Vec2 p = follower_.Next(X_WB.p(), cue.dt_s, 0.2, 0.1 * distance_m_);
    const double yaw = panner_.Next(X_WB.yaw_rad, cue.dt_s) - 80 * kDegree;
    constexpr double kElevation = 13 * kDegree;
    CameraView view;
    view.target_W = Lift(p, target_z_m_);
    view.eye_W = view.target_W +
                 distance_m_ * Lift(std::cos(kElevation) * Vec2(std::cos(yaw), std::sin(yaw)),
                                    std::sin(kElevation));
    view.fovy_rad = 38 * kDegree;
    return view;
  }

 private:
  double distance_m_ = 1.2, target_z_m_ = 0.1;
  Follower follower_;
  Panner panner_;
};

// From low beside what holds the robot, as near as its wheels and the floor fill the picture. It
// does not turn: what moves in the picture is the robot.
class Contact {
 public:
  void Reset(const FilmSet& set, const Pose2& X_WB, double came_rad) {
    distance_m_ = 0.35 + 3.4 * set.robot_radius_m;
    target_z_m_ = 0.02 + 0.3 * set.robot_radius_m;
    follower_.Reset(X_WB.p());
    // From the side where there is more floor: fewer walls stand between.
    const Vec2 left(-std::sin(came_rad), std::cos(came_rad));
    const bool floor_is_left = left.dot(0.5 * (set.low_W + set.high_W) - X_WB.p()) > 0;
    yaw_rad_ = came_rad + (floor_is_left ? 1 : -1) * 75 * kDegree;
  }
  CameraView Next(const Pose2& X_WB, const CameraCue& cue) {
    const Vec2 p = follower_.Next(X_WB.p(), cue.dt_s, 0.4, 0.1 * distance_m_);
    constexpr double kElevation = 15 * kDegree;
    CameraView view;
    view.target_W = Lift(p, target_z_m_);
    view.eye_W = view.target_W + distance_m_ * Lift(std::cos(kElevation) * Vec2(std::cos(yaw_rad_),
                                                                                std::sin(yaw_rad_)),
                                                    std::sin(kElevation));
    view.fovy_rad = 34 * kDegree;
    return view;
  }

 private:
  double distance_m_ = 1.2, target_z_m_ = 0.1, yaw_rad_ = 0;
  Follower follower_;
};

// From above while time flies, from behind when it runs slowly enough to watch, and from the side
// where there is something to see at the wheels.
class Auto : public Camera {
 public:
  void Reset(const FilmSet& set, const Pose2& X_WB) override {
    set_ = set;
    top_.Reset(set, X_WB);
    by_ = By::kNone;
  }
  CameraView Next(const Pose2& X_WB, const CameraCue& cue) override {
    constexpr double kRacing = 4;
    const CameraView from_above = top_.Next(X_WB, cue);
    const By before = by_;
    by_ = cue.contact_rad ? By::kContact : cue.speed_up < kRacing ? By::kChase : By::kTop;
    if (by_ == By::kTop) return from_above;
    if (by_ == By::kChase) {
      if (before != by_) chase_.Reset(set_, X_WB);
      return chase_.Next(X_WB, cue);
    }
    if (before != by_) contact_.Reset(set_, X_WB, *cue.contact_rad);
    return contact_.Next(X_WB, cue);
  }

 private:
  FilmSet set_;
  Top top_;
  Chase chase_;
  Contact contact_;
  enum class By { kNone, kTop, kChase, kContact } by_ = By::kNone;
};

template <class T>
std::unique_ptr<Camera> Make() {
  return std::make_unique<T>();
}

constexpr std::array kCameras = {
    PluginEntry<Camera>{
        "auto",
        "top in a time lapse, chase where time runs slowly, from the side at what holds the robot",
        Make<Auto>},
    PluginEntry<Camera>{"chase", "behind the robot and above it", Make<Chase>},
    PluginEntry<Camera>{"top", "from above: the whole site, or what is around the robot",
                        Make<Top>},
    PluginEntry<Camera>{"side", "low beside the robot, at its wheels", Make<Side>},
};

}  // namespace

std::span<const PluginEntry<Camera>> Cameras() { return kCameras; }

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "render/film_floor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "env/core/slopes.h"
#include "env/core/standing.h"
#include "render/cell_property.h"

namespace floorproof {
namespace {

constexpr std::array<float, 4> kPlanRgba = {0.13f, 0.33f, 0.78f, 1.0f};
constexpr std::array<float, 4> kTraceRgba = {0.58f, 0.83f, 0.78f, 1.0f};
constexpr std::array<float, 4> kBeamRgba = {0.90f, 0.25f, 0.12f, 0.55f};
constexpr std::array<float, 4> kEstimateRgba = {0.62f, 0.12f, 0.55f, 1.0f};
constexpr double kBeamZ_m = 0.006, kEstimateZ_m = 0.0075, kWindowZ_m = 0.005;
constexpr double kTraceZ_m = 0.0020, kAgainZ_m = 0.0031, kPlanZ_m = 0.0035;

std::array<float, 4> Rgba(const Rgb& colour) {
  return {static_cast<float>(colour[0]) / 255, static_cast<float>(colour[1]) / 255,
          static_cast<float>(colour[2]) / 255, 1};
}

// What lies so high over what a robot at this place stands on: the floor, or where it stands
// higher, on a cover.
Lie Under(const Vec3& p, const PaintedFloor& floor, double over_m) {
  constexpr double kHigher_m = 0.01;
  const Lie ground = floor.At(p.head<2>(), over_m);
  const bool higher = ground.gradient.isZero(0) && p.z() + over_m > ground.z_m + kHigher_m;
  return higher ? Lie(p.z() + over_m) : ground;
}

// The plane, stated at another place.
Lie LieAt(const Lie& lie, const Vec2& from, const Vec2& to) {
  return {lie.z_m + lie.gradient.dot(to - from), lie.gradient};
}

// Whether what lies so at these places lies in one plane.
bool OnePlane(const Lie& a, const Vec2& p, const Lie& b, const Vec2& q) {
  constexpr double kApart_m = 0.0015;  // less than the trace lies over the floor
  return a.gradient == b.gradient && std::abs(LieAt(a, p, q).z_m - b.z_m) <= kApart_m;
}

// A line of the plan, a stripe for each plane of the floor.
void PaintAlong(const Vec2& a, const Vec2& b, double width_m, const PaintedFloor& floor,
                FloorPaint& paint) {
  constexpr double kLook_m = 0.02;
  Vec2 from = a, last = a;
  Lie lie = floor.At(a, kPlanZ_m);
  const int n = floor.IsLevel() ? 0 : static_cast<int>((b - a).norm() / kLook_m);
  for (int i = 1; i < n; ++i) {
    const Vec2 p = a + (b - a) * i / n;
    const Lie here = floor.At(p, kPlanZ_m);
    if (!OnePlane(lie, from, here, p)) {
      paint.AddStripe(from, last, lie, width_m, kPlanRgba);
      from = p;
      lie = here;
    }
    last = p;
  }
  paint.AddStripe(from, b, lie, width_m, kPlanRgba);
}

}  // namespace

PaintedFloor::PaintedFloor(const HazardMap* map) : map_(map) {
  const auto shapes = [](const Hazard& hazard) {
    return hazard.hazard_class == HazardClass::kLevelChange || IsRamp(hazard);
  };
  if (map != nullptr && std::ranges::none_of(map->hazards, shapes)) map_ = nullptr;
}

Lie PaintedFloor::At(const Vec2& p_W, double over_m) const {
  if (map_ == nullptr) return over_m;
  const Ground ground = GroundAt(*map_, p_W);
  return {ground.height_m + over_m, ground.gradient};
}

void PaintPlan(const Path& plan, double width_m, const PaintedFloor& floor, FloorPaint& paint) {
  std::size_t from = 0;
  for (std::size_t i = 1; i < plan.size(); ++i) {
    const Vec2 &a = plan[from].p_W, &b = plan[i].p_W;
    const bool straight_on = i + 1 < plan.size() &&
                             DistanceToSegment(a, plan[i + 1].p_W, b) < 1e-3 &&
                             (b - a).dot(plan[i + 1].p_W - b) >= 0;
    if (straight_on || (b - a).norm() == 0) continue;
    PaintAlong(a, b, width_m, floor, paint);
    from = i;
  }
}

void Trail::Add(const Vec3& p, double width_m) {
  constexpr double kStep_m = 0.02, kStray_m = 0.015;
  const Vec2 q(p.x(), p.y());
  if (width_m != width_m_) run_.clear();
  width_m_ = width_m;
  if (width_m <= 0) return;
  if (run_.empty() || (q - run_.back()).norm() > kFilmJump_m) {
    Begin(q, Under(p, floor_, kTraceZ_m));
    return;
  }
  if ((q - run_.back()).norm() < kStep_m) return;
  const Lie lie = Under(p, floor_, kTraceZ_m);
  const bool strays = std::any_of(run_.begin() + 1, run_.end(), [&](const Vec2& between) {
    return DistanceToSegment(run_.front(), q, between) > kStray_m;
  });
  if (strays || !OnePlane(lie_, run_.front(), lie, q))
    Begin(run_.back(), LieAt(lie, q, run_.back()));
  run_.push_back(q);
  paint_.MoveStripe(stripe_, run_.front(), q);
}

void Trail::Begin(const Vec2& p, const Lie& lie) {
  run_.assign(1, p);
  lie_ = lie;
  paint_.AddDisc(p, lie, 0.5 * width_m_, kTraceRgba);
  stripe_ = paint_.AddStripe(p, p, lie, width_m_, kTraceRgba);
}

void SweptAgain::Show(double t_s) {
  const auto rgba = Rgba(ColourOf(CellProperty::kTwice));
  for (; next_ < patches_.size() && patches_[next_].t_s <= t_s; ++next_) {
    const FloorPatch& patch = patches_[next_];
    const Vec3 at(patch.a_W.x(), patch.a_W.y(), patch.floor_m);
    paint_.AddStripe(patch.a_W, patch.b_W, Under(at, floor_, kAgainZ_m), patch.width_m, rgba);
  }
}

Fan::Fan(const std::vector<Recording::Senses>* senses, int beams, double reach_m, FloorPaint& paint)
    : all_(senses), paint_(paint), reach_m_(reach_m) {
  auto most = static_cast<std::size_t>(beams);
  if (all_ == nullptr || (all_->empty() && most == 0)) return;
  const std::vector<Recording::Senses>& all = *all_;
  for (const auto& one : all) most = std::max(most, one.ends_W.size());
  gap_ = all.size() > 1 ? all[1].state - all[0].state : 1;
  for (std::size_t i = 1; i < all.size(); ++i)
    gap_ = std::min(gap_, all[i].state - all[i - 1].state);
  for (std::size_t i = 0; i < most; ++i)
    beams_.push_back(paint.AddStripe({0, 0}, {0, 0}, kBeamZ_m, 0.008, kBeamRgba));
  estimate_ = paint.AddStripe({0, 0}, {0, 0}, kEstimateZ_m, 0.03, kEstimateRgba);
}

void Fan::Show(std::size_t state) {
  if (all_ == nullptr || all_->empty()) return;
  const std::vector<Recording::Senses>& all = *all_;
  while (at_ + 1 < all.size() && all[at_ + 1].state <= state) ++at_;
  if (all[at_].state > state) return;
  const auto& now = all[at_];
  // A lidar that is blind has no beams.
  constexpr std::size_t kMissed = 3;  // turns
  const bool old = state - now.state > kMissed * gap_;
  for (std::size_t i = 0; i < beams_.size(); ++i)
    paint_.MoveStripe(beams_[i], now.lidar_W,
                      i < now.ends_W.size() && !old ? now.ends_W[i].cast<double>() : now.lidar_W);
  paint_.MoveStripe(estimate_, now.estimate.p(), now.estimate * Vec2(reach_m_, 0));
}

WindowRing::WindowRing(double radius_m, double width_m, FloorPaint& paint)
    : radius_m_(radius_m), paint_(paint) {
  constexpr int kChords = 64;
  const auto rgba = Rgba(kWindowBlue);
  for (int i = 0; radius_m > 0 && i < kChords; ++i)
    chords_.push_back(paint.AddStripe({0, 0}, {0, 0}, kWindowZ_m, width_m, rgba));
}

void WindowRing::Show(const Vec2& p_W) {
  const auto at = [&](std::size_t i) -> Vec2 {
    const double angle_rad = 2 * kPi * static_cast<double>(i) / static_cast<double>(chords_.size());
    return p_W + radius_m_ * Vec2(std::cos(angle_rad), std::sin(angle_rad));
  };
  for (std::size_t i = 0; i < chords_.size(); ++i) paint_.MoveStripe(chords_[i], at(i), at(i + 1));
}

}  // namespace floorproof

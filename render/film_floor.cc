// SPDX-License-Identifier: Apache-2.0
#include "render/film_floor.h"

#include <algorithm>
#include <array>
#include <cmath>

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

// On a floor that is raised, above that.
double Above(double floor_m, double z_m) { return floor_m > 0.01 ? floor_m + z_m : z_m; }

}  // namespace

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

void Trail::Add(const Vec3& p, double width_m) {
  constexpr double kStep_m = 0.02, kStray_m = 0.015;
  const double z_m = Above(p.z(), kTraceZ_m);
  const Vec2 q(p.x(), p.y());
  if (width_m != width_m_) run_.clear();
  width_m_ = width_m;
  if (width_m <= 0) return;
  if (run_.empty() || (q - run_.back()).norm() > kFilmJump_m) {
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

void Trail::Begin(const Vec2& p, double z_m) {
  run_.assign(1, p);
  z_m_ = z_m;
  paint_.AddDisc(p, z_m, 0.5 * width_m_, kTraceRgba);
  stripe_ = paint_.AddStripe(p, p, z_m, width_m_, kTraceRgba);
}

void SweptAgain::Show(double t_s) {
  const auto rgba = Rgba(ColourOf(CellProperty::kTwice));
  for (; next_ < patches_.size() && patches_[next_].t_s <= t_s; ++next_) {
    const FloorPatch& patch = patches_[next_];
    paint_.AddStripe(patch.a_W, patch.b_W, Above(patch.floor_m, kAgainZ_m), patch.width_m, rgba);
  }
}

Fan::Fan(std::span<const Recording::Senses> senses, double reach_m, FloorPaint& paint)
    : all_(senses), paint_(paint), reach_m_(reach_m) {
  if (all_.empty()) return;
  std::size_t most = 0;
  for (const auto& one : all_) most = std::max(most, one.ends_W.size());
  gap_ = all_.size() > 1 ? all_[1].state - all_[0].state : 1;
  for (std::size_t i = 1; i < all_.size(); ++i)
    gap_ = std::min(gap_, all_[i].state - all_[i - 1].state);
  for (std::size_t i = 0; i < most; ++i)
    beams_.push_back(paint.AddStripe({0, 0}, {0, 0}, kBeamZ_m, 0.008, kBeamRgba));
  estimate_ = paint.AddStripe({0, 0}, {0, 0}, kEstimateZ_m, 0.03, kEstimateRgba);
}

void Fan::Show(std::size_t state) {
  while (at_ + 1 < all_.size() && all_[at_ + 1].state <= state) ++at_;
  if (all_.empty() || all_[at_].state > state) return;
  const auto& now = all_[at_];
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

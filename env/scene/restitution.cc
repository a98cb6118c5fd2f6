// SPDX-License-Identifier: Apache-2.0
#include "env/scene/restitution.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

// T zeta where nothing asks for more: sound at steps of 1-5 ms (docs/physics.md).
constexpr double kStiffness_s = 0.01;
// A softer contact lasts so long that a robot which drives on is thrown back faster than it came.
constexpr double kSoftest_s = 0.02;
// Dead enough for no bounce to be seen; more would make the contact soft.
constexpr double kDead = 3;
constexpr double kLeastRatio = 0.005;
constexpr double kLiveliest = 0.95;

ContactSoftness Softness(double stiffness_s, double damping_ratio) {
  // Underdamped contacts keep their stiffness, so that a lively contact lasts as many steps as any
  // other. Overdamped contacts keep their damping, because a step cannot take more.
  return {stiffness_s / std::min(1.0, damping_ratio), damping_ratio};
}

// One impact at 1 m/s that begins this share of a step before the engine sees it.
double Rebound(const ContactSoftness& c, const ContactWalk& walk, double share) {
  constexpr int kMaxSteps = 10'000;
  const double h = walk.timestep_s, damping = 2 / c.time_constant_s;
  const double root = 1 / (c.time_constant_s * c.damping_ratio), stiffness = root * root;
  const double inertia = walk.implicit ? 1 + h * damping + h * h * stiffness : 1;
  double v = -1, r = share * h * v;
  for (int k = 0; k < kMaxSteps && r < 0; ++k) {
    // At the step's begin; or at its end, r + h v', solved for v'.
    const double next =
        walk.implicit ? (v - h * stiffness * r) / inertia : v - h * (damping * v + stiffness * r);
    if (next <= v && v > 0) break;
    v = std::max(v, next);
    r += h * v;
  }
  return std::max(0.0, v);
}

// The value between `lively` and `dead` at which `softness` of it rebounds as wanted.
template <class Family>
double Bisect(double lively, double dead, double wanted, const ContactWalk& walk,
              const Family& softness) {
  constexpr int kHalvings = 40;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (lively + dead) / 2;
    (ReboundOf(softness(middle), walk) > wanted ? lively : dead) = middle;
  }
  return dead;
}

}  // namespace

double ReboundOf(const ContactSoftness& softness, const ContactWalk& walk) {
  constexpr int kShares = 16;
  double sum = 0;
  for (int k = 0; k < kShares; ++k) sum += Rebound(softness, walk, (k + 0.5) / kShares);
  return sum / kShares;
}

ContactSoftness SoftnessFor(double restitution, const ContactWalk& walk) {
  const ContactSoftness dead = Softness(kStiffness_s, kDead);
  if (restitution <= 0) return dead;
  const double wanted = std::min(restitution, kLiveliest);
  if (wanted <= ReboundOf(dead, walk)) return dead;
  const auto damped = [](double ratio) { return Softness(kStiffness_s, ratio); };
  if (wanted <= ReboundOf(damped(kLeastRatio), walk))
    return damped(Bisect(kLeastRatio, kDead, wanted, walk, damped));
  const auto soft = [](double stiffness_s) { return Softness(stiffness_s, kLeastRatio); };
  if (wanted <= ReboundOf(soft(kSoftest_s), walk))
    return soft(Bisect(kSoftest_s, kStiffness_s, wanted, walk, soft));
  return soft(kSoftest_s);
}

}  // namespace floorproof

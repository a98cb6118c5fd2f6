// SPDX-License-Identifier: Apache-2.0
#include "env/scene/restitution.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

// T zeta where contacts are underdamped: sound at steps of 1-5 ms (docs/physics.md).
constexpr double kStiffness_s = 0.01;
// Dead enough for no bounce to be seen; more would make the contact soft.
constexpr double kDead = 3;
constexpr double kLiveliest = 0.99;

ContactSoftness Softness(double damping_ratio) {
  // Underdamped contacts keep their stiffness, so that a lively one lasts as many steps as another;
  // overdamped ones keep their damping, of which a step can take no more.
  return {kStiffness_s / std::min(1.0, damping_ratio), damping_ratio};
}

// One impact at 1 m/s that begins this share of a step before the engine sees it.
double Rebound(const ContactSoftness& c, double timestep_s, double share) {
  constexpr int kMostSteps = 10'000;
  const double damping = 2 / c.time_constant_s;
  const double root = 1 / (c.time_constant_s * c.damping_ratio);
  double v = -1, r = share * timestep_s * v;
  for (int k = 0; k < kMostSteps && r < 0; ++k) {
    const double push = -damping * v - root * root * r;
    if (push <= 0 && v > 0) break;
    v += timestep_s * std::max(0.0, push);
    r += timestep_s * v;
  }
  return std::max(0.0, v);
}

}  // namespace

double ReboundOf(double damping_ratio, double timestep_s) {
  constexpr int kShares = 16;
  const ContactSoftness softness = Softness(damping_ratio);
  double sum = 0;
  for (int k = 0; k < kShares; ++k) sum += Rebound(softness, timestep_s, (k + 0.5) / kShares);
  return sum / kShares;
}

ContactSoftness SoftnessFor(double restitution, double timestep_s) {
  constexpr int kHalvings = 40;
  if (restitution <= 0) return Softness(kDead);
  const double wanted = std::min(restitution, kLiveliest);
  if (wanted <= ReboundOf(kDead, timestep_s)) return Softness(kDead);
  double lively = 0, dead = kDead;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (lively + dead) / 2;
    (ReboundOf(middle, timestep_s) > wanted ? lively : dead) = middle;
  }
  return Softness(dead);
}

}  // namespace floorproof

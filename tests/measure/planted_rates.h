// SPDX-License-Identifier: Apache-2.0
// Truths to be found again: rates by formula, and encounters drawn from them.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "base/streams.h"
#include "env/core/encounter.h"
#include "env/geometry/geometry.h"
#include "planners/risk/rate_model.h"

namespace floorproof {

using PlantedRates = std::function<ModeNumbers(const Encounter&)>;

inline double Step(double x) { return 1 / (1 + std::exp(-x)); }
inline constexpr std::size_t kVeer = 0, kHeld = 1, kOverturned = 2, kThrown = 3;  // FailureMode

// What of an encounter with these rates comes.
inline void DrawOutcome(const ModeNumbers& rates, Stream& random, Encounter& e) {
  e.outcome = Encounter::Outcome::kCleared;
  const double total = Total(rates);
  if (random.Uniform() >= -std::expm1(-total)) return;
  e.outcome = Encounter::Outcome::kFailed;
  double left = random.Uniform() * total;
  int mode = 0;
  while (mode < kNumFailureModes - 1 && left > rates[mode]) left -= rates[mode++];
  e.mode = FailureMode(mode);
}

// A step of `height_m`, met with any friction and speed; all else is always the same.
inline Encounter DrawStep(Stream& random) {
  Encounter e;
  e.type = "step";
  e.size = {{"height_m", random.Uniform(0.004, 0.018)}};
  e.at.friction = random.Uniform(0.4, 0.9);
  e.at.speed_mps = random.Uniform(0.1, 0.3);
  return e;
}

// A cover, met in all ways at once: eleven things that vary, of which some do not matter.
inline Encounter DrawCover(Stream& random) {
  Encounter e;
  e.type = "cable_cover";
  e.size = {{"height_m", random.Uniform(0.002, 0.025)}, {"width_m", random.Uniform(0.08, 0.2)}};
  e.at.heading_rad = random.Uniform(-1.2, 1.2);
  e.at.lead_rad = random.Uniform(-kPi, kPi);
  e.at.speed_mps = random.Uniform(0.05, 0.4);
  e.at.friction = random.Uniform(0.4, 0.9);
  e.at.wall_m = random.Uniform();
  e.at.mass_kg = random.Uniform(3, 5);
  e.at.clearance_m = random.Uniform(0.01, 0.03);
  e.at.width_share = random.Uniform();
  e.at.over_m = random.Uniform(0.5, 1.5);
  e.at.estimate_error_m = 0.05 * std::pow(random.Uniform(), 2);
  return e;
}

// As the ladder finds it (docs/validation.md): a sharp limit of height that rises with friction and
// speed, is highest straight on and forward, and on which speeds about 0.2 m/s are worst sideways;
// with it, less sharply, veering off; above 0.3 m/s high covers throw the robot back; one in a
// thousand overturns anywhere.
inline ModeNumbers SharpCover(const Encounter& e) {
  const double height_m = e.size[0].second, forward = std::pow(std::cos(e.at.lead_rad), 2);
  const double limit_m = 0.030 * (e.at.friction - 0.25) * (0.35 + 0.65 * forward) *
                         (0.6 + 0.4 * std::min(1.0, e.at.speed_mps / 0.25)) *
                         (0.55 + 0.45 * std::cos(e.at.heading_rad));
  const double hump = std::exp(-std::pow((e.at.speed_mps - 0.2) / 0.05, 2));
  ModeNumbers rates = {};
  rates[kHeld] = 4 * Step((height_m - limit_m + 0.002 * hump * (1 - forward)) / 0.0015) + 0.001;
  rates[kVeer] =
      0.05 * std::exp(2 * std::abs(e.at.heading_rad)) * Step((height_m - 0.5 * limit_m) / 0.003);
  rates[kThrown] = 1.5 * Step((e.at.speed_mps - 0.3) / 0.02) * Step((height_m - 0.012) / 0.002);
  rates[kOverturned] = 0.001;
  return rates;
}

// Everything gradual; veering off is rarest at 0.2 m/s.
inline ModeNumbers GradualCover(const Encounter& e) {
  ModeNumbers rates = {};
  rates[kHeld] = std::exp(-4 + 60 * e.size[0].second - 3 * (e.at.friction - 0.5) +
                          std::cos(2 * e.at.lead_rad));
  rates[kVeer] =
      std::exp(-3.5 + 2 * std::abs(e.at.heading_rad) + 40 * std::pow(e.at.speed_mps - 0.2, 2));
  rates[kThrown] = std::exp(-5 + 8 * e.at.speed_mps);
  rates[kOverturned] = 0.001;
  return rates;
}

// Hardly anything ever happens.
inline ModeNumbers SafeCover(const Encounter& e) {
  ModeNumbers rates = {};
  rates[kHeld] = 0.004 * std::exp(3 * Step((e.size[0].second - 0.015) / 0.002));
  rates[kVeer] = 0.002;
  rates[kThrown] = 0.003 * std::exp(10 * (e.at.speed_mps - 0.2));
  return rates;
}

inline std::vector<Encounter> DrawEncounters(int count, const PlantedRates& rates,
                                             Encounter (*draw)(Stream&), Stream& random) {
  std::vector<Encounter> encounters;
  for (int i = 0; i < count; ++i) {
    Encounter e = draw(random);
    DrawOutcome(rates(e), random, e);
    encounters.push_back(std::move(e));
  }
  return encounters;
}

}  // namespace floorproof

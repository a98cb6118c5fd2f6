// SPDX-License-Identifier: Apache-2.0
#include "controllers/safety/safety_state.h"

namespace floorproof {

void SafetyWeights::Visit(ParamVisitor& v) {
  const Bounds rule = Between(0, 10);
  v("severity", severity, rule, "multiplies it; 1: as the paper's equations");
  v("extent", extent, rule, "the same");
  v("availability", availability, rule, "the same");
  v("persistence", persistence, rule, "the same");
  v("occurrence", occurrence, rule, "the same");
}

double QualityAssessment(Persistence persistence, Occurrence occurrence,
                         const SafetyWeights& weights) {
  return weights.persistence * static_cast<int>(persistence) * weights.occurrence *
         static_cast<int>(occurrence);
}

double SeverityOfHarm(Severity severity, HarmExtent extent, const SafetyWeights& weights) {
  return weights.severity * static_cast<int>(severity) * weights.extent * static_cast<int>(extent);
}

double SafetyStateOf(const FailureRating& rating, const Failure& failure,
                     const SafetyWeights& weights) {
  return SeverityOfHarm(rating.severity, rating.extent, weights) *
         (weights.availability * static_cast<int>(failure.availability) +
          QualityAssessment(failure.persistence, rating.occurrence, weights));
}

std::string_view Name(SafetyLevel level) {
  constexpr std::string_view kNames[] = {"high", "medium", "weak", "serious", "fatal"};
  return kNames[static_cast<int>(level)];
}

void LevelLimits::Visit(ParamVisitor& v) {
  v("high", high, NonNegative(), "greatest safety state of the level high");
  v("medium", medium, NonNegative(), "of the level medium");
  v("weak", weak, NonNegative(), "of the level weak");
  v("serious", serious, NonNegative(), "of the level serious; above it is fatal");
}

void LevelLimits::Check(const ConfigNode& node, const std::string& path) const {
  const std::pair<const char*, double> order[] = {
      {"high", high}, {"medium", medium}, {"weak", weak}, {"serious", serious}};
  for (std::size_t i = 1; i < std::size(order); ++i)
    if (!(order[i].second > order[i - 1].second))
      throw InputError(MarkOf(node, order[i].first), path + order[i].first,
                       FormatDouble(order[i].second),
                       std::string("must be above ") + order[i - 1].first + ", " +
                           FormatDouble(order[i - 1].second));
}

SafetyLevel LevelOf(double safety_state, const LevelLimits& limits) {
  if (safety_state <= limits.high) return SafetyLevel::kHigh;
  if (safety_state <= limits.medium) return SafetyLevel::kMedium;
  if (safety_state <= limits.weak) return SafetyLevel::kWeak;
  if (safety_state <= limits.serious) return SafetyLevel::kSerious;
  return SafetyLevel::kFatal;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How dangerous a failure is: the scales and equations of "safety-monitoring" (Leite, Pinto & Matos
// 2018, "A Safety Monitoring Model for a Faulty Mobile Robot"), section 3.2. Nothing here knows a
// robot.
#pragma once

#include <string_view>

#include "base/params.h"

namespace floorproof {

// What the consequences cost, beside what the service is worth.
enum class Severity { kAbsence = 0, kMinor = 2, kCatastrophic = 6 };
// Whether it stays in this component or has an impact on all.
enum class HarmExtent { kIsolated = 1, kExternal = 2 };
// What is left of the service: all of it, with loss of quality, or none.
enum class Availability { kRedundant = 0, kEminent = 1, kSingular = 2 };
// Whether it comes and goes, or does not go without help.
enum class Persistence { kIntermittent = 1, kPermanent = 2 };
// How often the service is interrupted.
enum class Occurrence { kVeryLow = 1, kLow = 2, kHigh = 3, kRelativelyHigh = 4 };

// What is said of a primitive beforehand, by experts or from tests.
struct FailureRating {
  Severity severity = Severity::kMinor;
  HarmExtent extent = HarmExtent::kIsolated;
  Availability availability = Availability::kSingular;  // after a failure
  Occurrence occurrence = Occurrence::kLow;
};

// What is seen of its failure while it runs.
struct Failure {
  Persistence persistence = Persistence::kIntermittent;
  Availability availability = Availability::kSingular;
  bool operator==(const Failure&) const = default;
};

// The paper's coefficients "to be decided according to each case, to each parameter": each
// multiplies its parameter. 1: the equations as they are printed.
struct SafetyWeights {
  double severity = 1, extent = 1, availability = 1, persistence = 1, occurrence = 1;
  void Visit(ParamVisitor& v);
};

// psi, Eq. 2: persistence x occurrence.
double QualityAssessment(Persistence persistence, Occurrence occurrence,
                         const SafetyWeights& weights = {});
// Upsilon, Eq. 3: severity x extent.
double SeverityOfHarm(Severity severity, HarmExtent extent, const SafetyWeights& weights = {});
// A primitive's share of Eq. 1: Upsilon x [chi + psi]. A skill takes the greatest of its
// primitives'; one that has not failed adds 0. From 0 to 120, without weights.
double SafetyStateOf(const FailureRating& rating, const Failure& failure,
                     const SafetyWeights& weights = {});

// What may still be delivered, from all of it to nothing.
enum class SafetyLevel { kHigh, kMedium, kWeak, kSerious, kFatal };
std::string_view Name(SafetyLevel level);

// The greatest safety state of each level but the last. "This classification can be adapted."
struct LevelLimits {
  double high = 5, medium = 20, weak = 42, serious = 60;
  void Visit(ParamVisitor& v);
  // Throws InputError, naming `path` and the key, where they do not grow.
  void Check(const ConfigNode& node, const std::string& path) const;
};
SafetyLevel LevelOf(double safety_state, const LevelLimits& limits = {});

}  // namespace floorproof

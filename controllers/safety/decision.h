// SPDX-License-Identifier: Apache-2.0
// What to do about a mission's risk: the decision state machine of "safety-monitoring", section 3.3
// and its figure 5, which the text does not hold. docs/safety.md has each edge with the sentence
// that it rests on.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "controllers/safety/safety_state.h"

namespace floorproof {

enum class DecisionState { kNormal, kFaultMode, kAssessment, kReconfiguring, kAbort };
std::string_view Name(DecisionState state);

// Why it went from one state to another: the machine's edges.
enum class DecisionEdge {
  kFatalSkill,       // any -> abort
  kSumRose,          // normal -> fault mode
  kSumIntolerable,   // fault mode -> abort
  kSumFell,          // fault mode -> normal
  kToAssess,         // fault mode -> assessment
  kBelowZmin,        // assessment -> fault mode
  kToReconfigure,    // assessment -> reconfiguring
  kNoneLeft,         // assessment -> fault mode: W reconfigurations have failed
  kReconfigured,     // reconfiguring -> fault mode
  kNotReconfigured,  // reconfiguring -> assessment
};

// The defaults are those of the paper's example (section 4), which has one skill.
struct DecisionParams {
  double z_crit = 61;   // a skill that reaches it ends the mission
  double zz_crit = 61;  // a sum of all skills that reaches it ends it in fault mode
  double z_min = 42;    // below it nothing is reconfigured
  double x_crit = 20;   // a sum above it begins fault mode
  double y_crit = 11;   // a sum below it ends fault mode
  int w = 1;            // so many reconfigurations may fail
  void Visit(ParamVisitor& v);
  // Throws InputError, naming `path` and the key, where they are out of order.
  void Check(const ConfigNode& node, const std::string& path) const;
};

// The paper's supervision primitives.
enum class SupervisionPrimitive {
  kReconfiguration,
  kAdaptation,
  kAutonomyAdjustment,
  kSafetyWaiting,
  kDefinitiveStop
};
std::string_view Name(SupervisionPrimitive primitive);
// Those of a general safety state; none of a high one.
std::span<const SupervisionPrimitive> PrimitivesFor(SafetyLevel level);

struct DecisionTransition {
  double t_s = 0;
  DecisionState from = DecisionState::kNormal, to = DecisionState::kNormal;
  DecisionEdge edge = DecisionEdge::kSumRose;
  std::size_t worst = 0;         // which skill has the greatest safety state
  double greatest = 0, sum = 0;  // R_i of that one; of all
};
// In words, with the numbers compared. `skill`: the name of the worst.
std::string Reason(const DecisionTransition& transition, const DecisionParams& params,
                   std::string_view skill);

class DecisionMachine {
 public:
  explicit DecisionMachine(const DecisionParams& params);

  // One period. `states`: R_i of each skill. `reconfigured`: what a reconfiguration came to that
  // has ended since; taken notice of in the state reconfiguring alone. Goes on until nothing more
  // is to be decided now. Allocates only where it leaves a state more often than kReserved times.
  void Update(double t_s, std::span<const double> states, std::optional<bool> reconfigured = {});

  DecisionState state() const { return state_; }
  int failed_reconfigurations() const { return failed_; }
  // All since the beginning, in order.
  std::span<const DecisionTransition> transitions() const { return transitions_; }

 private:
  static constexpr std::size_t kReserved = 256;
  std::optional<DecisionEdge> Next(std::optional<bool> reconfigured);

  DecisionParams params_;
  DecisionState state_ = DecisionState::kNormal;
  std::size_t worst_ = 0;
  double greatest_ = 0, sum_ = 0;
  std::optional<double> assessed_;  // the sum that was assessed last in this fault mode
  int failed_ = 0;                  // reconfigurations since it was normal
  std::vector<DecisionTransition> transitions_;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A risk is assessed once: fault mode leads to assessment again only where the sum of the safety
// states has changed since. Else the machine would go round and round as long as a fault lasts,
// while the paper's example "continues operating in the Fault Mode".
#include "controllers/safety/decision.h"

#include <fmt/format.h>

#include <algorithm>

namespace floorproof {
namespace {

using State = DecisionState;
using Edge = DecisionEdge;

State EndOf(Edge edge) {
  switch (edge) {
    case Edge::kFatalSkill:
    case Edge::kSumIntolerable:
      return State::kAbort;
    case Edge::kSumFell:
      return State::kNormal;
    case Edge::kToAssess:
    case Edge::kNotReconfigured:
      return State::kAssessment;
    case Edge::kToReconfigure:
      return State::kReconfiguring;
    case Edge::kSumRose:
    case Edge::kBelowZmin:
    case Edge::kNoneLeft:
    case Edge::kReconfigured:
      break;
  }
  return State::kFaultMode;
}

}  // namespace

std::string_view Name(DecisionState state) {
  constexpr std::string_view kNames[] = {"normal", "fault_mode", "assessment", "reconfiguring",
                                         "abort"};
  return kNames[static_cast<int>(state)];
}

std::string_view Name(SupervisionPrimitive primitive) {
  constexpr std::string_view kNames[] = {"reconfiguration", "adaptation", "autonomy_adjustment",
                                         "safety_waiting", "definitive_stop"};
  return kNames[static_cast<int>(primitive)];
}

std::span<const SupervisionPrimitive> PrimitivesFor(SafetyLevel level) {
  using P = SupervisionPrimitive;
  static constexpr P kAll[] = {P::kReconfiguration, P::kAdaptation, P::kAutonomyAdjustment,
                               P::kSafetyWaiting, P::kDefinitiveStop};
  const std::span<const P> all = kAll;
  switch (level) {
    case SafetyLevel::kHigh:
      break;
    case SafetyLevel::kMedium:
      return all.subspan(0, 1);
    case SafetyLevel::kWeak:
      return all.subspan(1, 1);
    case SafetyLevel::kSerious:
      return all.subspan(2, 2);
    case SafetyLevel::kFatal:
      return all.subspan(4, 1);
  }
  return {};
}

void DecisionParams::Visit(ParamVisitor& v) {
  v("z_crit", z_crit, Positive(), "Zcrit: a skill that reaches it ends the mission");
  v("zz_crit", zz_crit, Positive(), "ZZcrit: a sum over all skills that reaches it ends it, too");
  v("z_min", z_min, NonNegative(), "Zmin: below this sum nothing is reconfigured");
  v("x_crit", x_crit, NonNegative(), "Xcrit: a sum above it begins fault mode");
  v("y_crit", y_crit, NonNegative(), "Ycrit: a sum below it ends fault mode");
  v("w", w, Between(0, 1000), "W: so many reconfigurations may fail");
}

void DecisionParams::Check(const ConfigNode& node, const std::string& path) const {
  const auto refuse = [&](const char* key, double value, const char* rule, double other) {
    throw InputError(MarkOf(node, key), path + key, FormatDouble(value),
                     std::string(rule) + ", " + FormatDouble(other));
  };
  if (y_crit > x_crit) refuse("y_crit", y_crit, "must not be above x_crit", x_crit);
  if (y_crit > z_min) refuse("y_crit", y_crit, "must not be above z_min", z_min);
  if (x_crit >= zz_crit) refuse("x_crit", x_crit, "must be below zz_crit", zz_crit);
  if (z_min >= zz_crit) refuse("z_min", z_min, "must be below zz_crit", zz_crit);
  if (z_crit > zz_crit) refuse("z_crit", z_crit, "must not be above zz_crit", zz_crit);
}

std::string Reason(const DecisionTransition& transition, const DecisionParams& params,
                   std::string_view skill) {
  const DecisionTransition& t = transition;
  switch (t.edge) {
    case Edge::kFatalSkill:
      return fmt::format("{} reached Zcrit: {:g} >= {:g}", skill, t.greatest, params.z_crit);
    case Edge::kSumRose:
      return fmt::format("the sum rose above Xcrit: {:g} > {:g}", t.sum, params.x_crit);
    case Edge::kSumIntolerable:
      return fmt::format("the sum reached ZZcrit: {:g} >= {:g}", t.sum, params.zz_crit);
    case Edge::kSumFell:
      return fmt::format("the sum fell below Ycrit: {:g} < {:g}", t.sum, params.y_crit);
    case Edge::kToAssess:
      return fmt::format("a sum of {:g} is to be assessed, {} first", t.sum, skill);
    case Edge::kBelowZmin:
      return fmt::format("the sum is below Zmin: {:g} < {:g}", t.sum, params.z_min);
    case Edge::kToReconfigure:
      return fmt::format("{} is to be reconfigured, at {:g}", skill, t.greatest);
    case Edge::kNoneLeft:
      return fmt::format("as many reconfigurations have failed as W allows: {}", params.w);
    case Edge::kReconfigured:
      return fmt::format("{} was reconfigured", skill);
    case Edge::kNotReconfigured:
      return fmt::format("{} could not be reconfigured", skill);
  }
  return {};
}

DecisionMachine::DecisionMachine(const DecisionParams& params) : params_(params) {
  transitions_.reserve(kReserved);
}

void DecisionMachine::Update(double t_s, std::span<const double> states,
                             std::optional<bool> reconfigured) {
  worst_ = 0;
  greatest_ = sum_ = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    sum_ += states[i];
    if (states[i] > greatest_) greatest_ = states[i], worst_ = i;
  }
  while (const std::optional<Edge> edge = Next(reconfigured)) {
    const State to = EndOf(*edge);
    transitions_.push_back({t_s, state_, to, *edge, worst_, greatest_, sum_});
    if (state_ == State::kReconfiguring) reconfigured.reset();
    if (*edge == Edge::kNotReconfigured) ++failed_;
    if (*edge == Edge::kToAssess) assessed_ = sum_;
    if (to == State::kNormal) assessed_.reset(), failed_ = 0;
    state_ = to;
  }
}

// Every way through this ends: what leads back to a state needs another sum, or one failure more.
std::optional<DecisionEdge> DecisionMachine::Next(std::optional<bool> reconfigured) {
  if (state_ == State::kAbort) return std::nullopt;
  if (greatest_ >= params_.z_crit) return Edge::kFatalSkill;
  switch (state_) {
    case State::kNormal:
      if (sum_ > params_.x_crit) return Edge::kSumRose;
      break;
    case State::kFaultMode:
      if (sum_ >= params_.zz_crit) return Edge::kSumIntolerable;
      if (sum_ < params_.y_crit) return Edge::kSumFell;
      if (assessed_ != sum_) return Edge::kToAssess;
      break;
    case State::kAssessment:
      if (sum_ < params_.z_min) return Edge::kBelowZmin;
      return failed_ < params_.w ? Edge::kToReconfigure : Edge::kNoneLeft;
    case State::kReconfiguring:
      if (reconfigured) return *reconfigured ? Edge::kReconfigured : Edge::kNotReconfigured;
      break;
    case State::kAbort:
      break;
  }
  return std::nullopt;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "controllers/supervision/robot_primitive.h"

#include <algorithm>
#include <limits>

namespace floorproof {

void RobotPrimitive::Visit(ParamVisitor& v) {
  VisitOwn(v);
  v("timeout_s", timeout_s_, Positive(),
    "a skill that takes longer has a permanent fault (s); none: no limit");
}

void RobotPrimitive::Prepare(const Context& context) {
  rating_ = context.rating;
  weights_ = context.weights;
  board_ = &context.board;
  monitors_ = context.monitors;
  wheels_.assign(context.robot.wheels.size(), 0);
}

void RobotPrimitive::Worsen(const Failure& other, std::optional<Failure>& worst) const {
  if (!worst || SafetyStateOf(rating_, other, weights_) > SafetyStateOf(rating_, *worst, weights_))
    worst = other;
}

// Wheels are one failure, however many and whoever says so: what is left without all of them.
std::optional<Failure> RobotPrimitive::failure() const {
  std::optional<Failure> worst;
  if (const auto fails = FailsItself()) Worsen({*fails, rating_.availability}, worst);
  std::optional<Persistence> of_wheels;
  std::ranges::fill(wheels_, 0);
  for (const std::size_t m : monitors_) {
    const Monitor& monitor = *board_->monitors[m].monitor;
    const std::span<const Alarm> alarms = monitor.alarms();
    for (std::size_t i = 0; i < alarms.size(); ++i) {
      if (!alarms[i].raised()) continue;
      const Persistence persistence = alarms[i].persistence();
      if (!monitor.by_wheel()) {
        Worsen({persistence, rating_.availability}, worst);
      } else {
        wheels_[i] = 1;
        of_wheels = std::max(of_wheels.value_or(persistence), persistence);
      }
    }
  }
  if (of_wheels) Worsen({*of_wheels, board_->wheels->Without(wheels_)}, worst);
  if (overdue()) {
    if (worst)
      worst->persistence = Persistence::kPermanent;
    else if (moves())
      worst = Failure{Persistence::kPermanent, rating_.availability};
  }
  return worst;
}

void GettingOn::Visit(ParamVisitor& v) {
  v("p1_s", p1_s, Positive(), "P1: what is left must grow less in this time (s)");
}

void GettingOn::Start() {
  idle_s_ = 0;
  least_ = std::numeric_limits<double>::infinity();
}

void GettingOn::Update(double dt_s, double left, double step, double speed_share, bool excused) {
  idle_s_ += dt_s * speed_share;
  if (left < least_ - step) {
    least_ = left;
    idle_s_ = 0;
  }
  if (excused) idle_s_ = 0;
}

#define FP_PRIMITIVE(Class, name, help) std::unique_ptr<RobotPrimitive> Make##Class();
#include "controllers/supervision/primitives/list.inc"
#undef FP_PRIMITIVE

std::span<const PluginEntry<RobotPrimitive>> RobotPrimitives() {
  static constexpr PluginEntry<RobotPrimitive> kTable[] = {
#define FP_PRIMITIVE(Class, name, help) {name, help, &Make##Class},
#include "controllers/supervision/primitives/list.inc"
#undef FP_PRIMITIVE
  };
  return kTable;
}

std::vector<PrimitiveType> RobotPrimitiveTypes() {
  std::vector<PrimitiveType> types;
  for (const auto& entry : RobotPrimitives()) {
    PrimitiveType& type = types.emplace_back();
    type.name = entry.name;
    const auto primitive = entry.make();
    type.keys = {"monitors"};
    type.ends = primitive->moves();
    if (primitive->moves()) type.needs = "the wheels";
    for (const ParamDoc& doc : DocumentParams(*primitive)) type.keys.push_back(doc.name);
  }
  return types;
}

}  // namespace floorproof

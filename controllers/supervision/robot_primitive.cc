// SPDX-License-Identifier: Apache-2.0
#include "controllers/supervision/robot_primitive.h"

#include <limits>

namespace floorproof {
namespace {

// Of two failures of one primitive, the one that Eq. 1 makes more of.
void Worsen(const FailureRating& rating, const Failure& other, std::optional<Failure>& worst) {
  const auto grave = [&](const Failure& f) {
    return static_cast<int>(f.availability) + QualityAssessment(f.persistence, rating.occurrence);
  };
  if (!worst || grave(other) > grave(*worst)) worst = other;
}

}  // namespace

void RobotPrimitive::Prepare(const Context& context) {
  robot_ = &context.robot;
  rating_ = context.rating;
  board_ = &context.board;
  monitors_ = context.monitors;
  wheels_.assign(context.robot.wheels.size(), 0);
}

std::optional<Failure> RobotPrimitive::failure() const {
  std::optional<Failure> worst;
  if (const auto timed_out = TimedOut()) worst = Failure{*timed_out, rating_.availability};
  for (const std::size_t m : monitors_)
    if (const auto said = Said(*board_->monitors[m].monitor)) Worsen(rating_, *said, worst);
  return worst;
}

// Several wheels at once are one failure: what is left without all of them.
std::optional<Failure> RobotPrimitive::Said(const Monitor& monitor) const {
  std::optional<Failure> said;
  const std::span<const Alarm> alarms = monitor.alarms();
  for (std::size_t i = 0; i < alarms.size(); ++i) {
    if (monitor.by_wheel()) wheels_[i] = alarms[i].raised();
    if (alarms[i].raised()) Worsen(rating_, {alarms[i].persistence(), rating_.availability}, said);
  }
  if (said && monitor.by_wheel()) said->availability = board_->wheels->Without(wheels_);
  return said;
}

void TimeOut::Visit(ParamVisitor& v) {
  v("p1_s", p1_s, Positive(), "P1: what is left must grow less in this time (s)");
  v("timeout_s", timeout_s, Positive(), "all must be done in this time (s); none: no limit");
}

void TimeOut::Start(double t_s) {
  start_s_ = since_s_ = last_s_ = t_s;
  held_s_ = 0;
  least_ = std::numeric_limits<double>::infinity();
  persistence_.reset();
}

void TimeOut::Update(double t_s, double left, double step, bool excused) {
  if (excused) {
    held_s_ += t_s - last_s_;
    since_s_ = t_s;
  }
  last_s_ = t_s;
  if (left < least_ - step) {
    least_ = left;
    since_s_ = t_s;
  }
  persistence_.reset();
  if (t_s - since_s_ > p1_s) persistence_ = Persistence::kIntermittent;
  if (timeout_s && t_s - start_s_ - held_s_ > *timeout_s) persistence_ = Persistence::kPermanent;
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
    type.keys = {"monitors"};
    for (const ParamDoc& doc : DocumentParams(*entry.make())) type.keys.push_back(doc.name);
  }
  return types;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Primitives of a floor robot ("safety-monitoring", section 3.1). A new one is one file in
// primitives/ and one line in primitives/list.inc.
//
// What a primitive may fail by is seen by its monitors: those that its key `monitors` names, and
// its own time-outs. Its failure is the worst of theirs.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "controllers/safety/mission_run.h"
#include "controllers/supervision/board.h"

namespace floorproof {

class RobotPrimitive : public Primitive, public Configurable {
 public:
  struct Context {
    const RobotSpec& robot;
    const FailureRating& rating;
    Board& board;
    std::vector<std::size_t> monitors;  // into Board::monitors
  };
  // Before Start; what is referred to outlives it.
  void Prepare(const Context& context);

  // Whether it drives the scenario's plan; or to which place it leads, whatever the plan says.
  virtual bool drives_plan() const { return false; }
  virtual std::optional<Vec2> LeadsTo() const { return {}; }

  std::optional<Failure> failure() const final;
  std::span<const std::size_t> monitors() const { return monitors_; }

 protected:
  // By its own time-outs; the availability is as rated.
  virtual std::optional<Persistence> TimedOut() const { return {}; }
  const RobotSpec& robot() const { return *robot_; }
  const MonitorReadings& now() const { return *board_->now; }
  Board& board() { return *board_; }
  const Board& board() const { return *board_; }

 private:
  std::optional<Failure> Said(const Monitor& monitor) const;

  const RobotSpec* robot_ = nullptr;
  FailureRating rating_;
  Board* board_ = nullptr;
  std::vector<std::size_t> monitors_;
  mutable std::vector<char> wheels_;
};

std::span<const PluginEntry<RobotPrimitive>> RobotPrimitives();
// For ReadMission.
std::vector<PrimitiveType> RobotPrimitiveTypes();

// Whether something gets smaller, as a time-out asks ("if the distance error does not reduce in
// less than P1 seconds", section 4), and how long all takes.
class TimeOut {
 public:
  double p1_s = 8;
  std::optional<double> timeout_s;
  void Visit(ParamVisitor& v);

  void Start(double t_s);
  // One period: what is left, which counts as less when it is less by `step`. `excused`: it is
  // held, or stands on purpose.
  void Update(double t_s, double left, double step, bool excused);
  // It has got on, whatever is left.
  void GotOn(double t_s) { since_s_ = t_s; }
  std::optional<Persistence> persistence() const { return persistence_; }

 private:
  double start_s_ = 0, since_s_ = 0, held_s_ = 0, last_s_ = 0, least_ = 0;
  std::optional<Persistence> persistence_;
};

}  // namespace floorproof

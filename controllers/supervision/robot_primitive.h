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
#include <string_view>
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
    const SafetyWeights& weights;
    Board& board;
    std::vector<std::size_t> monitors;  // into Board::monitors
  };
  void Visit(ParamVisitor& v) final;
  // Before Start; what is referred to outlives it.
  void Prepare(const Context& context);
  // How long its skill has run.
  void SetSkillTime(double s) { skill_s_ = s; }

  // True: it moves the robot, needs the wheels, and comes to an end. False: it runs beside those
  // that do.
  virtual bool moves() const = 0;
  // Whether it drives the scenario's plan; or to which place it leads, whatever the plan says.
  virtual bool drives_plan() const { return false; }
  virtual std::optional<AskedLine> LeadsTo() const { return {}; }

  // The worst of what it may fail by, as Eq. 1 weighs it. Once its skill has taken longer than
  // timeout_s, "there is a permanent fault in the skill": each failure is permanent, and what moves
  // has failed, if by nothing else.
  std::optional<Failure> failure() const final;
  // What has failed beside its monitors, in words; empty: nothing.
  std::string_view why() const {
    if (overdue()) return "its skill took longer than timeout_s";
    return FailsItself() ? failing_ : std::string_view();
  }
  std::span<const std::size_t> monitors() const { return monitors_; }

 protected:
  // `failing`: in words, what it is that FailsItself() says.
  explicit RobotPrimitive(std::string_view failing = {}) : failing_(failing) {}
  virtual void VisitOwn(ParamVisitor& v) = 0;
  // Whether it does not get on, or goes beyond what it may, by its own account.
  virtual std::optional<Persistence> FailsItself() const { return {}; }
  const MonitorReadings& now() const { return *board_->now; }
  Board& board() { return *board_; }
  const Board& board() const { return *board_; }

 private:
  bool overdue() const { return timeout_s_ && skill_s_ > *timeout_s_; }
  void Worsen(const Failure& other, std::optional<Failure>& worst) const;

  std::string_view failing_;
  FailureRating rating_;
  SafetyWeights weights_;
  Board* board_ = nullptr;
  std::vector<std::size_t> monitors_;
  mutable std::vector<char> wheels_;
  std::optional<double> timeout_s_;
  double skill_s_ = 0;
};

std::span<const PluginEntry<RobotPrimitive>> RobotPrimitives();
// For ReadMission.
std::vector<PrimitiveType> RobotPrimitiveTypes();

// P1 ("if the distance error does not reduce in less than P1 seconds, there is an intermittent
// fault", section 4): whether what is left gets less. A robot that is let drive at a share of its
// speed has so much longer.
class GettingOn {
 public:
  double p1_s = 8;
  void Visit(ParamVisitor& v);

  void Start();
  // One period: what is left, which counts as less when it is less by `step`. `excused`: it stands
  // on purpose.
  void Update(double dt_s, double left, double step, double speed_share, bool excused);
  // It has got on, whatever is left.
  void GotOn() { idle_s_ = 0; }
  std::optional<Persistence> fails() const {
    return idle_s_ > p1_s ? std::optional(Persistence::kIntermittent) : std::nullopt;
  }

 private:
  double idle_s_ = 0, least_ = 0;
};

}  // namespace floorproof

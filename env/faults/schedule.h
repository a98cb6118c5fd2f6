// SPDX-License-Identifier: Apache-2.0
// When a robot's faults are there, and what those that are there come to.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "env/faults/fault.h"

namespace floorproof {

// By the episode's time. A fault that comes and goes has a period.
struct FaultTiming {
  double onset_s = 0;
  std::optional<double> duration_s;  // none: to the episode's end
  std::optional<double> period_s;    // none: it stays while it lasts
  double duty = 0.5;
  void Visit(ParamVisitor& v);
  bool Holds(double t_s) const;
};

struct ScheduledFault {
  std::string type, id;
  std::unique_ptr<Fault> fault;
  FaultTiming timing;
};

class FaultSchedule {
 public:
  // `faults` outlive it.
  explicit FaultSchedule(std::span<const ScheduledFault> faults) : faults_(faults) {}

  // Of an episode. Throws InputError, see Fault::Start.
  void Start(const FaultContext& context);
  // What is broken at this time; nullptr where that is what it was at the last call since Start.
  // Allocates only where it answers.
  const Alterations* Update(double t_s);

 private:
  std::span<const ScheduledFault> faults_;
  Alterations built_, now_;
  enum State : char { kSound, kBreaks, kBroken };  // breaks: since this call
  std::vector<State> holds_;  // by fault, at the last call; empty: there was none
};

}  // namespace floorproof

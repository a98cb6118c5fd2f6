// SPDX-License-Identifier: Apache-2.0
// When what a monitor sees is an alarm, and how lasting the fault behind it is.
#pragma once

#include <optional>

#include "base/params.h"
#include "controllers/safety/safety_state.h"

namespace floorproof {

struct AlarmTiming {
  double hold_s = 0.2, clear_s = 2, permanent_s = 10;
  void Visit(ParamVisitor& v) {
    v("hold_s", hold_s, NonNegative(), "an alarm is what lasts so long (s)");
    v("clear_s", clear_s, NonNegative(), "so long all must be seen to be well to end it (s)");
    v("permanent_s", permanent_s, NonNegative(),
      "a fault that is still seen so long after it was is permanent (s)");
  }
};

class Alarm {
 public:
  Alarm() = default;
  explicit Alarm(const AlarmTiming& timing) : timing_(timing) {}

  // One period. `bad`: it looks faulty now, by `value` where `limit` is the most. `well`: it is
  // seen to be well. Neither: nothing can be told, and what was said stands.
  void Update(double t_s, double dt_s, bool bad, bool well, double value, double limit) {
    if (ignored_) return;
    if (bad) {
      bad_s_ += dt_s;
      well_s_ = 0;
    } else if (well) {
      bad_s_ = 0;
      well_s_ += dt_s;
    }
    if (bad && bad_s_ >= timing_.hold_s - kRounding_s) {
      if (!raised_) value_ = value, limit_ = limit;
      raised_ = true;
      if (!first_s_) first_s_ = t_s;
      last_s_ = t_s;
    }
    if (first_s_ && well_s_ >= timing_.clear_s - kRounding_s) {
      raised_ = false;
      first_s_.reset();
    }
  }
  // Whether it is still there is to be seen afresh; until then it stands.
  void Retry() { bad_s_ = well_s_ = 0; }
  // It is forgotten until it is seen again; that it was there is not.
  void Rearm() {
    raised_ = false;
    bad_s_ = well_s_ = 0;
  }
  void Ignore() {
    ignored_ = true;
    raised_ = false;
    first_s_.reset();
  }

  bool raised() const { return raised_; }
  // Intermittent, until it has been seen for permanent_s with no clear_s in which all was well.
  Persistence persistence() const {
    const bool lasts = raised_ && last_s_ - *first_s_ >= timing_.permanent_s - kRounding_s;
    return lasts ? Persistence::kPermanent : Persistence::kIntermittent;
  }
  // When it was last seen to be bad; only while it is raised.
  double last_s() const { return last_s_; }
  // What raised it, in its monitor's unit, and the limit that this was beyond.
  double value() const { return value_; }
  double limit() const { return limit_; }

 private:
  static constexpr double kRounding_s = 1e-9;  // of times that are sums of periods

  AlarmTiming timing_;
  bool raised_ = false, ignored_ = false;
  double bad_s_ = 0, well_s_ = 0, last_s_ = 0, value_ = 0, limit_ = 0;
  std::optional<double> first_s_;
};

// First-order low pass, exact for steps of dt_s; the first value is taken as it is.
class LowPass {
 public:
  double Update(double value, double dt_s, double time_s) {
    value_ = value_ ? *value_ + (value - *value_) * dt_s / (time_s + dt_s) : value;
    return *value_;
  }
  void Reset() { value_.reset(); }

 private:
  std::optional<double> value_;
};

}  // namespace floorproof

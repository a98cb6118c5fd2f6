// SPDX-License-Identifier: Apache-2.0
// Fixed: two one-sided exact tests at an n set beforehand, so that each wrong verdict has chance at
// most 1 - confidence. Since k only grows, the rule is a pair of counts: pass with at most so many
// failures, fail with at least so many; stopping once one of them is certain gives the verdict that
// max_n would have given, and hence costs nothing. Looking at the bound of the episodes so far
// would: it passes falsely several times as often as it says (tests/stats holds the comparison).
// Sequential: sequential_gate.h. Clopper-Pearson's bound at its stopping time would be too short;
// the bounds reported are its own.
#include "stats/gate.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "base/params.h"
#include "base/quantity.h"
#include "stats/binomial.h"
#include "stats/checks.h"
#include "stats/sequential_gate.h"

namespace floorproof {
namespace {

constexpr int kMaxEpisodes = 1'000'000'000;

// The first number in [from, last] that `holds`, which all after it do too; last + 1 when none.
template <typename Holds>
int First(int from, int last, Holds holds) {
  while (from <= last) {
    const int middle = from + (last - from) / 2;
    if (holds(middle)) {
      last = middle - 1;
    } else {
      from = middle + 1;
    }
  }
  return from;
}

void CheckLimits(const GateSettings& s) {
  CheckLimit("max_rate", s.max_rate);
  if (!(s.confidence >= 0.5 && s.confidence < 1))
    throw InputError({}, "confidence", FormatDouble(s.confidence),
                     "must be at least 0.5 and less than 1");
  if (s.min_n < 1) throw InputError({}, "min_n", std::to_string(s.min_n), "must be >= 1");
}

std::string Percent(double rate) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g %%", 100 * rate);
  return text;
}

std::string Sentence(const GateSettings& settings, const GateReport& report) {
  const bool fixed = settings.mode == GateMode::kFixed;
  const bool early = report.n < settings.max_n;
  const auto number = [](int n) { return FixedText(n, 0); };
  std::string text = number(report.k) + " of ";
  if (early) text += "the first ";
  if (early && fixed) text += number(report.n) + " of ";
  text += CountText(early && !fixed ? report.n : settings.max_n, "episode") + "; ";
  if (!report.final)
    return text + (fixed ? "judged at " : "goes on to at most ") + number(settings.max_n);
  const std::string limit = Percent(settings.max_rate);
  text += "with " + Percent(settings.confidence) + " confidence the rate is ";
  if (report.verdict == GateVerdict::kPassed) {
    text += "below " + limit + " (at most " + Percent(report.rate.upper) + ")";
  } else if (report.verdict == GateVerdict::kFailed) {
    text += "above " + limit + " (at least " + Percent(report.rate.lower) + ")";
  } else {
    text += "shown neither below nor above " + limit + " (at least " + Percent(report.rate.lower) +
            ", at most " + Percent(report.rate.upper) + ")";
  }
  return fixed && early ? text + ", whatever the rest brings" : text;
}

}  // namespace

const char* GateVerdictName(GateVerdict verdict) {
  switch (verdict) {
    case GateVerdict::kPassed:
      return "passed";
    case GateVerdict::kFailed:
      return "failed";
    case GateVerdict::kUndecided:
      break;
  }
  return "undecided";
}

int FewestEpisodesToPass(const GateSettings& settings) {
  CheckLimits(settings);
  const double p0 = settings.max_rate, confidence = settings.confidence;
  if (settings.mode == GateMode::kFixed)
    return First(1, kMaxEpisodes,
                 [&](int n) { return ClopperPearsonUpper(0, n, confidence) < p0; });
  const int n = First(1, kMaxEpisodes, [&](int m) {
    return JudgeSequentially(0, m, p0, confidence) == SequentialOutcome::kPass;
  });
  return std::max(n, settings.min_n);
}

void CheckGate(const GateSettings& settings) {
  const int fewest = FewestEpisodesToPass(settings);
  if (settings.max_n < settings.min_n)
    throw InputError({}, "max_n", std::to_string(settings.max_n),
                     "must be >= min_n = " + std::to_string(settings.min_n));
  if (settings.max_n > kMaxEpisodes)
    throw InputError({}, "max_n", std::to_string(settings.max_n),
                     "must be <= " + std::to_string(kMaxEpisodes));
  if (settings.max_n < fewest)
    throw InputError({}, "max_n", std::to_string(settings.max_n),
                     "must be >= " + std::to_string(fewest) +
                         ": with fewer episodes no outcome passes at this max_rate and confidence");
}

Gate::Gate(const GateSettings& settings) : settings_(settings) {
  CheckGate(settings);
  if (settings.mode == GateMode::kFixed) PlanFixed();
}

void Gate::PlanFixed() {
  const int n = settings_.max_n;
  most_that_pass_ =
      First(0, n,
            [&](int k) {
              return ClopperPearsonUpper(k, n, settings_.confidence) >= settings_.max_rate;
            }) -
      1;
  least_that_fail_ = First(0, n, [&](int k) {
    return ClopperPearsonLower(k, n, settings_.confidence) > settings_.max_rate;
  });
}

void Gate::End() {
  if (final_) return;
  if (settings_.mode == GateMode::kFixed && n_ > 0) {
    settings_.max_n = n_;
    PlanFixed();
    JudgeFixed();
  }
  final_ = true;
}

void Gate::Add(bool failure) {
  if (final_) return;
  ++n_;
  if (failure) ++k_;
  if (settings_.mode == GateMode::kFixed) {
    JudgeFixed();
  } else {
    JudgeSequential();
  }
}

void Gate::JudgeFixed() {
  const int rest = settings_.max_n - n_;
  if (k_ >= least_that_fail_) {
    verdict_ = GateVerdict::kFailed;
  } else if (k_ + rest <= most_that_pass_) {
    verdict_ = GateVerdict::kPassed;
  }
  final_ =
      verdict_ != GateVerdict::kUndecided || (k_ > most_that_pass_ && k_ + rest < least_that_fail_);
}

void Gate::JudgeSequential() {
  if (n_ < settings_.min_n) return;
  switch (JudgeSequentially(k_, n_, settings_.max_rate, settings_.confidence)) {
    case SequentialOutcome::kPass:
      verdict_ = GateVerdict::kPassed;
      break;
    case SequentialOutcome::kFail:
      verdict_ = GateVerdict::kFailed;
      break;
    case SequentialOutcome::kGoOn:
      break;
  }
  final_ = verdict_ != GateVerdict::kUndecided || n_ >= settings_.max_n;
}

GateReport Gate::Report() const {
  GateReport report;
  report.verdict = verdict_;
  report.final = final_;
  report.n = n_;
  report.k = k_;
  if (settings_.mode == GateMode::kFixed) {
    const int n = settings_.max_n;
    report.rate = {ClopperPearsonLower(k_, n, settings_.confidence),
                   ClopperPearsonUpper(k_ + (n - n_), n, settings_.confidence)};
  } else {
    report.rate = AnytimeBounds(k_, n_, settings_.confidence);
    report.log_e_pass = LogEPass(k_, n_, settings_.max_rate);
    report.log_e_fail = LogEFail(k_, n_, settings_.max_rate);
  }
  report.text = Sentence(settings_, report);
  return report;
}

}  // namespace floorproof

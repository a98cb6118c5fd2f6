// SPDX-License-Identifier: Apache-2.0
// Mixture e-processes (Robbins, Annals of Mathematical Statistics 41 (1970) 1397; Ramdas, Grunwald,
// Vovk and Shafer, Statistical Science 38 (2023) 576). For one p < p0 the likelihood ratio of p to
// p0 is, while the true rate is p0 or above, a product of factors of mean at most 1; so is its
// average over any prior on p < p0, which is E_pass. E_fail mirrors it on p > p0.
//
//   E_pass = int_{p < p0} L(p) Beta(p; 1, b) dp / (L(p0) int_{p < p0} Beta(p; 1, b) dp),
//   L(p) = p^k (1 - p)^(n - k)
//
// Any prior is valid; it says only where the gate is quick. Before truncation the means are at odds
// of a quarter of p0's (pass: robots well within the limit) and of five times p0's (fail). At
// p0 = 1 % and 95 % no failure in 361 episodes passes.
// Never both: L has one peak, at k / n. Where that is >= p0, L(p) <= L(p0) for every p < p0, so
// E_pass <= 1; where it is <= p0, E_fail <= 1.
// Assumes independent episodes of one rate, taken in an order fixed beforehand (their ids).
#include "stats/sequential_gate.h"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "stats/checks.h"

namespace floorproof {
namespace {

constexpr double kPassOdds = 1.0 / 4;  // the prior's mean odds over those of p0
constexpr double kFailOdds = 5;

// Beta(1, b) has mean odds 1 / b.
double PriorB(double odds_ratio, double p0) { return (1 - p0) / (odds_ratio * p0); }

// log of int_0^x t^(a - 1) (1 - t)^(b - 1) dt.
double LogIncompleteBeta(double a, double b, double x) {
  using boost::math::lgamma;
  const double share = boost::math::ibeta(a, b, x);
  if (share > 1e-280) return std::log(share) + lgamma(a) + lgamma(b) - lgamma(a + b);
  // So far in the tail the share underflows. The series from the end point (DLMF 8.17.8) has
  // positive terms there, which shrink fast because x is far below the mean a / (a + b).
  double sum = 1, term = 1;
  for (int j = 0; term > 1e-17 * sum; ++j) {
    term *= (a + b + j) / (a + 1 + j) * x;
    sum += term;
  }
  return a * std::log(x) + b * std::log1p(-x) - std::log(a) + std::log(sum);
}

double LogLikelihood(int k, int n, double p) { return k * std::log(p) + (n - k) * std::log1p(-p); }

// The rate at which the test begins to reject, on the way from `inside`, which it does not reject,
// to `end`, which is returned where even `nearly_end` is not rejected.
template <typename Rejects>
double FirstRejected(double inside, double nearly_end, double end, Rejects rejects) {
  if (!rejects(nearly_end)) return end;
  double outside = nearly_end;
  for (int i = 0; i < 60; ++i) {
    const double middle = (inside + outside) / 2;
    (rejects(middle) ? outside : inside) = middle;
  }
  return outside;
}

}  // namespace

double LogEPass(int k, int n, double p0) {
  CheckCounts(k, n);
  CheckLimit("p0", p0);
  const double b = PriorB(kPassOdds, p0);
  const double log_prior = std::log(-std::expm1(b * std::log1p(-p0)) / b);
  return LogIncompleteBeta(k + 1.0, b + (n - k), p0) - log_prior - LogLikelihood(k, n, p0);
}

double LogEFail(int k, int n, double p0) {
  CheckCounts(k, n);
  CheckLimit("p0", p0);
  const double b = PriorB(kFailOdds, p0);
  const double log_prior = b * std::log1p(-p0) - std::log(b);
  return LogIncompleteBeta(b + (n - k), k + 1.0, 1 - p0) - log_prior - LogLikelihood(k, n, p0);
}

SequentialOutcome JudgeSequentially(int k, int n, double p0, double confidence) {
  CheckConfidence(confidence);
  const double threshold = -std::log1p(-confidence);
  // Only the one that can exceed 1 is worked out.
  if (k < n * p0)
    return LogEPass(k, n, p0) >= threshold ? SequentialOutcome::kPass : SequentialOutcome::kGoOn;
  return LogEFail(k, n, p0) >= threshold ? SequentialOutcome::kFail : SequentialOutcome::kGoOn;
}

Interval AnytimeBounds(int k, int n, double confidence) {
  CheckCounts(k, n);
  CheckConfidence(confidence);
  if (n == 0) return {0, 1};
  const double threshold = -std::log1p(-confidence);
  const double rate = static_cast<double>(k) / n;
  Interval bounds{0, 1};
  if (rate > kLeastLimit)
    bounds.lower = FirstRejected(rate, kLeastLimit, 0,
                                 [&](double p0) { return LogEFail(k, n, p0) >= threshold; });
  if (rate < 1 - kLeastLimit)
    bounds.upper = FirstRejected(rate, 1 - kLeastLimit, 1,
                                 [&](double p0) { return LogEPass(k, n, p0) >= threshold; });
  return bounds;
}

}  // namespace floorproof

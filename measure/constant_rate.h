// SPDX-License-Identifier: Apache-2.0
// Etas of what hardly ever happened, or hardly ever did not: the same whatever a meeting is like,
// or after those of like kinds.
#pragma once

#include <functional>
#include <string_view>

#include "planners/risk/rate_model.h"

namespace floorproof {

// The rate of what happened `of.events` times in so much exposure; `rate` is what is to be
// predicted, above 0. Members: quantiles of Gamma(events + 1, exposure), whose upper 95 % bound is
// 3 / exposure where nothing happened; `name` is of the stream that shuffles them.
void SetConstantRate(double exposure, double rate, std::string_view name, LinearPredictor& of);

// After `like`, of like kinds together. `expected(shift)` is how often it should have happened by
// these, were their eta `shift` higher, N at 0. The eta is shifted so that N (events + 2) / (N + 2)
// are expected: as if what is alike had already been seen twice. Members: those of `like`, shifted
// by quantiles of Gamma(events + 2) in the place of events + 2.
void SetShifted(const LinearPredictor& like, const std::function<double(double shift)>& expected,
                std::string_view name, LinearPredictor& of);

// The share of what happened `of.events` times in n: (k + 1/2) / (n + 1) (Krichevsky & Trofimov,
// IEEE Trans. Inf. Theory 27 (1981) 199). Members: quantiles of Beta(k + 1, n - k + 1).
void SetConstantShare(int n, std::string_view name, LinearPredictor& of);

// A share that is taken, not measured.
void SetShare(double share, LinearPredictor& of);

}  // namespace floorproof

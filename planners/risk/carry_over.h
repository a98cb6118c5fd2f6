// SPDX-License-Identifier: Apache-2.0
// How often plans fail whose meetings' rates say that they will in a share of their drives.
#pragma once

namespace floorproof {

double LogOdds(double p);  // log(p / (1 - p)); 0 < p < 1

// Rates are means over all ways to meet a hazard of these covariates; a plan takes one of them, and
// mild ones more often than single encounters do. What that comes to was learned from plans that
// were driven: a line in the log odds, log(p / (1 - p)), of failure (Cox, Biometrika 45 (1958)
// 562). As it stands it changes nothing.
struct CarryOver {
  double intercept = 0, slope = 1;
  // What it was learned from; `expected` is how many of the drives rates alone have fail.
  int plans = 0, drives = 0, failed = 0;
  double expected = 0;

  // Of a plan whose rates come to `p`, in [0, 1], the probability that it fails. Ascending in p.
  double Of(double p) const;
};

}  // namespace floorproof

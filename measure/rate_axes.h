// SPDX-License-Identifier: Apache-2.0
// The functions of one covariate that rates are made of: cubic regression splines, in the order of
// how much they bend (Demmler & Reinsch, Numer. Math. 24 (1975) 375; Wood, Generalized Additive
// Models (2017), section 5.3).
#pragma once

#include <string>
#include <vector>

#include "planners/risk/rate_model.h"

namespace floorproof {

// From the covariate's measured values, in any order. Each function has mean 0 over them. Without a
// period the first one is linear, of variance 1; the second has variance 1 too, and each later one
// the less the more it bends, so that one penalty on all coefficients is a penalty on bending.
// Knots stand at quantiles, 8 at most; values that were always the same give none. An angle
// (`period`) with a gap of more than a quarter turn is taken as measured from behind the widest gap
// to before it; else as periodic, with 12 knots.
RateAxis MakeRateAxis(std::string name, bool of_hazard, std::vector<double> values, double period);

// How many functions MakeRateAxis gave it: the first ones. Fits add others.
std::size_t SmoothFunctions(const RateAxis& axis);
// How many of these products are made of.
std::size_t FunctionsOfProducts(const RateAxis& axis);

}  // namespace floorproof

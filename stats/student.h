// SPDX-License-Identifier: Apache-2.0
// An interval of a mean.
#pragma once

#include "stats/interval.h"

namespace floorproof {

// Student's two-sided interval: mean -+ t * standard_error, t of so many degrees of freedom, which
// need not be whole (Satterthwaite's are not). It holds where the mean is normal, or nearly so.
// Throws InputError unless standard_error is finite and >= 0, degrees_of_freedom is finite and > 0,
// and 0 < confidence < 1.
Interval StudentInterval(double mean, double standard_error, double degrees_of_freedom,
                         double confidence);

}  // namespace floorproof

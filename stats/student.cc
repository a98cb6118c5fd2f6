// SPDX-License-Identifier: Apache-2.0
#include "stats/student.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "base/error.h"
#include "base/params.h"
#include "stats/checks.h"

namespace floorproof {

Interval StudentInterval(double mean, double standard_error, double degrees_of_freedom,
                         double confidence) {
  CheckConfidence(confidence);
  if (!(standard_error >= 0 && std::isfinite(standard_error)))
    throw InputError({}, "standard_error", FormatDouble(standard_error), "must be finite and >= 0");
  if (!(degrees_of_freedom > 0 && std::isfinite(degrees_of_freedom)))
    throw InputError({}, "degrees_of_freedom", FormatDouble(degrees_of_freedom),
                     "must be finite and > 0");
  const boost::math::students_t t(degrees_of_freedom);
  const double reach = standard_error * boost::math::quantile(t, (1 + confidence) / 2);
  return {mean - reach, mean + reach};
}

}  // namespace floorproof

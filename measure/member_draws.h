// SPDX-License-Identifier: Apache-2.0
// A few vectors that stand for a posterior of many dimensions.
#pragma once

#include <Eigen/Core>
#include <string_view>

namespace floorproof {

// Deviations from the best vector (by coefficient, by member): their mean is 0, their expected
// covariance (with kRateMembers - 1 in the denominator) is the inverse of `inverse_covariance`. In
// the directions that matter most for what is predicted (`slopes`: by meeting, of a prediction by
// the coefficients) it is that exactly; the rest is drawn at random. `name`: of the stream, which
// depends on the other arguments too.
Eigen::MatrixXd MemberDeviations(const Eigen::MatrixXd& inverse_covariance,
                                 const Eigen::MatrixXd& slopes, std::string_view name);

}  // namespace floorproof

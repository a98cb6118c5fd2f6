// SPDX-License-Identifier: Apache-2.0
// Where failures are: a mixture of heavy-tailed densities, fitted to failures that were found.
//
// Gaussians by expectation maximisation, as many as the Bayesian information criterion allows. What
// the failures leave as it is stays nominal: along directions in which their spread differs from
// the standard normal one by no more than that of as many draws would (the edges of Marchenko and
// Pastur 1967) it is set to 1. Each is then widened to Student's t of 4 degrees of freedom, so that
// no failure beside those that were seen gets a huge importance weight.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/streams.h"

namespace floorproof {

struct WeightedPoints {
  Eigen::MatrixXd u;        // a column each
  Eigen::VectorXd weights;  // their sum: how many independent points they are worth
};

class FailureMixture {
 public:
  // Of at least one point. `noisy`: what fails at a point may not fail there again. Then half of
  // the density lies halfway to the nominal one, as the geometric mean of the two: where a failure
  // takes unlikely noise, few draws fail, and the best density, which goes with the root of how
  // many do, lies nearer to the origin than failures.
  FailureMixture(const WeightedPoints& points, bool noisy, Stream& stream);

  double LogDensity(const Eigen::VectorXd& u) const;
  Eigen::VectorXd Draw(Stream& stream) const;
  // Parts that overlap are one region; regions are numbered from 0.
  int regions() const { return regions_; }
  int RegionOf(const Eigen::VectorXd& u) const;

 private:
  struct Part {
    double weight = 0;
    Eigen::VectorXd mean;
    Eigen::MatrixXd axes;       // orthonormal, a column each
    Eigen::VectorXd deviation;  // along each of them
    int shaped = 0;             // axes along which it is not nominal
    int region = 0;

    Eigen::VectorXd Whitened(const Eigen::VectorXd& u) const {
      return (axes.transpose() * (u - mean)).cwiseQuotient(deviation);
    }
    Eigen::MatrixXd Covariance() const {
      return axes * deviation.cwiseAbs2().asDiagonal() * axes.transpose();
    }
    double LogVolume() const { return deviation.array().log().sum(); }
  };
  struct Fitted {
    std::vector<Part> parts;
    double log_likelihood = 0;
  };
  static Fitted Fit(const WeightedPoints& points, int parts, Stream& stream);
  static Part Shape(const WeightedPoints& points, const Eigen::VectorXd& share);
  static double LogNormal(const Part& part, const Eigen::VectorXd& u);
  static double LogStudent(const Part& part, const Eigen::VectorXd& u);
  void FindRegions();
  void AddHalfway();

  std::vector<Part> parts_;
  int regions_ = 0;
};

// log(sum of exp(x)), where that may overflow.
double LogSumExp(const Eigen::VectorXd& x);

}  // namespace floorproof

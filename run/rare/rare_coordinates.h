// SPDX-License-Identifier: Apache-2.0
// What a search for rare failures moves in: each key that `randomise` draws is a coordinate,
// brought to the standard normal distribution through its own.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "run/scenario/draws.h"
#include "stats/rare/rare_problem.h"

namespace floorproof {

class ScenarioFile;
struct Scenario;

class RareCoordinates {
 public:
  // Throws InputError where nothing that is drawn can differ (noise alone has no coordinate), or
  // more than kMostCoordinates keys can. `scenario`: the file, read without an episode.
  RareCoordinates(const ScenarioFile& file, const Scenario& scenario);

  Eigen::Index size() const { return static_cast<Eigen::Index>(varying_.size()); }
  // Whether episodes of the same draws can differ, as sensors, an estimator or the floor draw by
  // themselves. Trials then have a number of noise, which is an episode's.
  bool noisy() const { return noisy_; }
  std::vector<std::string> keys() const;

  // What is drawn at that point: of a distribution the quantile, of a choice the part of the line
  // that is its own. Keys that cannot differ have their value.
  Drawn DrawnAt(const Eigen::VectorXd& u) const;
  // The same with the key `episode`, where there is noise: set one by one they give that trial.
  Drawn AsSet(const Trial& trial) const;

 private:
  const std::vector<RandomisedKey>& keys_;
  std::vector<std::size_t> varying_;  // of these
  bool noisy_ = false;
};

}  // namespace floorproof

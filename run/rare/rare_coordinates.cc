// SPDX-License-Identifier: Apache-2.0
#include "run/rare/rare_coordinates.h"

#include <algorithm>
#include <cmath>

#include "run/scenario/chance.h"
#include "run/scenario/scenario_file.h"
#include "stats/rare/rare_estimate.h"

namespace floorproof {
namespace {

// Within (0, 1): quantiles at its ends may be infinite.
double Share(double u) {
  return std::clamp(0.5 * std::erfc(-u / std::sqrt(2.0)), 0x1p-60, 1 - 0x1p-53);
}

}  // namespace

RareCoordinates::RareCoordinates(const ScenarioFile& file, const Scenario& scenario)
    : keys_(file.randomised()) {
  noisy_ = NoiseCanDiffer(scenario);
  for (std::size_t i = 0; i < keys_.size(); ++i)
    if (keys_[i].distribution.varies()) varying_.push_back(i);
  if (varying_.empty())
    throw InputError({file.file().string(), 0}, "randomise", "",
                     noisy_ ? "draws nothing: noise alone can only be counted (floorproof campaign)"
                            : std::string("draws nothing: ") + kHowToDiffer);
  if (size() > kMostCoordinates)
    throw InputError({file.file().string(), 0}, "randomise", std::to_string(size()),
                     "draws more than " + std::to_string(kMostCoordinates) +
                         " keys, too many to search: --set holds some of them");
  // What is drawn may bring noise: each choice by itself, each other key at both of its ends.
  const auto look = [&](const Drawn& drawn) {
    try {
      noisy_ = noisy_ || NoiseCanDiffer(file.ReadDrawn(0, drawn));
    } catch (const InputError&) {  // no episode
    }
  };
  const Eigen::VectorXd middle = Eigen::VectorXd::Zero(size());
  for (std::size_t i = 0; i < varying_.size() && !noisy_; ++i) {
    Drawn drawn = DrawnAt(middle);
    for (const ConfigNode& choice : keys_[varying_[i]].distribution.choices) {
      drawn[varying_[i]].second = choice;
      look(drawn);
    }
    for (const double end : {-3.0, 3.0})
      look(DrawnAt(end * Eigen::VectorXd::Unit(size(), static_cast<Eigen::Index>(i))));
  }
}

std::vector<std::string> RareCoordinates::keys() const {
  std::vector<std::string> keys;
  for (const std::size_t i : varying_) keys.push_back(keys_[i].key_path);
  return keys;
}

Drawn RareCoordinates::DrawnAt(const Eigen::VectorXd& u) const {
  Drawn drawn;
  Eigen::Index next = 0;
  for (const RandomisedKey& key : keys_) {
    const bool varies = key.distribution.varies();
    drawn.emplace_back(key.key_path, key.distribution.Quantile(varies ? Share(u[next++]) : 0.5));
    drawn.back().second.mark = key.mark;
  }
  return drawn;
}

Drawn RareCoordinates::AsSet(const Trial& trial) const {
  Drawn drawn = DrawnAt(trial.u);
  if (noisy_)
    drawn.emplace(drawn.begin(), "episode", ConfigNode::Scalar(std::to_string(trial.noise)));
  return drawn;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "stats/rare/subset_pilot.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace floorproof {
namespace {

constexpr int kMostLevels = 14;  // 1e-14 is rarer than any model of a floor is right
constexpr std::size_t kFewestSeeds = 4;
constexpr double kWeightInChain = 0.25;
constexpr double kWantedShare = 0.44;  // of steps that are taken
constexpr double kLeastWidth = 0.02;

}  // namespace

std::string_view Name(SubsetPilot::End end) {
  switch (end) {
    case SubsetPilot::End::kFoundFailures:
      return "found failures";
    case SubsetPilot::End::kStalled:
      return "came no nearer to a failure";
    case SubsetPilot::End::kCutOff:
      return "used up its trials";
    case SubsetPilot::End::kGoesOn:
      break;
  }
  return "goes on";
}

Eigen::VectorXd NormalVector(Stream& stream, Eigen::Index dimensions) {
  Eigen::VectorXd z(dimensions);
  for (double& value : z) value = stream.Normal();
  return z;
}

SubsetPilot::SubsetPilot(const RareProblem& problem, std::uint64_t seed, int number)
    : problem_(problem), stream_(seed, static_cast<std::uint64_t>(number), "rare.pilot") {}

void SubsetPilot::Propose(std::uint64_t first, std::vector<Trial>& trials) {
  proposed_.clear();
  const auto fresh = [&] { return problem_.noisy ? first + proposed_.size() : 0; };
  if (level_ == 0) {
    for (int i = 0; i < kDraws; ++i)
      proposed_.push_back({NormalVector(stream_, problem_.dimensions), fresh()});
  } else {
    const double keeps = std::sqrt(1 - width_ * width_);
    for (const State& at : chains_) {
      const Eigen::VectorXd step = NormalVector(stream_, problem_.dimensions);
      // Noise either stays, so that the coordinates alone decide, or is another.
      const bool stays = !problem_.noisy || stream_.Uniform() < 0.5;
      const std::uint64_t other = fresh();
      proposed_.push_back({keeps * at.trial.u + width_ * step, stays ? at.trial.noise : other});
    }
  }
  trials.insert(trials.end(), proposed_.begin(), proposed_.end());
}

void SubsetPilot::CutOff() {
  end_ = End::kCutOff;
  const auto failed =
      std::ranges::count_if(states_, [](const State& s) { return s.result.failed; });
  if (failed > 0)
    probability_ = above_ * static_cast<double>(failed) / static_cast<double>(states_.size());
}

void SubsetPilot::Keep(const State& state) {
  states_.push_back(state);
  nominal_draws_ += level_ == 0 && state.result.counts;
  if (!state.result.failed) return;
  failures_.push_back({state.trial, level_ == 0 ? 1 : kWeightInChain});
  nominal_failures_ += level_ == 0;
}

void SubsetPilot::Take(std::span<const TrialResult> results) {
  if (level_ == 0) {
    for (std::size_t i = 0; i < proposed_.size(); ++i) Keep({proposed_[i], results[i]});
    return EndLevel();
  }
  int taken = 0;
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    if (AsNear(results[i], threshold_)) {
      chains_[i] = {proposed_[i], results[i]};
      ++taken;
    }
    Keep(chains_[i]);
  }
  const double share = taken / static_cast<double>(chains_.size());
  width_ *= std::exp((share - kWantedShare) / std::sqrt(step_ + 1.0));
  width_ = std::clamp(width_, kLeastWidth, 1.0);
  if (++step_ == steps_) EndLevel();
}

void SubsetPilot::EndLevel() {
  const auto n = static_cast<double>(states_.size());
  const auto failed = static_cast<double>(
      std::ranges::count_if(states_, [](const State& s) { return s.result.failed; }));
  if (failed >= kSeeds) {
    probability_ = above_ * failed / n;
    end_ = End::kFoundFailures;
    return;
  }
  std::ranges::stable_sort(
      states_, [](const State& a, const State& b) { return Nearness(a.result, b.result) < 0; });
  // Those that are as near as the last belong to the level, too: else it would not be one.
  const auto as_near_as = [&](const State& last) {
    threshold_ = last.result;
    const auto beyond = std::ranges::find_if(
        states_, [&](const State& s) { return !AsNear(s.result, threshold_); });
    return static_cast<std::size_t>(beyond - states_.begin());
  };
  std::size_t within = as_near_as(states_[kSeeds - 1]);
  // Where most are as far as can be, the few that are nearer lead on.
  if (within == states_.size()) {
    const auto far = std::ranges::find_if(
        states_, [&](const State& s) { return AsNear(states_.back().result, s.result); });
    const auto nearer = static_cast<std::size_t>(far - states_.begin());
    if (nearer >= kFewestSeeds) within = as_near_as(states_[nearer - 1]);
  }
  if (within == states_.size() || level_ + 1 == kMostLevels) {
    // What failures it met on its way say something all the same.
    probability_ = above_ * failed / n;
    end_ = failed > 0 ? End::kFoundFailures : End::kStalled;
    return;
  }
  above_ *= static_cast<double>(within) / n;
  // Any of them, where there are more than go on.
  const std::size_t seeds = std::min<std::size_t>(kSeeds, within);
  for (std::size_t i = 0; i < seeds; ++i)
    std::swap(states_[i], states_[i + stream_.Below(within - i)]);
  chains_.assign(states_.begin(), states_.begin() + static_cast<std::ptrdiff_t>(seeds));
  states_.clear();
  ++level_;
  step_ = 1;
  steps_ = kDraws / static_cast<int>(seeds);
  for (const State& seed : chains_) Keep(seed);
}

}  // namespace floorproof

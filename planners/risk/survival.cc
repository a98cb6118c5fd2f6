// SPDX-License-Identifier: Apache-2.0
// Intervals are made of z = asin(sqrt(p)), whose spread depends little on p. The members of the
// model's posterior are asked about some of the conditions only: what they differ by from the best
// rates varies little from condition to condition. Where conditions lie beyond what was measured it
// does, so some of those are asked about, too, and count for their share.
#include "planners/risk/survival.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace floorproof {
namespace {

constexpr std::size_t kConditionsForMembers = 16, kBeyondForMembers = 8;
constexpr double kStudent = 2.131;  // 97.5 % of Student's t, kRateMembers - 1 degrees of freedom

// What is predicted of one condition: no failure, then each mode first.
using Outcome = std::array<double, 1 + kNumFailureModes>;

// By how much less than by itself a meeting adds to those with its hazard so far, whose
// Lambda^theta come to `sum`: Lambda times the share is added.
double ShareOf(double total, double theta, double& sum) {
  if (theta == 1 || total <= 0) return 1;
  const double before = sum > 0 ? std::pow(sum, 1 / theta) : 0;
  sum += std::pow(total, theta);
  return before > 0 ? (std::pow(sum, 1 / theta) - before) / total : 1;
}

void Meet(const ModeNumbers& rates, double way_m, double theta, double& sum, Outcome& outcome) {
  ModeNumbers over = rates;
  for (double& rate : over) rate *= way_m;
  const double share = ShareOf(Total(over), theta, sum);
  for (double& rate : over) rate *= share;
  const ModeNumbers first = FirstFailures(over);
  for (int m = 0; m < kNumFailureModes; ++m) outcome[1 + m] += outcome[0] * first[m];
  outcome[0] *= std::exp(-Total(over));
}

// What its rates are multiplied by.
double MeetingAmount(const PlannedMeeting& meeting) {
  return meeting.way_m * meeting.rates->TimesMeasured(meeting.at);
}

double ZOf(double p) { return std::asin(std::sqrt(std::clamp(p, 0.0, 1.0))); }
double POf(double z) {
  const double s = std::sin(std::clamp(z, 0.0, std::asin(1.0)));
  return s * s;
}

double MeanOver(const std::vector<Outcome>& outcomes, const std::vector<double>& shares,
                std::size_t which) {
  double mean = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) mean += shares[i] * outcomes[i][which];
  return mean;
}

// Conditions that the members are asked about, each for a share of all.
struct Chosen {
  std::vector<std::size_t> conditions;
  std::vector<double> shares;

  // So many of these, evenly, which are so many of all.
  void Add(const std::vector<std::size_t>& of, std::size_t most, std::size_t all) {
    const std::size_t step = (of.size() + most - 1) / most;
    const std::size_t before = conditions.size();
    for (std::size_t i = 0; i < of.size(); i += step) conditions.push_back(of[i]);
    const auto added = static_cast<double>(conditions.size() - before);
    shares.resize(conditions.size(),
                  static_cast<double>(of.size()) / (added * static_cast<double>(all)));
  }
};

// The mean over conditions, and the variance of Z of it that comes of their number.
struct Sampled {
  double mean = 0, variance = 0;
};
Sampled Over(const std::vector<Outcome>& outcomes, std::size_t which) {
  const double n = static_cast<double>(outcomes.size());
  double sum = 0, squares = 0;
  for (const Outcome& outcome : outcomes) {
    sum += outcome[which];
    squares += outcome[which] * outcome[which];
  }
  const double mean = sum / n, spread = std::max(0.0, squares / n - mean * mean);
  const double slope = 4 * mean * (1 - mean);  // of p by z, squared
  return {mean, n > 1 && slope > 0 ? spread / (n - 1) / slope : 0};
}

// Of a meeting: most conditions leave its hazard as it is.
class LastCovariates {
 public:
  Covariates& Of(const PlannedMeeting& meeting, bool mirrored) {
    if (!covariates_ || rates_ != meeting.rates || size_ != meeting.size) {
      rates_ = meeting.rates;
      size_ = meeting.size;
      covariates_.emplace(rates_->kind().axes, mirrored, size_);
    }
    return *covariates_;
  }

 private:
  const RateEvaluator* rates_ = nullptr;
  std::vector<std::pair<std::string, double>> size_;
  std::optional<Covariates> covariates_;
};

// Which mode and which meeting ends a drive, of those that end, stays as it was: at either end of
// the interval, too.
void CarryOverTo(const CarryOver& carry_over, Survival& survival) {
  Probability& none = survival.no_failure;
  const Probability before{1 - none.value, 1 - none.upper, 1 - none.lower};
  const Probability after{carry_over.Of(before.value), carry_over.Of(before.lower),
                          carry_over.Of(before.upper)};
  none = {1 - after.value, 1 - after.upper, 1 - after.lower};
  const auto scale = [](double from, double to) { return from > 0 ? to / from : 1; };
  const double share = scale(before.value, after.value);
  for (Probability& first : survival.first) {
    first.value *= share;
    first.lower = std::min(first.value, first.lower * scale(before.lower, after.lower));
    first.upper = std::clamp(first.upper * scale(before.upper, after.upper), first.value,
                             std::max(first.value, after.upper));
  }
  for (double& ends : survival.by_meeting) ends *= share;
}

}  // namespace

double Survival::farthest_beyond() const {
  double farthest = 0;
  for (const Beyond& meeting : beyond) farthest = std::max(farthest, meeting.share);
  return farthest;
}

Survival PredictSurvival(std::span<const std::vector<PlannedMeeting>> conditions,
                         std::size_t numbers, const RiskModel& model) {
  std::vector<double> sums(numbers);  // by PlannedMeeting::first
  std::vector<std::array<double, kRateMembers>> member_sums(numbers);
  Survival survival;
  survival.by_meeting.assign(numbers, 0);
  survival.beyond.resize(numbers);
  Outcome certain = {};
  certain[0] = 1;
  std::vector<Outcome> outcomes(conditions.size(), certain), chosen;
  std::vector<LastCovariates> known(numbers);
  std::vector<std::size_t> within, beyond;  // conditions
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    std::ranges::fill(sums, 0);
    bool is_beyond = false;
    for (const PlannedMeeting& meeting : conditions[c]) {
      const RateEvaluator& rates = *meeting.rates;
      const std::span<const double> x =
          known[meeting.number].Of(meeting, model.mirrored).Of(meeting.at);
      const double before = outcomes[c][0];
      Meet(rates.At(x), MeetingAmount(meeting), rates.kind().theta, sums[meeting.first],
           outcomes[c]);
      survival.by_meeting[meeting.number] +=
          (before - outcomes[c][0]) / static_cast<double>(conditions.size());
      const double share = rates.Beyond(x);
      is_beyond |= share > 0;
      if (share > survival.beyond[meeting.number].share)
        survival.beyond[meeting.number] = {share, c};
    }
    (is_beyond ? beyond : within).push_back(c);
  }

  Chosen asked;
  asked.Add(within, kConditionsForMembers, conditions.size());
  asked.Add(beyond, within.empty() ? kConditionsForMembers : kBeyondForMembers, conditions.size());
  std::array<std::vector<Outcome>, kRateMembers> by_member;
  for (const std::size_t c : asked.conditions) {
    std::ranges::fill(member_sums, std::array<double, kRateMembers>{});
    for (auto& member : by_member) member.push_back(certain);
    for (const PlannedMeeting& meeting : conditions[c]) {
      const RateEvaluator& rates = *meeting.rates;
      const double amount = MeetingAmount(meeting);
      const auto members =
          rates.MembersAt(known[meeting.number].Of(meeting, model.mirrored).Of(meeting.at));
      for (std::size_t r = 0; r < kRateMembers; ++r)
        Meet(members[r], amount, rates.kind().theta, member_sums[meeting.first][r],
             by_member[r].back());
    }
    chosen.push_back(outcomes[c]);
  }

  for (std::size_t which = 0; which < certain.size(); ++which) {
    const Sampled all = Over(outcomes, which);
    double mean = 0, squares = 0;
    for (const std::vector<Outcome>& member : by_member) {
      const double z = ZOf(MeanOver(member, asked.shares, which));
      mean += z / kRateMembers;
      squares += z * z / kRateMembers;
    }
    const double of_members =
        std::max(0.0, squares - mean * mean) * kRateMembers / (kRateMembers - 1);
    const double middle = ZOf(all.mean);
    // The members' mean differs from the best where rates are skewed, as of what never happened.
    const double skew = mean - ZOf(MeanOver(chosen, asked.shares, which));
    const double reach = kStudent * std::sqrt(of_members + all.variance);
    Probability& p = which == 0 ? survival.no_failure : survival.first[which - 1];
    p = {all.mean, POf(middle + std::min(skew, 0.0) - reach),
         POf(middle + std::max(skew, 0.0) + reach)};
  }
  CarryOverTo(model.carry_over, survival);
  return survival;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "stats/rare/rare_estimate.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/params.h"
#include "base/quantity.h"
#include "stats/betting.h"
#include "stats/binomial.h"
#include "stats/checks.h"
#include "stats/rare/defensive_density.h"
#include "stats/rare/failure_mixture.h"
#include "stats/rare/likeliest_failures.h"
#include "stats/student.h"

namespace floorproof {
namespace {

constexpr int kRefitDraws = 1000;        // that only show where failures are
constexpr int kFirstDraws = 2000;        // of the estimate; they say how many more it takes
constexpr double kPilotsShare = 0.6;     // of all trials, at most
constexpr std::size_t kMostRegions = 5;  // that are polished: the largest

constexpr int kPilotDraws = kPilots * SubsetPilot::kDraws;

// When there is no estimate.
constexpr double kMostShare = 0.25;        // of one draw
constexpr double kFewestEffective = 20;    // failures
constexpr double kMostOfOnePilot = 0.3;    // of the probability, in regions that one pilot found
constexpr double kMostDisagreement = 4.0;  // estimate against the pilots' geometric mean

struct Found {
  Trial trial;
  double weight = 0;
};

class Search {
 public:
  Search(const RareProblem& problem, const RareSettings& settings, const RareStage& stage)
      : problem_(problem),
        settings_(settings),
        stage_(stage),
        stream_(settings.seed, 0, "rare.draws") {}

  RareEstimate Run() {
    RunPilots();
    if (failures_.empty()) {
      DrawNominal();
    } else {
      Fit();
      Refit();
      DrawFresh();
      Judge();
      Polish();
    }
    Bounds();
    out_.trials = trials_;
    return std::move(out_);
  }

 private:
  void Say(const std::string& stage) const {
    if (stage_) stage_(stage);
  }
  std::vector<TrialResult> Evaluate(std::span<const Trial> trials) {
    trials_ += trials.size();
    return problem_.evaluate(trials);
  }
  std::uint64_t left() const {
    return settings_.max_trials - std::min(settings_.max_trials, trials_);
  }
  std::uint64_t Noise(std::size_t place) const { return problem_.noisy ? trials_ + place : 0; }

  // Side by side: a batch has a step of each.
  void RunPilots() {
    std::vector<std::unique_ptr<SubsetPilot>> pilots;
    for (int i = 0; i < kPilots; ++i)
      pilots.push_back(std::make_unique<SubsetPilot>(problem_, settings_.seed, i));
    // What comes after them must fit as well.
    const std::uint64_t most = std::min(
        static_cast<std::uint64_t>(kPilotsShare * static_cast<double>(settings_.max_trials)),
        settings_.max_trials - kRefitDraws - kFirstDraws);
    while (true) {
      std::vector<Trial> batch;
      std::vector<std::pair<SubsetPilot*, std::size_t>> of;  // where each one's begin
      for (const auto& pilot : pilots)
        if (pilot->goes_on()) {
          of.emplace_back(pilot.get(), batch.size());
          pilot->Propose(trials_ + batch.size(), batch);
        }
      if (of.empty()) break;
      if (trials_ + batch.size() > std::max<std::uint64_t>(most, kPilotDraws)) {
        for (const auto& [pilot, begin] : of) pilot->CutOff();
        break;
      }
      int level = 0;
      for (const auto& [pilot, begin] : of) level = std::max(level, pilot->levels());
      Say(std::to_string(of.size()) + " of " + std::to_string(kPilots) + " pilots, level " +
          std::to_string(level));
      const std::vector<TrialResult> results = Evaluate(batch);
      for (std::size_t i = 0; i < of.size(); ++i) {
        const std::size_t end = i + 1 < of.size() ? of[i + 1].second : results.size();
        of[i].first->Take(std::span(results).subspan(of[i].second, end - of[i].second));
      }
    }
    for (const auto& pilot : pilots) {
      out_.pilots.push_back({pilot->end(), pilot->levels(),
                             static_cast<int>(pilot->failures().size()), pilot->probability(),
                             pilot->reached()});
      out_.nominal_draws += pilot->nominal_draws();
      out_.nominal_failures += pilot->nominal_failures();
      for (const PilotFailure& failure : pilot->failures()) {
        failures_.push_back({failure.trial, failure.weight});
        pilot_of_.push_back(static_cast<int>(out_.pilots.size()) - 1);
      }
    }
  }

  // There is nowhere to look: draws as they come say at least how often it can be.
  void DrawNominal() {
    Say("no pilot came upon a failure: draws as they come");
    while (left() > 0) {
      constexpr std::uint64_t kBatch = 500;
      std::vector<Trial> batch;
      for (std::uint64_t i = 0; i < std::min(kBatch, left()); ++i)
        batch.push_back({NormalVector(stream_, problem_.dimensions), Noise(i)});
      for (const TrialResult& result : Evaluate(batch)) CountNominal(result);
    }
    // On their way to a failure, or far enough to say that there hardly is one.
    constexpr double kFarEnough = 1e-5;
    const bool cut_off = std::ranges::any_of(out_.pilots, [](const PilotReport& pilot) {
      return pilot.end == SubsetPilot::End::kCutOff && pilot.reached > 1.01 * kFarEnough;
    });
    if (out_.nominal_failures > 0)
      out_.why = "no pilot came upon a failure, and draws as they come did";
    else if (cut_off)
      out_.why = "pilots used up their trials before they came to a failure";
    else
      out_.answer = RareAnswer::kNothingFound;
  }

  void CountNominal(const TrialResult& result) {
    out_.nominal_draws += result.counts;
    out_.nominal_failures += result.failed;
  }

  WeightedPoints Points(std::span<const Found> found) const {
    WeightedPoints points{
        Eigen::MatrixXd(problem_.dimensions, static_cast<Eigen::Index>(found.size())),
        Eigen::VectorXd(static_cast<Eigen::Index>(found.size()))};
    for (std::size_t i = 0; i < found.size(); ++i) {
      points.u.col(static_cast<Eigen::Index>(i)) = found[i].trial.u;
      points.weights[static_cast<Eigen::Index>(i)] = found[i].weight;
    }
    return points;
  }

  void Fit() { mixture_.emplace(Points(failures_), problem_.noisy, stream_); }

  // Draws from what the pilots found say how much of the probability each region has, which chains
  // know badly, and look on its other side, which chains may have lost.
  void Refit() {
    const DefensiveDensity density(*mixture_, problem_.dimensions, true);
    Say("draws that show where failures are");
    std::vector<Found> found = DrawFrom(density, kRefitDraws, true);
    std::erase_if(found, [](const Found& f) { return f.weight == 0; });
    double sum = 0, squares = 0;
    for (const Found& f : found) sum += f.weight, squares += f.weight * f.weight;
    if (sum == 0) return;
    const double worth = sum / squares;  // of a unit of weight, in independent failures
    for (Found& f : found) f.weight *= worth;
    found.insert(found.end(), failures_.begin(), failures_.end());
    mixture_.emplace(Points(found), problem_.noisy, stream_);
  }

  // Every draw's failure with its weight; 0: it did not fail. `nominal_count`: draws of the nominal
  // tenth are counted. Where how many there are hangs on failures before, they are not: a bound for
  // a number set beforehand would not hold.
  std::vector<Found> DrawFrom(const DefensiveDensity& density, std::uint64_t n,
                              bool nominal_count) {
    constexpr std::uint64_t kBatch = 5000;
    std::vector<Found> found;
    for (std::uint64_t done = 0; done < n; done += kBatch) {
      std::vector<Trial> batch;
      std::vector<bool> nominal;
      for (std::uint64_t i = 0; i < std::min(kBatch, n - done); ++i) {
        DefensiveDensity::Draw draw = density.DrawFrom(stream_);
        batch.push_back({std::move(draw.u), Noise(i)});
        nominal.push_back(draw.nominal);
      }
      const std::vector<TrialResult> results = Evaluate(batch);
      for (std::size_t i = 0; i < batch.size(); ++i) {
        if (nominal_count && nominal[i]) CountNominal(results[i]);
        if (results[i].failed) {
          const double weight = density.Weight(batch[i].u);
          found.push_back({std::move(batch[i]), weight});
        } else {
          found.push_back({});
        }
      }
    }
    return found;
  }

  void DrawFresh() {
    const DefensiveDensity density(*mixture_, problem_.dimensions);
    Say("draws that the estimate is made of");
    fresh_ = DrawFrom(density, kFirstDraws, true);
    SumUp();
    const double more = out_.probability > 0
                            ? kFirstDraws * (std::pow(out_.cov / settings_.target_cov, 2) * 1.1 - 1)
                            : std::numeric_limits<double>::infinity();
    const std::uint64_t polish =
        std::min<std::uint64_t>(kMostRegions, static_cast<std::uint64_t>(mixture_->regions())) *
        kPolishRounds * kPolishTrials;
    const auto n = static_cast<std::uint64_t>(
        std::clamp(more, 0.0, static_cast<double>(left() - std::min(left(), polish))));
    if (n == 0) return;
    std::vector<Found> further = DrawFrom(density, n, false);
    fresh_.insert(fresh_.end(), std::make_move_iterator(further.begin()),
                  std::make_move_iterator(further.end()));
    SumUp();
  }

  void SumUp() {
    double sum = 0, squares = 0, fourths = 0, most = 0;
    out_.fresh_failures = 0;
    for (const Found& f : fresh_) {
      sum += f.weight;
      squares += f.weight * f.weight;
      fourths += std::pow(f.weight, 4);
      most = std::max(most, f.weight);
      out_.fresh_failures += f.weight > 0;
    }
    const auto n = static_cast<double>(fresh_.size());
    out_.fresh_draws = static_cast<int>(fresh_.size());
    if (sum == 0) return;
    out_.probability = std::min(1.0, sum / n);
    out_.cov = std::sqrt(std::max(0.0, squares / (sum * sum) - 1 / n) * n / (n - 1));
    out_.largest_share = most / sum;
    out_.effective_failures = sum * sum / squares;
    out_.freedom = std::max(1.0, 2 * squares * squares / fourths);
  }

  void Judge() {
    const double p = out_.probability;
    FindRegions();
    out_.answer = RareAnswer::kNoEstimate;
    if (p == 0) {
      out_.why = "no fresh draw failed where the pilots' did";
      return;
    }
    double of_one = 0;
    for (const FailureRegion& region : out_.regions)
      if (region.pilots <= 1) of_one += region.share;
    double logs = 0;
    int found = 0;
    for (const PilotReport& pilot : out_.pilots)
      if (pilot.probability > 0) logs += std::log(pilot.probability), ++found;
    const double disagree = found == 0 ? 0 : std::abs(std::log(p) - logs / found);
    if (out_.largest_share > kMostShare)
      out_.why = "one draw makes " + PercentText(out_.largest_share, 2) + " of it";
    else if (out_.effective_failures < kFewestEffective)
      out_.why = "its failures are worth " + FormatDouble(std::round(out_.effective_failures)) +
                 " of equal weight, fewer than " + FormatDouble(kFewestEffective);
    else if (of_one > kMostOfOnePilot)
      out_.why = "the pilots disagree on where failures are: " + PercentText(of_one, 2) +
                 " of it lies where no two of them were";
    else if (found == 0)
      out_.why = "no pilot came far enough to say how likely failures are";
    else if (disagree > std::log(kMostDisagreement))
      out_.why = "fresh draws and pilots differ by a factor of " +
                 FormatDouble(std::round(std::exp(disagree)));
    else
      out_.answer = RareAnswer::kEstimate;
    if (out_.answer != RareAnswer::kEstimate) return;
    out_.reached_target = out_.cov <= settings_.target_cov;
    out_.interval = IntervalOf(out_, settings_.confidence);
  }

  void FindRegions() {
    const auto n = static_cast<std::size_t>(mixture_->regions());
    std::vector<FailureRegion> regions(n);
    std::vector<std::vector<bool>> seen(n, std::vector<bool>(kPilots));
    double sum = 0;
    const auto take = [&](const Trial& trial) {
      FailureRegion& region = regions[static_cast<std::size_t>(mixture_->RegionOf(trial.u))];
      const double distance = trial.u.norm();
      if (region.likeliest.u.size() > 0 && distance >= region.distance) return;
      region.likeliest = trial;
      region.distance = distance;
    };
    for (std::size_t i = 0; i < failures_.size(); ++i) {
      const Trial& trial = failures_[i].trial;
      seen[static_cast<std::size_t>(mixture_->RegionOf(trial.u))]
          [static_cast<std::size_t>(pilot_of_[i])] = true;
      take(trial);
    }
    for (const Found& f : fresh_) {
      if (f.weight == 0) continue;
      FailureRegion& region = regions[static_cast<std::size_t>(mixture_->RegionOf(f.trial.u))];
      region.share += f.weight;
      ++region.draws;
      sum += f.weight;
      take(f.trial);
    }
    for (std::size_t r = 0; r < n; ++r) {
      if (sum > 0) regions[r].share /= sum;
      regions[r].pilots = static_cast<int>(std::ranges::count(seen[r], true));
    }
    // A part that no failure is nearest to is no region.
    std::erase_if(regions, [](const FailureRegion& r) { return r.likeliest.u.size() == 0; });
    std::ranges::stable_sort(regions, std::ranges::greater{}, &FailureRegion::share);
    out_.regions = std::move(regions);
  }

  void Polish() {
    constexpr std::uint64_t kOfOne = kPolishRounds * kPolishTrials;
    const std::size_t n =
        std::min({out_.regions.size(), kMostRegions, static_cast<std::size_t>(left() / kOfOne)});
    if (n == 0) return;
    Say("the likeliest failures");
    std::vector<Trial> begin;
    for (std::size_t r = 0; r < n; ++r) begin.push_back(out_.regions[r].likeliest);
    RareProblem counted = problem_;
    counted.evaluate = [this](std::span<const Trial> trials) { return Evaluate(trials); };
    std::vector<Trial> nearest = Likeliest(counted, std::move(begin), stream_);
    for (std::size_t r = 0; r < n; ++r) {
      out_.regions[r].distance = nearest[r].u.norm();
      out_.regions[r].searched = true;
      out_.regions[r].likeliest = std::move(nearest[r]);
    }
  }

  void Bounds() {
    const int n = out_.nominal_draws, k = out_.nominal_failures;
    out_.confidence = settings_.confidence;
    std::vector<double> weights;
    for (const Found& f : fresh_) weights.push_back(f.weight);
    out_.lower_bound = weights.empty() ? ClopperPearsonLower(k, n, settings_.confidence)
                                       : BettingLowerBound(weights, settings_.confidence);
    out_.upper_bound = ClopperPearsonUpper(k, n, settings_.confidence);
  }

  const RareProblem& problem_;
  const RareSettings& settings_;
  const RareStage& stage_;
  Stream stream_;
  std::uint64_t trials_ = 0;
  std::vector<Found> failures_;  // of the pilots, weighted in independent ones
  std::vector<int> pilot_of_;
  std::optional<FailureMixture> mixture_;
  std::vector<Found> fresh_;
  RareEstimate out_;
};

}  // namespace

// A level of each pilot and what comes after them; n draws of which all fail have the coefficient
// of variation of the weights alone, which no fit makes smaller than this.
std::uint64_t FewestTrials(double target_cov) {
  constexpr double kLeastVariation = 0.5;  // of one draw: the tenths that hardly fail
  const double fresh = std::max<double>(kFirstDraws, std::pow(kLeastVariation / target_cov, 2));
  return 2 * kPilotDraws + kRefitDraws + static_cast<std::uint64_t>(std::ceil(fresh));
}

void CheckRareSettings(const RareSettings& settings) {
  CheckConfidence(settings.confidence);
  if (!(settings.target_cov >= 0.01 && settings.target_cov <= 1))
    throw InputError({}, "target_cov", FormatDouble(settings.target_cov), "must be in [0.01, 1]");
  const std::uint64_t fewest = FewestTrials(settings.target_cov);
  if (settings.max_trials < fewest || settings.max_trials > 10'000'000)
    throw InputError({}, "max_trials", std::to_string(settings.max_trials),
                     "must be in [" + std::to_string(fewest) +
                         ", 10000000]: a coefficient of "
                         "variation of " +
                         FormatDouble(settings.target_cov) + " takes as many");
}

RareEstimate EstimateRare(const RareProblem& problem, const RareSettings& settings,
                          const RareStage& stage) {
  CheckRareSettings(settings);
  if (problem.dimensions < 1 || problem.dimensions > kMostCoordinates)
    throw InputError({}, "dimensions", std::to_string(problem.dimensions),
                     "must be in [1, " + std::to_string(kMostCoordinates) + "]");
  return Search(problem, settings, stage).Run();
}

Interval IntervalOf(const RareEstimate& estimate, double confidence) {
  if (estimate.answer != RareAnswer::kEstimate)
    throw InputError({}, "estimate", estimate.why, "is none");
  const Interval log =
      StudentInterval(std::log(estimate.probability), estimate.cov, estimate.freedom, confidence);
  return {std::min(1.0, std::exp(log.lower)), std::min(1.0, std::exp(log.upper))};
}

double CleanDrawsNeeded(double probability, double confidence) {
  if (probability >= 1) return 1;
  return std::ceil(std::log(1 - confidence) / std::log1p(-probability));
}

}  // namespace floorproof

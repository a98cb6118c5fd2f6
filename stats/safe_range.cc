// SPDX-License-Identifier: Apache-2.0
// Fixed-sequence testing (Maurer, Hothorn and Lehmacher 1995; Wiens, Pharmaceutical Statistics 2
// (2003) 211): hypotheses in an order that does not depend on the outcomes, each tested with all of
// alpha, up to the first that is not rejected. The first true one among them is rejected with
// chance alpha, and all behind it only where it was: so that any false claim has chance alpha.
//  - From each end one sequence, with half of alpha: sets of the lowest (highest) values, larger by
//    a fiftieth of all from one to the next. "The mean failure rate of the set is not below the
//    limit" is rejected where the one-sided Clopper-Pearson bound is below it. The first set has
//    three times the fewest episodes that pass without a failure, or a fifth of all where that is
//    less, and those fewest at least: where one failure ends the sequence at once, robots that are
//    good and not perfect are shown to be good half of the time.
//  - A sequence that comes to its end hands its half on to the set of all values (Bretz, Maurer,
//    Brannath and Posch, Statistics in Medicine 28 (2009) 586): where both do, that has the whole
//    alpha, like a gate; and where there are so few episodes that none but the whole can pass.
//  - Parts: the same from either end, over sets that do not overlap.
// Given the values drawn, outcomes of a set are independent with chances that differ; of these the
// low counts that reject are at most as likely as of a binomial with the mean chance (Hoeffding,
// Annals of Mathematical Statistics 27 (1956) 713: counts up to n p - 1). So the level holds for
// the mean over the values drawn, whatever the curve; nothing need be monotone. It holds for
// confidences from 0.75 on and limits below 1 - 1 / n.
// A sequential gate ends at a number of episodes that depends on outcomes: there each test is the
// mixture e-value's (stats/sequential_gate.h).
#include "stats/safe_range.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stats/binomial.h"
#include "stats/equal_bins.h"
#include "stats/gate.h"
#include "stats/sequential_gate.h"

namespace floorproof {
namespace {

constexpr std::size_t kSteps = 50;
constexpr std::size_t kFirstShare = 5, kFirstTimes = 3;  // of all values, of the fewest that pass
constexpr int kMostParts = 8;

class Search {
 public:
  Search(std::span<const DrawnOutcome> ascending, const SafeRangeSettings& settings)
      : settings_(settings) {
    failed_before_.push_back(0);
    for (const DrawnOutcome& outcome : ascending) {
      values_.push_back(outcome.value);
      failed_before_.push_back(failed_before_.back() + outcome.failed);
    }
    half_needed_ = FewestClean(1 - alpha() / 2);
  }

  SafeRange Find() const {
    SafeRange out;
    out.needed = FewestClean(settings_.confidence);
    const std::size_t n = values_.size();
    if (n == 0) return out;
    out.whole = Of(0, n, values_.back());
    if (out.whole.n < out.needed) return out;
    out.answer = SafeAnswer::kNotShown;

    const std::vector<std::size_t> low = LowEnds(), high = HighBegins();
    std::size_t passed_low = 0, passed_high = 0;
    while (passed_low < low.size() && Passes(Low(low[passed_low]), alpha() / 2)) ++passed_low;
    while (passed_high < high.size() && Passes(High(high[passed_high]), alpha() / 2)) ++passed_high;
    if (!low.empty()) out.first_low = Low(low.front());
    if (!high.empty()) out.first_high = High(high.front());
    if (passed_low > 0) out.up_to = Low(low[passed_low - 1]);
    if (passed_high > 0) out.from = High(high[passed_high - 1]);
    if (out.up_to || out.from) out.answer = SafeAnswer::kPart;

    const int handed_on = (passed_low == low.size()) + (passed_high == high.size());
    if (handed_on > 0 && Passes(out.whole, handed_on * alpha() / 2)) {
      out.answer = SafeAnswer::kWhole;
      out.up_to.reset();
      out.from.reset();
    }
    FindParts(out);
    return out;
  }

 private:
  double alpha() const { return 1 - settings_.confidence; }

  int FewestClean(double confidence) const {
    return FewestEpisodesToPass({settings_.anytime ? GateMode::kSequential : GateMode::kFixed,
                                 settings_.max_rate, confidence});
  }

  bool Passes(const Stretch& set, double alpha) const {
    if (settings_.anytime)
      return JudgeSequentially(set.k, set.n, settings_.max_rate, 1 - alpha) ==
             SequentialOutcome::kPass;
    return ClopperPearsonUpper(set.k, set.n, 1 - alpha) < settings_.max_rate;
  }

  Stretch Of(std::size_t begin, std::size_t end, double edge) const {
    return {edge, static_cast<int>(end - begin), failed_before_[end] - failed_before_[begin]};
  }
  Stretch Low(std::size_t end) const { return Of(0, end, values_[end - 1]); }
  Stretch High(std::size_t begin) const { return Of(begin, values_.size(), values_[begin]); }

  // Of the sets of a sequence, before equal values are put together; none where only the whole can
  // pass.
  std::vector<std::size_t> Sizes() const {
    const std::size_t n = values_.size(), least = static_cast<std::size_t>(half_needed_);
    if (least >= n) return {};
    std::vector<std::size_t> sizes = {std::clamp(n / kFirstShare, least, kFirstTimes * least)};
    for (std::size_t step = 1; step < kSteps; ++step)
      if (const std::size_t size = step * n / kSteps; size > sizes.front()) sizes.push_back(size);
    return sizes;
  }
  std::vector<std::size_t> LowEnds() const {
    std::vector<std::size_t> ends;
    for (const std::size_t size : Sizes())
      if (const std::size_t end = EndOfTies(values_, size);
          end < values_.size() && (ends.empty() || end > ends.back()))
        ends.push_back(end);
    return ends;
  }
  std::vector<std::size_t> HighBegins() const {
    const std::size_t n = values_.size();
    std::vector<std::size_t> begins;
    for (const std::size_t size : Sizes()) {
      const std::size_t begin = BeginOfTies(values_, n - size);
      if (begin > 0 && (begins.empty() || begin < begins.back())) begins.push_back(begin);
    }
    return begins;
  }

  void FindParts(SafeRange& out) const {
    const auto n = static_cast<int>(values_.size());
    const std::vector<std::size_t> ends =
        EqualBins(values_, std::clamp(n / half_needed_, 1, kMostParts));
    out.parts = static_cast<int>(ends.size());
    if (out.parts < 2) return;  // the whole
    const auto part = [&](std::size_t i, bool low) {
      const std::size_t begin = i == 0 ? 0 : ends[i - 1];
      return Of(begin, ends[i], values_[low ? ends[i] - 1 : begin]);
    };
    for (std::size_t i = 0; i < ends.size() && Passes(part(i, true), alpha() / 2); ++i)
      out.each_up_to = part(i, true);
    for (std::size_t i = ends.size(); i > 0 && Passes(part(i - 1, false), alpha() / 2); --i)
      out.each_from = part(i - 1, false);
  }

  SafeRangeSettings settings_;
  std::vector<double> values_;
  std::vector<int> failed_before_;  // among so many of the lowest
  int half_needed_ = 0;             // clean episodes that half of alpha asks for
};

}  // namespace

SafeRange FindSafeRange(std::span<const DrawnOutcome> ascending,
                        const SafeRangeSettings& settings) {
  return Search(ascending, settings).Find();
}

}  // namespace floorproof

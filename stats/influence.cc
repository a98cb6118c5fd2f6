// SPDX-License-Identifier: Apache-2.0
// Cochran, Biometrics 10 (1954) 417, and Armitage, Biometrics 11 (1955) 375: the sum of the failed
// episodes' scores, against its distribution where failures fell to any of the episodes alike, with
// their number as it is. That is a permutation test: it holds whatever the values' distribution.
//  - Scores are the groups' numbers, which shows a trend (with groups of equal counts it is nearly
//    the rank test of Mann and Whitney), or their distances from the middle, which shows failures
//    at both ends or in the middle, where a trend sees nothing.
//  - Where it costs little the distribution is counted out, group by group. Else it is normal,
//    corrected for continuity, unless few episodes have the scores that count: then Cantelli's
//    inequality bounds the tail.
//  - Of choices each is tested by itself (Fisher's exact test) and Bonferroni corrects: exact for
//    any number of choices and episodes, and it names the choice.
// Two-sided p-values are twice the smaller tail. Assumes that episodes are independent.
#include "stats/influence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stats/checks.h"

namespace floorproof {
namespace {

constexpr double kMostSteps = 3e6;  // of counting out: some milliseconds
// Greatest share that one episode may have in the sum's variance where it is called normal: a
// tenth as that of a sum of 30 scores, each as likely.
constexpr double kMostShare = 0.1;

struct ScoreGroup {
  int n = 0, k = 0, score = 0;
};
struct ScoreTest {
  double p = 1, z = 0;  // z > 0: failures have the higher scores
};

double NormalTail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

double TwoSided(double lower_tail, double upper_tail) {
  return std::min(1.0, 2 * std::min(lower_tail, upper_tail));
}

// Twice the smaller of the chances that `drawn` of n episodes, any as likely, have scores that sum
// to `sum` or less, or to `sum` or more. chance[j][t]: that j episodes of the groups so far are
// drawn and sum to t, were each drawn by itself with chance drawn / n; given that `drawn` are, it
// is the distribution asked for.
double CountedOut(const std::vector<ScoreGroup>& groups, int drawn, double n, int sum) {
  int highest = 0;
  for (const ScoreGroup& group : groups) highest = std::max(highest, group.score);
  const auto reach = static_cast<std::size_t>(highest * drawn) + 1;
  const double odds = drawn / (n - drawn), none = std::log1p(-drawn / n);
  std::vector<std::vector<double>> chance(static_cast<std::size_t>(drawn) + 1,
                                          std::vector<double>(reach, 0.0));
  chance[0][0] = 1;
  for (const ScoreGroup& group : groups) {
    for (int j = drawn; j >= 0; --j) {  // downwards: those below are still without this group
      std::vector<double>& into = chance[static_cast<std::size_t>(j)];
      double of_group = std::exp(group.n * none);  // that i of it are drawn
      for (double& c : into) c *= of_group;
      for (int i = 1; i <= std::min(j, group.n); ++i) {
        of_group *= (group.n - i + 1.0) / i * odds;
        const std::vector<double>& from = chance[static_cast<std::size_t>(j - i)];
        const auto shift = static_cast<std::size_t>(i * group.score);
        const auto end = shift + static_cast<std::size_t>((j - i) * highest) + 1;
        for (std::size_t t = shift; t < end; ++t) into[t] += of_group * from[t - shift];
      }
    }
  }
  double below = 0, at = 0, above = 0;
  for (std::size_t t = 0; t < reach; ++t) {
    const int order = static_cast<int>(t) - sum;
    (order < 0 ? below : order > 0 ? above : at) += chance.back()[t];
  }
  const double total = below + at + above;
  return TwoSided((below + at) / total, (above + at) / total);
}

ScoreTest TestScores(const std::vector<ScoreGroup>& groups) {
  double n = 0, k = 0, sum = 0, all = 0;
  for (const ScoreGroup& group : groups) {
    n += group.n;
    k += group.k;
    sum += static_cast<double>(group.score) * group.k;
    all += static_cast<double>(group.score) * group.n;
  }
  if (k == 0 || k == n) return {};
  double squares = 0, greatest = 0;
  for (const ScoreGroup& group : groups) {
    const double square = (group.score - all / n) * (group.score - all / n);
    squares += group.n * square;
    if (group.n > 0) greatest = std::max(greatest, square);
  }
  const double variance = k * (n - k) / (n * (n - 1)) * squares;
  if (!(variance > 0)) return {};
  const double excess = sum - k * all / n;
  const double beyond = std::copysign(std::max(0.0, std::abs(excess) - 0.5), excess);
  ScoreTest out{1, beyond / std::sqrt(variance)};
  // Where fewer passed than failed they are counted out: the test is the same.
  const bool of_passed = n - k < k;
  const double drawn = of_passed ? n - k : k, its_sum = of_passed ? all - sum : sum;
  const auto size = static_cast<double>(groups.size());
  if (drawn * drawn * drawn * size * size / 6 <= kMostSteps)
    out.p = CountedOut(groups, static_cast<int>(drawn), n, static_cast<int>(its_sum));
  else if (greatest <= kMostShare * variance)
    out.p = TwoSided(NormalTail(out.z), NormalTail(-out.z));
  else
    out.p = std::min(1.0, 2 * variance / (variance + excess * excess));
  return out;
}

// Fisher's exact test of one group against all others.
double Fisher(const GroupCounts& group, const GroupCounts& all) {
  const double n = all.n, drawn = all.k, marked = group.n, x = group.k;
  const auto log_choose = [](double of, double k) {
    return std::lgamma(of + 1) - std::lgamma(k + 1) - std::lgamma(of - k + 1);
  };
  const double at =
      std::exp(log_choose(marked, x) + log_choose(n - marked, drawn - x) - log_choose(n, drawn));
  double lower = at, upper = at, chance = at;
  for (double i = x; i > 0 && n - marked - drawn + i > 0; --i)
    lower += chance *= i * (n - marked - drawn + i) / ((marked - i + 1) * (drawn - i + 1));
  chance = at;
  for (double i = x; i < std::min(marked, drawn); ++i)
    upper += chance *= (marked - i) * (drawn - i) / ((i + 1) * (n - marked - drawn + i + 1));
  return TwoSided(lower, upper);
}

// By how many standard deviations more of the group failed than chance lets.
double FisherZ(const GroupCounts& group, const GroupCounts& all) {
  const double n = all.n, k = all.k, share = group.n / n;
  const double variance = k * (n - k) / (n - 1) * share * (1 - share);
  return variance > 0 ? (group.k - k * share) / std::sqrt(variance) : 0;
}

ScoreTest TestOne(std::span<const GroupCounts> groups, const auto& score) {
  std::vector<ScoreGroup> scored;
  for (std::size_t i = 0; i < groups.size(); ++i)
    scored.push_back({groups[i].n, groups[i].k, score(static_cast<int>(i))});
  return TestScores(scored);
}

}  // namespace

OrderedInfluence TestOrdered(std::span<const GroupCounts> groups) {
  for (const GroupCounts& group : groups) CheckCounts(group.k, group.n);
  const int last = static_cast<int>(groups.size()) - 1;
  if (last < 1) return {};
  const ScoreTest trend = TestOne(groups, [](int i) { return i; });
  OrderedInfluence out{trend.p, trend.z,
                       trend.z > 0   ? InfluenceShape::kHigher
                       : trend.z < 0 ? InfluenceShape::kLower
                                     : InfluenceShape::kNone};
  if (last == 1) return out;
  const ScoreTest ends = TestOne(groups, [&](int i) { return std::abs(2 * i - last) / 2; });
  if (ends.p < trend.p || (ends.p == trend.p && std::abs(ends.z) > std::abs(trend.z)))
    out = {ends.p, ends.z, ends.z > 0 ? InfluenceShape::kEnds : InfluenceShape::kMiddle};
  out.p = std::min(1.0, 2 * out.p);
  return out;
}

ChoiceInfluence TestChoices(std::span<const GroupCounts> groups) {
  for (const GroupCounts& group : groups) CheckCounts(group.k, group.n);
  if (groups.size() < 2) return {};
  GroupCounts all;
  for (const GroupCounts& group : groups) all = {all.n + group.n, all.k + group.k};
  ChoiceInfluence out;
  if (all.k == 0 || all.k == all.n) return out;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const double p = Fisher(groups[i], all), z = FisherZ(groups[i], all);
    if (p < out.p || (p == out.p && std::abs(z) > std::abs(out.z))) out = {p, z, i};
  }
  if (groups.size() > 2) {
    out.p = std::min(1.0, static_cast<double>(groups.size()) * out.p);
  } else if (out.z < 0) {  // of two the same test: named is the one that fails more often
    out.choice = 1 - out.choice;
    out.z = -out.z;
  }
  return out;
}

}  // namespace floorproof

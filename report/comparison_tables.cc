// SPDX-License-Identifier: Apache-2.0
#include "report/comparison_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/quantity.h"
#include "base/words.h"

namespace floorproof {
namespace {

std::string Signed(double value, double scale = 1) {
  return std::isfinite(value) ? (scale * value < 0 ? "" : "+") + NumberText(scale * value, 4) : "–";
}

std::string Significance(double p) {
  constexpr double kLeastShown = 1e-4;
  return p < kLeastShown ? "p < " + NumberText(kLeastShown) : "p = " + NumberText(p);
}

std::string Number(int n) { return FixedText(n, 0); }

// "+1.2 (-0.3 to +2.7)"
std::string WithInterval(double estimate, const Interval& interval, double scale = 1) {
  return fmt::format("{} ({} to {})", Signed(estimate, scale), Signed(interval.lower, scale),
                     Signed(interval.upper, scale));
}

ComparisonPart FailuresPart(const Comparison& c) {
  TextTable table({{.heading = "Failures"},
                   {.heading = "a", .right = true},
                   {.heading = "b", .right = true},
                   {.heading = "Only a", .right = true},
                   {.heading = "Only b", .right = true},
                   {.heading = "b - a, 95 % interval, % of pairs", .wraps = true},
                   {.heading = "McNemar"}});
  for (const ComparedFailure& f : c.failures)
    table.Add({Words(f.mode), Number(f.both + f.only_a), Number(f.both + f.only_b),
               Number(f.only_a), Number(f.only_b), WithInterval(f.difference, f.interval, 100),
               Significance(f.p)});
  return {"modes", "Failures by mode, paired", std::move(table), {}};
}

ComparisonPart MetricsPart(const Comparison& c) {
  TextTable table({{.heading = "Metrics", .wraps = true},
                   {.heading = "Pairs", .right = true},
                   {.heading = "Mean b - a, 95 % interval", .wraps = true},
                   {.heading = "Median", .right = true}});
  bool starred = false;
  std::string same;
  for (const ComparedMetric& m : c.metrics) {
    const Interval& interval = m.mean.interval;
    if (m.mean.estimate == 0 && interval.lower == 0 && interval.upper == 0) {
      same += (same.empty() ? "" : ", ") + m.metric;
      continue;
    }
    starred |= m.successes_only;
    table.Add({m.metric + (m.successes_only ? " *" : ""), Number(m.mean.n),
               WithInterval(m.mean.estimate, m.mean.interval), Signed(m.median.estimate)});
  }
  std::vector<std::string> notes;
  if (!same.empty()) notes.push_back("no difference in any pair: " + same);
  if (starred)
    notes.push_back("* only pairs in which both succeed, because a failure ends an episode early");
  return {"metrics", "Metrics, paired", std::move(table), std::move(notes)};
}

// Of the figures that differ anywhere, and of those that a reader asks for.
ComparisonPart PlansPart(const Comparison& c) {
  const auto spread = [](const Quartiles& q) {
    return fmt::format("{} [{}, {}]", NumberText(q.median, 4), NumberText(q.lower, 4),
                       NumberText(q.upper, 4));
  };
  const auto percent = [](const Quartiles& q) {
    return fmt::format("{:+.1f} % [{:+.1f}, {:+.1f}]", 100 * q.median, 100 * q.lower,
                       100 * q.upper);
  };
  TextTable table({{.heading = "Plans", .wraps = true},
                   {.heading = "Pairs", .right = true},
                   {.heading = "a: median [quartiles]", .wraps = true},
                   {.heading = "b", .wraps = true},
                   {.heading = "Change", .wraps = true},
                   {.heading = "b lower, same, higher", .wraps = true}});
  for (const ComparedPlanFigure& f : c.plans) {
    constexpr std::array<std::string_view, 4> kAlways = {
        "length_m", "cumulative_risk", "hazard_free_coverage", "terrain_crossings"};
    if (f.lower + f.higher == 0 && std::ranges::find(kAlways, f.figure) == kAlways.end()) continue;
    table.Add({f.figure, Number(f.n), spread(f.a), spread(f.b), f.change ? percent(*f.change) : "–",
               fmt::format("{}, {}, {}", f.lower, f.same, f.higher)});
  }
  std::vector<std::string> notes;
  const ComparedPlans& both = c.risk_and_length;
  if (both.n > 0)
    notes.push_back(
        fmt::format("cumulative_risk and length_m together: in b both are lower in {} pairs, one "
                    "is lower and one "
                    "equal in {}, both are equal in {}, at least one is higher in {}",
                    both.both_lower, both.none_higher - both.both_lower - both.same, both.same,
                    both.n - both.none_higher));
  return {"plans", "Plan figures, paired", std::move(table), std::move(notes)};
}

}  // namespace

std::vector<ComparisonPart> ComparisonParts(const Comparison& comparison) {
  std::vector<ComparisonPart> parts;
  if (!comparison.metrics.empty()) {
    parts.push_back(FailuresPart(comparison));
    parts.push_back(MetricsPart(comparison));
  }
  parts.push_back(PlansPart(comparison));
  std::erase_if(parts, [](const auto& part) { return part.table.empty() && part.notes.empty(); });
  return parts;
}

}  // namespace floorproof

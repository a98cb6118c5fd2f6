// SPDX-License-Identifier: Apache-2.0
// The region's score against the region: what its interval says of a floor on which dirt gathers at
// the walls, as seen by samples drawn by chance, of which most were taken there.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "env/audit/audit_sample.h"
#include "env/audit/space_score.h"
#include "stats/student.h"
#include "tests/audit/audit_floors.h"

namespace floorproof {
namespace {

constexpr double kSide_m = 3, kNear_m = 0.3;
constexpr double kNearShare = 1 - (1 - 2 * kNear_m / kSide_m) * (1 - 2 * kNear_m / kSide_m);

class SpaceAudit : public ::testing::Test {
 protected:
  SpaceAudit() {
    HazardMap map = testing::BareRoom(kSide_m, kSide_m);
    const int n = map.frame.width - 1;
    testing::AddWall(map, 0, 0, n, 0);
    testing::AddWall(map, 0, n, n, n);
    testing::AddWall(map, 0, 0, 0, n);
    testing::AddWall(map, n, 0, n, n);
    floor_ =
        LayDirt(map, {.density_per_m2 = 10e3, .wall_density_per_m2 = 150e3, .reach_m = 0.15}, 1);
    params_.microscope.pixels_per_mm = 6;  // quicker
  }
  static bool IsNear(const Vec2& p) {
    return std::min(p.minCoeff(), (Vec2(kSide_m, kSide_m) - p).minCoeff()) < kNear_m;
  }
  Vec2 Anywhere() { return {random_.Uniform(0, kSide_m), random_.Uniform(0, kSide_m)}; }
  Vec2 Where(bool near) {
    Vec2 p = Anywhere();
    while (IsNear(p) != near) p = Anywhere();
    return p;
  }
  double ScoreAt(const Vec2& p) {
    return TakeSample(field_, {p.x(), p.y(), 0}, params_, random_, random_.Next()).score.score;
  }
  std::vector<double> Scores(int n, bool near) {
    std::vector<double> scores;
    for (int i = 0; i < n; ++i) scores.push_back(ScoreAt(Where(near)));
    return scores;
  }
  double TrueScore() {
    constexpr int kTapes = 1000;
    field_ = floor_;
    double mean = 0;
    for (int i = 0; i < kTapes; ++i) mean += ScoreAt(Anywhere()) / kTapes;
    return mean;
  }
  static Interval IntervalOf(const std::vector<Stratum>& strata) {
    const SpaceScore score = ScoreOfSpace(strata);
    return StudentInterval(*score.mean, *score.standard_error, score.degrees_of_freedom, 0.95);
  }

  DirtField floor_{testing::BareRoom(1, 1)}, field_ = floor_;
  SamplingParams params_;
  Stream random_{1, 0, "space_audit"};
};

TEST_F(SpaceAudit, TheIntervalHoldsTheTrueScoreAndThePlainMeansDoesNot) {
  const double truth = TrueScore();
  constexpr int kAudits = 100;
  int holds = 0, plain_holds = 0;
  double width = 0;
  for (int i = 0; i < kAudits; ++i) {
    field_ = floor_;
    const std::vector<double> near = Scores(20, true), elsewhere = Scores(6, false);
    const Interval interval = IntervalOf({{kNearShare, near}, {1 - kNearShare, elsewhere}});
    holds += interval.Contains(truth);
    width += (interval.upper - interval.lower) / kAudits;
    std::vector<double> all = near;
    all.insert(all.end(), elsewhere.begin(), elsewhere.end());
    plain_holds += IntervalOf({{1, all}}).Contains(truth);
  }
  EXPECT_GE(1.0 * holds / kAudits, 0.88);  // 0.95, less three standard deviations
  EXPECT_LT(width, 0.06);                  // an interval that says nothing would hold it always
  EXPECT_LT(1.0 * plain_holds / kAudits, 0.60);
}

}  // namespace
}  // namespace floorproof

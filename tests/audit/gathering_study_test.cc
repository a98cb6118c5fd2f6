// SPDX-License-Identifier: Apache-2.0
// The audit paper's trials 1a and 1b ("audit-sampling", section 6.1, tables 1 and 2) in a hundred
// rooms each: of tapes near walls and corners, and of as many on an even lattice, how many are
// dirty after five rounds of a cleaning robot. Slow.
//
// Rooms 1 to 20 are those on which `pick_up`, the cleaner and the choice of places were
// settled (docs/audit.md). These tests ask others. Not reproduced: the paper finds less near walls
// in 1b (0.74) than in 1a (0.92).
#include "tests/audit/gathering_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

namespace floorproof {
namespace {

using testing::kBundledCleaner;
using testing::kStudyCleaner;
using testing::SampleAt;
using testing::StudyFloor;
using testing::StudyPlaces;
using testing::StudySamples;
using testing::Trial;

constexpr std::uint64_t kFirst = 21;

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double Quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(
      std::lround(share * static_cast<double>(values.size() - 1)))];
}

struct Figures {
  std::vector<double> geometric, uniform, places;  // of each room
  int better = 0;
};

// The sweep of the plan.
Figures Study(Trial trial, int rooms, const char* cleaner, const SampleParams& samples) {
  Figures figures;
  for (std::uint64_t seed = kFirst; seed < kFirst + static_cast<std::uint64_t>(rooms); ++seed) {
    const StudyFloor floor(trial, seed, cleaner);
    EXPECT_EQ(floor.plan().status, PlanStatus::kSuccess) << floor.plan().message;
    const DirtField left = floor.Cleaned(floor.Sweep());
    const StudyPlaces places = floor.Places(samples);
    EXPECT_EQ(places.geometric.size(), places.uniform.size()) << "room " << seed;
    figures.places.push_back(static_cast<double>(places.geometric.size()));
    figures.geometric.push_back(
        Gather(SampleAt(left, places.geometric, seed)).Efficiency().value_or(-1));
    figures.uniform.push_back(
        Gather(SampleAt(left, places.uniform, seed)).Efficiency().value_or(-1));
    figures.better += figures.geometric.back() > figures.uniform.back();
  }
  return figures;
}

void Print(const char* what, const Figures& f) {
  const auto spread = [](const std::vector<double>& values) {
    std::cout << Mean(values) << " (" << Quantile(values, 0.25) << " to " << Quantile(values, 0.75)
              << ")";
  };
  std::cout << what << ": uniform ";
  spread(f.uniform);
  std::cout << ", geometric ";
  spread(f.geometric);
  std::cout << ", better in " << f.better << " of " << f.uniform.size() << ", " << Mean(f.places)
            << " places\n";
}

TEST(GatheringStudy, InRoomsOfTrial1aTapesNearWallsFindMuchMoreDirt) {
  const Figures figures = Study(Trial::k1a, 100, kStudyCleaner, StudySamples());
  Print("1a", figures);
  EXPECT_NEAR(Mean(figures.uniform), 0.481, 0.04);
  EXPECT_NEAR(Mean(figures.geometric), 0.894, 0.03);
  EXPECT_GE(figures.better, 97);
}

TEST(GatheringStudy, InRoomsOfTrial1bTheyDoToo) {
  const Figures figures = Study(Trial::k1b, 100, kStudyCleaner, StudySamples());
  Print("1b", figures);
  EXPECT_NEAR(Mean(figures.uniform), 0.453, 0.04);
  EXPECT_NEAR(Mean(figures.geometric), 0.928, 0.03);
  EXPECT_GE(figures.better, 97);
}

// The wider the band along walls from which places are taken, the more of them lie on swept floor.
TEST(GatheringStudy, FartherFromWallsTheyFindLess) {
  constexpr auto kBoundary_m = std::to_array<double>({0.15, 0.2, 0.3, 0.5});
  std::array<std::vector<double>, kBoundary_m.size()> found;
  for (std::uint64_t seed = kFirst; seed < kFirst + 10; ++seed) {
    const StudyFloor floor(Trial::k1a, seed);
    const DirtField left = floor.Cleaned(floor.Sweep());
    for (std::size_t i = 0; i < kBoundary_m.size(); ++i) {
      const std::vector<Vec2> places = floor.Geometric(StudySamples(kBoundary_m[i]));
      found[i].push_back(*Gather(SampleAt(left, places, seed)).Efficiency());
    }
  }
  for (std::size_t i = 0; i < kBoundary_m.size(); ++i) {
    std::cout << "1a, R_b " << kBoundary_m[i] << " m: " << Mean(found[i]) << "\n";
    EXPECT_LT(Mean(found[i]), i > 0 ? Mean(found[i - 1]) : 1);
  }
}

// It sweeps all floor that the nose gets to, and what it pushes off its lane beside a wall lies out
// of reach: there is less dirt at the walls than elsewhere.
TEST(GatheringStudy, BehindACleanerThatReachesTheWallsTheyFindLessThanALattice) {
  for (const Trial trial : {Trial::k1a, Trial::k1b}) {
    const Figures figures = Study(trial, 10, kBundledCleaner, StudySamples());
    Print(trial == Trial::k1a ? "1a, bundled tool" : "1b, bundled tool", figures);
    EXPECT_LT(Mean(figures.geometric), 0.7 * Mean(figures.uniform));
  }
}

// Particles in squares of 5 by 5 bins, 0.25 m.
std::vector<double> Blocks(const DirtField& field) {
  constexpr int kBins = 5;
  const GridFrame& frame = field.frame();
  const int across = (frame.width + kBins - 1) / kBins, up = (frame.height + kBins - 1) / kBins;
  std::vector<double> blocks(static_cast<std::size_t>(across * up));
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix)
      blocks[static_cast<std::size_t>(iy / kBins * across + ix / kBins)] +=
          static_cast<double>(field.CountIn(ix, iy));
  return blocks;
}

// Of all particles, the share that lies in another square.
double Apart(const DirtField& a, const DirtField& b) {
  const std::vector<double> p = Blocks(a), q = Blocks(b);
  double apart = 0;
  for (std::size_t i = 0; i < p.size(); ++i) apart += std::abs(p[i] - q[i]);
  return apart / 2 / static_cast<double>(a.size());
}

TEST(GatheringStudy, TheRobotInPhysicsLeavesWhatTheSweepLeaves) {
  std::vector<double> geometric, uniform;  // driven less swept
  for (const Trial trial : {Trial::k1a, Trial::k1b})
    for (std::uint64_t seed = kFirst; seed < kFirst + 5; ++seed) {
      StudyFloor floor(trial, seed);
      EpisodeRecord record;
      const std::vector<Pose2> driven = floor.Drive(record);
      EXPECT_EQ(record.outcome, Outcome::kSuccess) << record.message;
      const DirtField by_sweep = floor.Cleaned(floor.Sweep()), by_drive = floor.Cleaned(driven);
      const DirtField again = floor.Cleaned(floor.Sweep(), {}, "study_cleaning_again");
      const StudyPlaces places = floor.Places();
      std::vector<double> count, other;  // of each tape, by how much it differs
      const auto gather = [&](const std::vector<Vec2>& at, std::vector<double>& differences) {
        const std::vector<int> sweep = SampleAt(by_sweep, at, seed);
        const std::vector<int> drive = SampleAt(by_drive, at, seed);
        const std::vector<int> luck = SampleAt(again, at, seed);
        for (std::size_t i = 0; i < at.size(); ++i) {
          count.push_back(std::abs(drive[i] - sweep[i]));
          other.push_back(std::abs(luck[i] - sweep[i]));
        }
        differences.push_back(*Gather(drive).Efficiency() - *Gather(sweep).Efficiency());
      };
      gather(places.geometric, geometric);
      gather(places.uniform, uniform);
      const double left =
          static_cast<double>(by_drive.size()) / static_cast<double>(by_sweep.size());
      std::cout << (trial == Trial::k1a ? "1a " : "1b ") << seed << ": driven less swept "
                << geometric.back() << " geometric, " << uniform.back()
                << " uniform; a tape's count " << Mean(count) << " apart (by luck alone "
                << Mean(other) << "); left " << left << " of the sweep's, "
                << Apart(by_sweep, by_drive) << " elsewhere (by luck " << Apart(by_sweep, again)
                << ")\n";
      EXPECT_NEAR(left, 1, 0.03);
      EXPECT_LT(Apart(by_sweep, by_drive), 0.05);
      EXPECT_NEAR(geometric.back(), 0, 0.12);
      EXPECT_NEAR(uniform.back(), 0, 0.15);
    }
  EXPECT_NEAR(Mean(geometric), 0, 0.04);
  EXPECT_NEAR(Mean(uniform), 0, 0.06);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "env/audit/dirt_count.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/audit/audit_floors.h"

namespace floorproof {
namespace {

using testing::Sprinkled;

constexpr int kPixels = 20;  // to the millimetre, the microscope's default

int CountOn(int particles, std::uint64_t seed, const MicroscopeParams& microscope = {},
            const CountParams& params = {}) {
  const TapeImages images = PhotographTape(Sprinkled(particles, seed), {}, microscope, seed);
  const DirtCount dirt = CountDirt(images.after, kPixels, params);
  EXPECT_EQ(dirt.status, ImageStatus::kSuccess) << dirt.message;
  return dirt.count;
}

// Of what is counted over the true number.
struct Error {
  double bias = 0, spread = 0;
};
Error ErrorAt(int particles, int tapes) {
  double sum = 0, squares = 0;
  for (int i = 0; i < tapes; ++i) {
    const double error =
        CountOn(particles, static_cast<std::uint64_t>(1000 * particles + i)) - particles;
    sum += error, squares += error * error;
  }
  return {sum / tapes, std::sqrt(squares / tapes - sum / tapes * sum / tapes)};
}

TEST(DirtCount, CleanTapesHoldNone) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const TapeImages images = PhotographTape({}, {}, {}, seed);
    EXPECT_EQ(CountDirt(images.before, kPixels).count, 0);
    EXPECT_EQ(CountDirt(images.after, kPixels).count, 0);
  }
}

TEST(DirtCount, UnevenLightAndNoiseChangeNothing) {
  MicroscopeParams harsh;
  harsh.light_fall = 0.5;
  harsh.vignette = 0.2;
  harsh.lamp = 0.1;
  harsh.noise_grey = 4;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(CountOn(0, seed, harsh), 0);
    EXPECT_NEAR(CountOn(10, seed, harsh), CountOn(10, seed), 1);
  }
}

// What the window is for. As wide as the tape it is one grey for all, and the dark side counts.
TEST(DirtCount, OneThresholdForTheWholeTapeFailsUnderUnevenLight) {
  MicroscopeParams harsh;
  harsh.light_fall = 0.8;
  harsh.vignette = 0.2;
  const CountParams one_for_all = {.darker = 0.25, .window_m = 0.1};
  int wrong = 0, wrong_by_window = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    wrong += CountOn(0, seed, harsh, one_for_all) != 0;
    wrong_by_window += CountOn(0, seed, harsh) != 0;
  }
  EXPECT_GE(wrong, 8);
  EXPECT_EQ(wrong_by_window, 0);
}

TEST(DirtCount, ParticlesThatLieApartAreAllCountedAtTheirPlaces) {
  Stream random(1, 0, "apart");
  std::vector<LiftedParticle> particles;
  for (int i = 0; i < 49; ++i) {
    const Vec2 p_T(0.0026 * (i % 7 - 3) + random.Uniform(-5e-4, 5e-4),
                   0.0026 * (i / 7 - 3) + random.Uniform(-5e-4, 5e-4));
    particles.push_back({p_T, random.Uniform(0.0005, 0.001)});
  }
  const DirtCount dut = CountDirt(PhotographTape(particles, {}, {}, 1).after, kPixels);
  ASSERT_EQ(dut.count, 49);
  for (const Vec2& p_mm : dut.centroids_mm) {
    double least = 1e9;
    for (const LiftedParticle& p : particles) least = std::min(least, (1000 * p.p_T - p_mm).norm());
    EXPECT_LT(least, 0.1);
  }
  EXPECT_TRUE(std::ranges::is_sorted(dut.centroids_mm, {}, [](const Vec2& p) { return p.y(); }));
}

TEST(DirtCount, TwoThatTouchAreOneAndACrumbIsNone) {
  const std::vector<LiftedParticle> two = {{{0, 0}, 0.001}, {{0.0008, 0}, 0.001}};
  EXPECT_EQ(CountDirt(PhotographTape(two, {}, {}, 1).after, kPixels).count, 1);
  const std::vector<LiftedParticle> crumb = {{{0, 0}, 0.00015}};
  EXPECT_EQ(CountDirt(PhotographTape(crumb, {}, {}, 1).after, kPixels).count, 0);
}

// Measured over 1,000 tapes of each number: at 10 particles a bias of -0.23 and a spread of 0.45;
// at 30, -2.3 and 1.4; at 60, -9.3 and 2.6. Here over fewer.
TEST(DirtCount, LosesFewWhereItMattersAndMoreWhereTheyTouch) {
  EXPECT_EQ(ErrorAt(1, 50).bias, 0);
  const Error at_10 = ErrorAt(10, 200);
  EXPECT_LT(at_10.bias, -0.1);
  EXPECT_GT(at_10.bias, -0.35);
  EXPECT_LT(at_10.spread, 0.6);
  double last = at_10.bias;
  for (const int n : {20, 30, 40, 50, 60}) {
    constexpr int kTapes = 50;
    const Error error = ErrorAt(n, kTapes);
    EXPECT_LT(error.bias, last) << n;
    last = error.bias;
    // The pairs that touch: see dirt_count.cc.
    const double law = -n * (n - 1) / 2 * 0.0058;
    EXPECT_NEAR(error.bias, law, 4 * error.spread / std::sqrt(kTapes) - 0.1 * law) << n;
    EXPECT_LT(error.spread, 0.07 * n) << n;
  }
}

// The threshold: 10 on the tape are not dirty, 15 are.
TEST(DirtCount, ClassesTapesOnEitherSideOfTheThreshold) {
  int called_dirty_10 = 0, called_dirty_15 = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    called_dirty_10 += CountOn(10, 500 + seed) > 10;
    called_dirty_15 += CountOn(15, 700 + seed) > 10;
  }
  EXPECT_EQ(called_dirty_10, 0);
  EXPECT_GE(called_dirty_15, 59);
}

TEST(DirtCount, SaysWhyAnImageCannotBeCounted) {
  EXPECT_EQ(CountDirt(TapeImage(), kPixels).status, ImageStatus::kEmpty);
  const DirtCount dut = CountDirt(TapeImage(400, 400, 200), kPixels);
  EXPECT_EQ(dut.status, ImageStatus::kOneColour);
  EXPECT_EQ(dut.message, "all pixels of the image are 200");
  TapeImage dark(400, 400, 2);
  dark(3, 3) = 1;
  EXPECT_EQ(CountDirt(dark, kPixels).status, ImageStatus::kTooDark);
  // Small ones can be: a few pixels, one of them dark, too small for a particle.
  TapeImage small(3, 2, 200);
  small(1, 1) = 10;
  EXPECT_EQ(CountDirt(small, kPixels).status, ImageStatus::kSuccess);
  EXPECT_EQ(CountDirt(small, kPixels).count, 0);
  EXPECT_EQ(Name(ImageStatus::kSizesDiffer), "sizes_differ");
}

TEST(SampleScore, FallsAsTheNumberOfParticlesGrows) {
  // Spearman's rank correlation over tapes of 0 to 60.
  std::vector<std::pair<double, int>> scored;
  for (int n = 0; n <= 60; ++n) {
    const auto seed = static_cast<std::uint64_t>(n);
    const TapeImages images = PhotographTape(Sprinkled(n, seed), {}, {}, seed);
    const SampleScore dut = ScoreSample(images.before, images.after);
    ASSERT_EQ(dut.status, ImageStatus::kSuccess);
    scored.emplace_back(dut.score, n);
  }
  std::ranges::sort(scored);
  double squares = 0;
  for (std::size_t rank = 0; rank < scored.size(); ++rank) {
    const double d = static_cast<double>(rank) - scored[rank].second;
    squares += d * d;
  }
  EXPECT_LT(1 - 6 * squares / (61.0 * (61 * 61 - 1)), -0.98);
}

TEST(SampleScore, OfACleanTapeIsBelowOneByNoiseOnly) {
  MicroscopeParams quiet;
  quiet.noise_grey = quiet.lamp = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TapeImages images = PhotographTape({}, {}, {}, seed);
    const double score = ScoreSample(images.before, images.after).score;
    EXPECT_GT(score, 0.96);
    EXPECT_LT(score, 0.975);
    // One particle shows.
    EXPECT_LT(
        ScoreSample(images.before, PhotographTape(Sprinkled(1, seed), {}, {}, seed).after).score,
        score - 0.0003);
  }
  const TapeImages same = PhotographTape({}, {}, quiet, 1);
  EXPECT_DOUBLE_EQ(ScoreSample(same.before, same.after).score, 1);
}

TEST(SampleScore, SaysWhyTwoImagesCannotBeCompared) {
  const TapeImages images = PhotographTape({}, {}, {}, 1);
  const TapeImage small = PhotographTape({}, {.side_m = 0.01}, {}, 1).after;
  EXPECT_EQ(ScoreSample(TapeImage(), images.after).status, ImageStatus::kEmpty);
  EXPECT_EQ(ScoreSample(images.before, TapeImage(5, 400, 7)).status, ImageStatus::kEmpty);
  EXPECT_EQ(ScoreSample(TapeImage(400, 400, 0), images.after).status, ImageStatus::kOneColour);
  const SampleScore dut = ScoreSample(images.before, small);
  EXPECT_EQ(dut.status, ImageStatus::kSizesDiffer);
  EXPECT_EQ(dut.message, "the images have 400 x 400 and 200 x 200 pixels");
}

}  // namespace
}  // namespace floorproof

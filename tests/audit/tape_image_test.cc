// SPDX-License-Identifier: Apache-2.0
#include "env/audit/tape_image.h"

#include <gtest/gtest.h>

#include "env/audit/structural_similarity.h"
#include "tests/audit/audit_floors.h"

namespace floorproof {
namespace {

using testing::Sprinkled;

std::uint64_t Hash(const TapeImage& image) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::uint8_t byte : image.cells) hash = (hash ^ byte) * 0x100000001b3ULL;
  return hash;
}

// Nothing but the particles: no unevenness, no noise.
MicroscopeParams Plain() {
  MicroscopeParams plain;
  plain.mottle_grey = plain.light_fall = plain.vignette = plain.lamp = plain.noise_grey = 0;
  return plain;
}

double Mean(const TapeImage& image) {
  double sum = 0;
  for (const std::uint8_t grey : image.cells) sum += grey;
  return sum / static_cast<double>(image.cells.size());
}

TEST(TapeImage, TheSameSeedGivesTheSameBytesOnEveryMachine) {
  const auto particles = Sprinkled(20, 1);
  const TapeImages dut = PhotographTape(particles, {}, {}, 5);
  const TapeImages again = PhotographTape(particles, {}, {}, 5);
  EXPECT_EQ(dut.before.cells, again.before.cells);
  EXPECT_EQ(dut.after.cells, again.after.cells);
  EXPECT_NE(PhotographTape(particles, {}, {}, 6).before.cells, dut.before.cells);
  // Of this very drawing: whoever changes it changes results.
  EXPECT_EQ(Hash(dut.before), 2930912837600937025u);
  EXPECT_EQ(Hash(dut.after), 10925080408884271u);
}

TEST(TapeImage, ACleanTapeIsPaleAndItsTwoImagesDifferByLampAndNoise) {
  MicroscopeParams params;
  const TapeImages dut = PhotographTape({}, {}, params, 2);
  EXPECT_EQ(dut.before.width, 400);
  EXPECT_EQ(dut.before.height, 400);
  EXPECT_NEAR(Mean(dut.before), 0.967 * params.tape_grey, 3);
  EXPECT_NE(dut.before.cells, dut.after.cells);
  params.lamp = params.noise_grey = 0;
  const TapeImages quiet = PhotographTape({}, {}, params, 2);
  EXPECT_EQ(quiet.before.cells, quiet.after.cells);
}

TEST(TapeImage, NoiseHasItsStandardDeviation) {
  MicroscopeParams params = Plain();
  params.noise_grey = 5;
  const TapeImage dut = PhotographTape({}, {}, params, 3).before;
  double squares = 0;
  for (const std::uint8_t grey : dut.cells) squares += (grey - 205.0) * (grey - 205.0);
  EXPECT_NEAR(Mean(dut), 205, 0.06);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(dut.cells.size())), 5, 0.1);
}

TEST(TapeImage, AParticleLiesAtItsPlaceWithItsArea) {
  for (const double ragged : {0.0, 0.6, 1.0})
    for (int seed = 0; seed < 20; ++seed) {
      MicroscopeParams params = Plain();
      params.ragged = ragged;
      const Vec2 p_T(0.004, -0.002);
      const std::vector<LiftedParticle> one = {{p_T, 0.001}};
      const TapeImage dut = PhotographTape(one, {}, params, static_cast<std::uint64_t>(seed)).after;
      // Its darkness, spread by the lens, adds up to its area; its middle is the darkness' own.
      double sum = 0, darkest = 0;
      Vec2 middle = Vec2::Zero();
      for (int iy = 0; iy < dut.height; ++iy)
        for (int ix = 0; ix < dut.width; ++ix) {
          const double dark = 205.0 - dut(ix, iy);
          sum += dark, darkest = std::max(darkest, dark);
          middle += dark * Vec2(ix + 0.5, iy + 0.5);
        }
      EXPECT_GT(darkest, 205 - 86);
      EXPECT_LT(darkest, 205 - 34);
      EXPECT_NEAR(sum / darkest, kPi * 10 * 10, 0.03 * kPi * 100) << ragged;
      const Vec2 expected = (p_T + Vec2(0.01, 0.01)) * 20'000;
      // Ragged ones are not symmetric.
      EXPECT_LT((middle / sum - expected).norm(), 0.1 + 1.5 * ragged);
    }
}

TEST(TapeImage, WhatReachesBeyondTheBorderIsCutOff) {
  for (const Vec2& corner : {Vec2(-0.01, -0.01), Vec2(0.01, 0.01)}) {
    const std::vector<LiftedParticle> one = {{corner, 0.001}};
    const TapeImage dut = PhotographTape(one, {}, Plain(), 4).after;
    const int at = corner.x() < 0 ? 0 : 399;
    EXPECT_LT(dut(at, at), 100);
    EXPECT_EQ(dut(399 - at, at), 205);
  }
}

TEST(TapeImage, LightFallsAcrossTheTapeByItsShare) {
  MicroscopeParams params = Plain();
  params.light_fall = 0.4;
  const TapeImage dut = PhotographTape({}, {}, params, 5).before;
  const auto [low, high] = std::ranges::minmax(dut.cells);
  // From border to border along an axis by 0.4, from corner to corner by up to the root of 2 more.
  EXPECT_GT(high - low, 0.4 * 205 - 3);
  EXPECT_LT(high - low, 0.4 * 205 * std::sqrt(2.0) + 3);
}

TEST(StructuralSimilarity, IsOneOfAnImageAndItselfAndSymmetric) {
  const TapeImage a = PhotographTape(Sprinkled(30, 6), {}, {}, 6).after;
  const TapeImage b = PhotographTape(Sprinkled(10, 7), {}, {}, 7).after;
  EXPECT_DOUBLE_EQ(StructuralSimilarity(a, a), 1);
  EXPECT_DOUBLE_EQ(StructuralSimilarity(a, b), StructuralSimilarity(b, a));
  EXPECT_LT(StructuralSimilarity(a, b), 0.98);
}

// Two images of one grey each: only the means' part is left, (2 x y + C1) / (x^2 + y^2 + C1).
TEST(StructuralSimilarity, OfTwoGreysIsTheLawsOwn) {
  const double c1 = 2.55 * 2.55;
  EXPECT_NEAR(StructuralSimilarity(TapeImage(16, 12, 100), TapeImage(16, 12, 150)),
              (2 * 100 * 150 + c1) / (100 * 100 + 150 * 150 + c1), 1e-9);
}

// One window, by the definition, in the plainest way.
TEST(StructuralSimilarity, AgreesWithTheDefinition) {
  Stream random(8, 0, "pixels");
  TapeImage a(13, 12), b(13, 12);
  for (auto& grey : a.cells) grey = static_cast<std::uint8_t>(random.Below(256));
  for (std::size_t i = 0; i < a.cells.size(); ++i)
    b.cells[i] = static_cast<std::uint8_t>((a.cells[i] + random.Below(60)) / 2);
  double all = 0;
  for (int y0 = 0; y0 < 2; ++y0)
    for (int x0 = 0; x0 < 3; ++x0) {
      double weights = 0, ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
      for (int pass = 0; pass < 2; ++pass)
        for (int y = 0; y < 11; ++y)
          for (int x = 0; x < 11; ++x) {
            const double w = std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / 4.5);
            const double p = a(x0 + x, y0 + y), q = b(x0 + x, y0 + y);
            if (pass == 0) weights += w, ma += w * p, mb += w * q;
            if (pass == 1) {
              va += w / weights * (p - ma / weights) * (p - ma / weights);
              vb += w / weights * (q - mb / weights) * (q - mb / weights);
              cov += w / weights * (p - ma / weights) * (q - mb / weights);
            }
          }
      ma /= weights, mb /= weights;
      const double c1 = 2.55 * 2.55, c2 = 7.65 * 7.65;
      all += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  EXPECT_NEAR(StructuralSimilarity(a, b), all / 6, 1e-9);
}

}  // namespace
}  // namespace floorproof

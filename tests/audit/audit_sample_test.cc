// SPDX-License-Identifier: Apache-2.0
#include "env/audit/audit_sample.h"

#include <gtest/gtest.h>

#include "tests/audit/audit_floors.h"

namespace floorproof {
namespace {

const Pose2 kPlace{0.5, 0.5, 0.3};

TEST(AuditSample, WhatATapeLiftsIsGone) {
  DirtField field = LayDirt(testing::BareRoom(1, 1), {}, 1);
  const std::int64_t before = field.size();
  Stream random(1, 0, "samples");
  const AuditSample first = TakeSample(field, kPlace, {}, random, 1);
  EXPECT_EQ(field.size(), before - static_cast<std::int64_t>(first.lifted.size()));
  EXPECT_GT(first.counted.count, 10);
  const AuditSample second = TakeSample(field, kPlace, {}, random, 2);
  EXPECT_EQ(second.lifted.size(), 0u);
  EXPECT_EQ(second.counted.count, 0);
  EXPECT_GT(second.score.score, first.score.score + 0.02);
}

TEST(AuditSample, IsTheSameFromTheSameSeed) {
  const auto sample = [](std::uint64_t tape_seed) {
    DirtField field = LayDirt(testing::BareRoom(1, 1), {}, 1);
    Stream random(1, 0, "samples");
    return TakeSample(field, kPlace, {}, random, tape_seed);
  };
  EXPECT_EQ(sample(1).score.score, sample(1).score.score);
  EXPECT_NE(sample(1).score.score, sample(2).score.score);
}

// The more lies there, the less alike the images are, over the whole range that a count resolves.
TEST(AuditSample, TheScoreFallsWithTheDirt) {
  double last = 1;
  for (const double density : {0.0, 10e3, 40e3, 80e3, 160e3}) {
    DirtField field = LayDirt(testing::BareRoom(2, 2), {.density_per_m2 = density}, 3);
    Stream random(1, 0, "samples");
    double mean = 0;
    constexpr int kTapes = 20;
    for (int i = 0; i < kTapes; ++i)
      mean +=
          TakeSample(field, {0.1 + 0.09 * i, 1, 0}, {}, random, random.Next()).score.score / kTapes;
    EXPECT_LT(mean, last - 0.005) << density;
    last = mean;
  }
}

// A camera without noise sees a clean tape in one grey: that is no image, and no count of nought.
TEST(AuditSample, AnImageOfOneColourIsNoSample) {
  DirtField field(testing::BareRoom(1, 1));
  SamplingParams params;
  MicroscopeParams& blind = params.microscope;
  blind.mottle_grey = blind.light_fall = blind.vignette = blind.noise_grey = 0;
  Stream random(1, 0, "samples");
  const AuditSample dut = TakeSample(field, kPlace, params, random, 1);
  EXPECT_EQ(dut.counted.status, ImageStatus::kOneColour);
  EXPECT_EQ(dut.score.status, ImageStatus::kOneColour);
  EXPECT_NE(dut.counted.message, "");
}

}  // namespace
}  // namespace floorproof

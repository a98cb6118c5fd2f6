// SPDX-License-Identifier: Apache-2.0
#include "base/quantity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace floorproof {
namespace {

TEST(Quantity, NumbersArePlainAndGrouped) {
  EXPECT_EQ(NumberText(0), "0");
  EXPECT_EQ(NumberText(-0.0), "0");
  EXPECT_EQ(NumberText(100), "100");
  EXPECT_EQ(NumberText(1162.4), "1,160");
  EXPECT_EQ(NumberText(136'000), "136,000");
  EXPECT_EQ(NumberText(-1'234'567), "-1,230,000");
  EXPECT_EQ(NumberText(5.5), "5.5");
  EXPECT_EQ(NumberText(94.62), "94.6");
  EXPECT_EQ(NumberText(0.08661), "0.0866");
  EXPECT_EQ(NumberText(1.234e-6), "0.00000123");
}

TEST(Quantity, RoundingUpTakesNoDigitMore) {
  EXPECT_EQ(NumberText(999.4), "999");
  EXPECT_EQ(NumberText(999.6), "1,000");
  EXPECT_EQ(NumberText(9.996), "10");
  EXPECT_EQ(NumberText(0.9996), "1");
  EXPECT_EQ(NumberText(99.96, 4), "99.96");
  EXPECT_EQ(NumberText(99.996, 4), "100");
}

// Whatever the size: to three digits the same number, and never a power of ten.
TEST(Quantity, NoNumberIsWrittenInPowersOfTen) {
  for (int power = -9; power <= 15; ++power)
    for (const double digits : {1.0, 1.005, 2.3456, 9.994, 9.999}) {
      const double value = digits * std::pow(10, power);
      for (const double signed_value : {value, -value}) {
        std::string text = NumberText(signed_value);
        EXPECT_EQ(text.find('e'), std::string::npos) << text;
        std::erase(text, ',');
        EXPECT_NEAR(std::stod(text), signed_value, 0.0051 * value) << text;
      }
    }
}

TEST(Quantity, OneIsSingular) {
  EXPECT_EQ(CountText(0, "turn"), "0 turns");
  EXPECT_EQ(CountText(1, "turn"), "1 turn");
  EXPECT_EQ(CountText(std::size_t{2}, "turn"), "2 turns");
  EXPECT_EQ(CountText(1250u, "failing episode"), "1,250 failing episodes");
}

TEST(Quantity, WhatIsNoNumberIsADash) {
  EXPECT_EQ(NumberText(std::nan("")), "–");
  EXPECT_EQ(PercentText(std::numeric_limits<double>::infinity()), "–");
  EXPECT_EQ(FixedText(std::nan(""), 2), "–");
}

TEST(Quantity, UnitsFitTheSize) {
  EXPECT_EQ(PercentText(1), "100 %");
  EXPECT_EQ(PercentText(0.0005), "0.05 %");
  EXPECT_EQ(EnergyText(551), "551 J");
  EXPECT_EQ(EnergyText(51'113), "51.1 kJ");
  EXPECT_EQ(EnergyText(1'162'000), "1,160 kJ");
  EXPECT_EQ(LengthText(0.015), "15 mm");
  EXPECT_EQ(LengthText(1.254), "1.25 m");
  EXPECT_EQ(TimeText(963.7), "964 s");
  EXPECT_EQ(TimeText(9720), "2.7 h");
  EXPECT_EQ(FixedText(1162.44, 1), "1,162.4");
  EXPECT_EQ(FixedText(-0.001, 1), "0.0");
}

// "moved 0.50 m where 0.50 m was due" says nothing.
TEST(Quantity, AComparisonShowsTheDifference) {
  const Compared far = ComparedText(0.02, 0.5, 2, "m");
  EXPECT_EQ(far.value, "0.02 m");
  EXPECT_EQ(far.limit, "0.50 m");
  const Compared near = ComparedText(0.4996, 0.5, 2, "m");
  EXPECT_EQ(near.value, "0.4996 m");
  EXPECT_EQ(near.limit, "0.5000 m");
  EXPECT_EQ(ComparedText(0.5, 0.5, 2, "").value, "0.50");
}

}  // namespace
}  // namespace floorproof

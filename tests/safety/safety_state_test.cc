// SPDX-License-Identifier: Apache-2.0
// Every cell of the tables of "safety-monitoring".
#include "controllers/safety/safety_state.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace floorproof {
namespace {

constexpr Availability kRedundant = Availability::kRedundant, kEminent = Availability::kEminent,
                       kSingular = Availability::kSingular;
constexpr Persistence kIntermittent = Persistence::kIntermittent,
                      kPermanent = Persistence::kPermanent;

// Table 1: chi + psi, by availability; rows by persistence and occurrence.
struct QualityRow {
  int redundant, eminent, singular, psi;
  Occurrence occurrence;
  Persistence persistence;
};
constexpr QualityRow kTable1[] = {
    {1, 2, 3, 1, Occurrence::kVeryLow, kIntermittent},
    {2, 3, 4, 2, Occurrence::kLow, kIntermittent},
    {3, 4, 5, 3, Occurrence::kHigh, kIntermittent},
    {4, 5, 6, 4, Occurrence::kRelativelyHigh, kIntermittent},
    {2, 3, 4, 2, Occurrence::kVeryLow, kPermanent},
    {4, 5, 6, 4, Occurrence::kLow, kPermanent},
    {6, 7, 8, 6, Occurrence::kHigh, kPermanent},
    {8, 9, 10, 8, Occurrence::kRelativelyHigh, kPermanent},
};

TEST(SafetyState, Table1QualityAndAvailability) {
  for (const QualityRow& row : kTable1) {
    EXPECT_EQ(QualityAssessment(row.persistence, row.occurrence), row.psi);
    const auto sum = [&](Availability availability) {  // where Upsilon is 2, half of Eq. 1
      const FailureRating rating{Severity::kMinor, HarmExtent::kIsolated, kSingular,
                                 row.occurrence};
      return SafetyStateOf(rating, {row.persistence, availability}) / 2;
    };
    EXPECT_EQ(sum(kRedundant), row.redundant);
    EXPECT_EQ(sum(kEminent), row.eminent);
    EXPECT_EQ(sum(kSingular), row.singular);
  }
}

// Table 2: the safety state by severity and extent, for chi + psi from 1 to 10.
struct HarmRow {
  int upsilon;
  HarmExtent extent;
  Severity severity;
  int states[10];
};
constexpr HarmRow kTable2[] = {
    {0, HarmExtent::kIsolated, Severity::kAbsence, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {2, HarmExtent::kIsolated, Severity::kMinor, {2, 4, 6, 8, 10, 12, 14, 16, 18, 20}},
    {6, HarmExtent::kIsolated, Severity::kCatastrophic, {6, 12, 18, 24, 30, 36, 42, 48, 54, 60}},
    {0, HarmExtent::kExternal, Severity::kAbsence, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {4, HarmExtent::kExternal, Severity::kMinor, {4, 8, 12, 16, 20, 24, 28, 32, 36, 40}},
    {12,
     HarmExtent::kExternal,
     Severity::kCatastrophic,
     {12, 24, 36, 48, 60, 72, 84, 96, 108, 120}},
};

// A failure whose chi + psi is so much; Table 1 holds all from 1 to 10.
std::pair<Failure, Occurrence> OfSum(int sum) {
  for (const QualityRow& row : kTable1) {
    if (row.redundant == sum) return {{row.persistence, kRedundant}, row.occurrence};
    if (row.eminent == sum) return {{row.persistence, kEminent}, row.occurrence};
    if (row.singular == sum) return {{row.persistence, kSingular}, row.occurrence};
  }
  ADD_FAILURE() << sum;
  return {};
}

TEST(SafetyState, Table2SafetyStateBySeverityAndExtent) {
  for (const HarmRow& row : kTable2) {
    EXPECT_EQ(SeverityOfHarm(row.severity, row.extent), row.upsilon);
    for (int sum = 1; sum <= 10; ++sum) {
      const auto [failure, occurrence] = OfSum(sum);
      EXPECT_EQ(SafetyStateOf({row.severity, row.extent, kSingular, occurrence}, failure),
                row.states[sum - 1])
          << sum;
    }
  }
}

// Table 3: between which values the example's primitives lie. Least: redundant and intermittent.
TEST(SafetyState, Table3RangesOfTheExample) {
  const auto range = [](Severity severity, Occurrence occurrence) {
    const FailureRating rating{severity, HarmExtent::kExternal, kSingular, occurrence};
    return std::pair(SafetyStateOf(rating, {kIntermittent, kRedundant}),
                     SafetyStateOf(rating, {kPermanent, kSingular}));
  };
  EXPECT_EQ(range(Severity::kCatastrophic, Occurrence::kVeryLow), std::pair(12.0, 48.0));  // Line
  EXPECT_EQ(range(Severity::kMinor, Occurrence::kLow), std::pair(8.0, 24.0));           // Rotation
  EXPECT_EQ(range(Severity::kCatastrophic, Occurrence::kHigh), std::pair(36.0, 96.0));  // AccCtrl
}

TEST(SafetyState, LevelsEndWhereTheTextSaysAndEachBeginsAboveTheLast) {
  const std::pair<double, SafetyLevel> ends[] = {
      {0, SafetyLevel::kHigh},     {5, SafetyLevel::kHigh},     {6, SafetyLevel::kMedium},
      {20, SafetyLevel::kMedium},  {21, SafetyLevel::kWeak},    {42, SafetyLevel::kWeak},
      {43, SafetyLevel::kSerious}, {60, SafetyLevel::kSerious}, {61, SafetyLevel::kFatal},
      {120, SafetyLevel::kFatal}};
  for (const auto& [state, level] : ends) EXPECT_EQ(LevelOf(state), level) << state;
  EXPECT_EQ(LevelOf(5.5), SafetyLevel::kMedium) << "weights make states between whole numbers";
  EXPECT_EQ(LevelOf(61, {5, 20, 42, 90}), SafetyLevel::kSerious);
}

TEST(SafetyState, EachWeightMultipliesItsParameterAlone) {
  const FailureRating rating{Severity::kCatastrophic, HarmExtent::kExternal, kSingular,
                             Occurrence::kHigh};
  const Failure failure{kPermanent, kEminent};
  ASSERT_EQ(SafetyStateOf(rating, failure), 12 * (1 + 6));
  EXPECT_EQ(SafetyStateOf(rating, failure, {.severity = 0.5}), 6 * (1 + 6));
  EXPECT_EQ(SafetyStateOf(rating, failure, {.extent = 2}), 24 * (1 + 6));
  EXPECT_EQ(SafetyStateOf(rating, failure, {.availability = 3}), 12 * (3 + 6));
  EXPECT_EQ(SafetyStateOf(rating, failure, {.persistence = 0.5}), 12 * (1 + 3));
  EXPECT_EQ(SafetyStateOf(rating, failure, {.occurrence = 2}), 12 * (1 + 12));
}

}  // namespace
}  // namespace floorproof

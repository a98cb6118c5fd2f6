// SPDX-License-Identifier: Apache-2.0
// The balance of energy has two sides: the battery's is computed by the simulation, the heat of the
// motors by the true model. So a wrong power does not reappear as heat on the other side.
#include <gmock/gmock.h>

#include "validate/law.h"

namespace floorproof {
namespace {

using ::testing::AnyOf;
using ::testing::EndsWith;
using ::testing::Matches;

TEST(Energy, BalancesPartWhereTheMotorsPowerIsWrong) {
  std::vector<LawRow> rows;
  MakePlugin(Laws(), "energy", "law")->Check(kMoreResistance, rows);
  int balances = 0, losses = 0;
  for (const LawRow& row : rows) {
    // Not in this: power on flat floor and downhill, of which the windings' heat is a small share.
    const bool balance = Matches(
        AnyOf(EndsWith("/kinetic"), EndsWith("/potential"), EndsWith("/uphill/power")))(row.law);
    const bool heat = Matches(EndsWith("/losses"))(row.law);
    if (!balance && !heat) continue;
    EXPECT_EQ(row.ok(), heat) << row.law << ": " << row.expected << ", " << row.measured;
    balances += balance;
    losses += heat;
  }
  EXPECT_EQ(balances, 6);
  EXPECT_EQ(losses, 7);
}

}  // namespace
}  // namespace floorproof

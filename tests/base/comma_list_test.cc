// SPDX-License-Identifier: Apache-2.0
#include "base/comma_list.h"

#include <gmock/gmock.h>

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(CommaList, KeepsEmptyPartsAndNoSpacesAround) {
  EXPECT_THAT(SplitAtCommas("a, b c ,\td"), ElementsAre("a", "b c", "d"));
  EXPECT_THAT(SplitAtCommas(",a,,"), ElementsAre("", "a", "", ""));
  EXPECT_THAT(SplitAtCommas(" "), ElementsAre(""));
  EXPECT_THAT(SplitAtCommas(""), IsEmpty());
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/printable.h"

namespace floorproof {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kLong(100'000, 'x');

TEST(Error, QuotesKeysAndValuesWithSixtyCharacters) {
  const std::string cut = std::string(57, 'x') + "...";
  EXPECT_EQ(InputError({"f", 2}, "a." + kLong + ".last", "1", "r").what(),
            "f:2: a." + std::string(26, 'x') + "..." + std::string(24, 'x') + ".last = 1: r");
  EXPECT_EQ(InputError({"f", 2}, "k", kLong, "r").what(), "f:2: k = " + cut + ": r");
  const std::string whole(60, 'x');
  EXPECT_EQ(InputError({"f", 2}, "k", whole, "r").what(), "f:2: k = " + whole + ": r");
}

TEST(Error, CutsLongPathsInTheMiddle) {
  const std::string line = InputError({"/first/" + kLong + "/last.yaml", 3}, "k", "", "r").what();
  EXPECT_THAT(line, StartsWith("/first/xxx"));
  EXPECT_THAT(line, EndsWith("xxx/last.yaml:3: k: r"));
  EXPECT_LE(line.size(), 200u + 8u);
  EXPECT_THAT(InternalError("/first/" + kLong + "/last.mp4: the disk is full").what(),
              EndsWith("/last.mp4: the disk is full"));
}

TEST(Error, IsOneLineOfAtMostAThousandCharacters) {
  std::string words;
  for (int i = 0; i < 10'000; ++i) words += "two\nlines ";
  for (const std::string& line :
       {std::string(InputError(words).what()), std::string(InternalError(words).what()),
        std::string(InputError({kLong, 1}, kLong, kLong, words).what()), ErrorLine(words)}) {
    EXPECT_LE(line.size(), kMaxErrorLine);
    EXPECT_EQ(line.find('\n'), line.npos);
    EXPECT_THAT(line, EndsWith("..."));
  }
}

TEST(Error, IsPrintable) {
  for (const std::string text : {"\u202e", "\x1b[31m", "\u2028", "\u009b", "\xff"}) {
    EXPECT_EQ(WhyUnprintable(InputError({text, 1}, text, text, text).what()), "");
    EXPECT_EQ(WhyUnprintable(InternalError(text).what()), "");
  }
}

TEST(Error, IsCutBetweenCharacters) {
  std::string robots;
  for (int i = 0; i < 100; ++i) robots += "\U0001f916";
  const std::string line = InputError({}, "k", robots, "r").what();
  EXPECT_EQ(WhyUnprintable(line), "");
  EXPECT_THAT(line, HasSubstr("\U0001f916...: r"));
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "base/printable.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/markup.h"

namespace floorproof {
namespace {

TEST(Printable, PlainTextStaysAsItIs) {
  for (const char* text :
       {"", "a b", "caf\u00e9 \u65e5\u672c \U0001f916", "two\nlines\tand a tab"}) {
    EXPECT_EQ(Printable(text), text);
    EXPECT_EQ(WhyUnprintable(text), "");
  }
}

TEST(Printable, WhatMovesTheCursorOrTurnsTextIsShownAsAQuestionMark) {
  for (const std::string text :
       {"\x1b", "\x07", "\r", "\x7f", "\u009b", "\u202e", "\u2066", "\u200f", "\u2028"}) {
    EXPECT_EQ(Printable("a" + text + "b"), "a?b");
    EXPECT_NE(WhyUnprintable("a" + text + "b"), "");
    EXPECT_EQ(MarkupText("a" + text + "b"), "a?b");
    EXPECT_EQ(std::string(InputError("a" + text + "b").what()).find(text), std::string::npos);
  }
}

TEST(Printable, BytesThatAreNoUtf8AreShownAsQuestionMarks) {
  EXPECT_EQ(Printable("a\xff"), "a?");
  EXPECT_EQ(Printable("\xc3"), "?") << "cut short";
  EXPECT_EQ(Printable("\xc0\xaf"), "??") << "overlong";
  EXPECT_EQ(Printable("\xed\xa0\x80"), "???") << "half of a pair";
  EXPECT_EQ(WhyUnprintable("a\xff"), "is not UTF-8");
  EXPECT_FALSE(IsUtf8Text("a\xff"));
  EXPECT_TRUE(IsUtf8Text("a\r\n\u202e"));
}

}  // namespace
}  // namespace floorproof

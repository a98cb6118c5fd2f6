// SPDX-License-Identifier: Apache-2.0
#include "base/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floorproof {
namespace {

using ::testing::HasSubstr;

std::string Refusal(const std::string& text) {
  try {
    ParseYaml(text, "a.yaml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Config, RemembersWhereEachValueWasWritten) {
  const ConfigNode dut = ParseYaml("a: 1\nb:\n  c: [2, 3]\n", "a.yaml");
  EXPECT_EQ(dut.Find("a")->mark.line, 1);
  EXPECT_EQ(dut.Find("b")->Find("c")->mark.line, 3);
  EXPECT_EQ(dut.Find("b")->Find("c")->items[1].scalar, "3");
  EXPECT_EQ(dut.Find("nothing"), nullptr);
}

TEST(Config, AQuotedScalarIsAlwaysText) {
  const ConfigNode dut = ParseYaml("a: 1\nb: '1'\nc: null\nd: 'null'\n", "a.yaml");
  EXPECT_FALSE(dut.Find("a")->quoted);
  EXPECT_TRUE(dut.Find("b")->quoted);
  EXPECT_TRUE(dut.Find("c")->IsNull());
  EXPECT_EQ(dut.Find("d")->scalar, "null");
}

TEST(Config, WhatIsWrittenReadsBackTheSame) {
  const std::string text =
      "name: \"a: b # c\"\npoints: [[1, 2], [3, 4]]\nrows: |\n  #..#\n  ####\nempty: {}\nlist:\n  "
      "- a: "
      "1\n  - b\n";
  const std::string once = WriteYaml(ParseYaml(text, "a.yaml"));
  EXPECT_EQ(WriteYaml(ParseYaml(once, "b.yaml")), once);
  EXPECT_EQ(ParseYaml(once, "b.yaml").Find("rows")->scalar, "#..#\n####\n");
  EXPECT_EQ(ParseYaml(once, "b.yaml").Find("name")->scalar, "a: b # c");
}

// Text of any form reads the same once written, as a value that stands alone or among others.
TEST(Config, WritesTextSoThatItReadsTheSame) {
  for (const char* text :
       {"a", "a\n", "a\nb\n", "a\nb", "a\n\n", "\na\n", "  a\nb\n", "a\n  b\n", "e\t\n #\n", "\n",
        " ", "a: b", "# c", "- d", "\"q\"", "'", "x\\n", "..."}) {
    ConfigNode map = ConfigNode::Map();
    map.Add("name", ConfigNode::Scalar(text, true));
    map.Add("behind", ConfigNode::Scalar("1"));
    const ConfigNode dut = ParseYaml(WriteYaml(map), "a.yaml");
    ASSERT_NE(dut.Find("name"), nullptr) << WriteYaml(map);
    EXPECT_EQ(dut.Find("name")->scalar, text) << WriteYaml(map);
    EXPECT_EQ(dut.Find("behind")->scalar, "1") << WriteYaml(map);
  }
}

TEST(Config, RefusesWhatIsNoPlainTree) {
  EXPECT_THAT(Refusal("a: \"b\n"), HasSubstr("a.yaml:"));
  EXPECT_THAT(Refusal("a: [1, 2"), HasSubstr("a.yaml:"));
  EXPECT_THAT(Refusal("a: 1\nb: 2\na: 3\n"),
              HasSubstr("a.yaml:3: a: the key stands twice (first in line 1)"));
  EXPECT_THAT(Refusal("a: !!python/object x"), HasSubstr("tags are not allowed"));
  EXPECT_THAT(Refusal("a: 1\n---\nb: 2\n"), HasSubstr("more than one YAML document"));
  EXPECT_THAT(Refusal(std::string(20000, '[')), HasSubstr("a.yaml:1"));
}

TEST(Config, AliasesThatExplodeAreCounted) {
  // Each line holds ten times the one before: 10^9 values in ten lines.
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) text += (k ? ", " : "") + before;
    text += "]\n";
  }
  EXPECT_THAT(Refusal(text), HasSubstr("more than 400000 values"));
}

TEST(Config, SetPathMakesMapsOnTheWay) {
  ConfigNode dut = ParseYaml("a: {b: 1}\n", "a.yaml");
  dut.SetPath("a.b", ConfigNode::Scalar("2"));
  dut.SetPath("c.d.e", ConfigNode::Scalar("3"));
  EXPECT_EQ(dut.Find("a")->Find("b")->scalar, "2");
  EXPECT_EQ(dut.Find("c")->Find("d")->Find("e")->scalar, "3");
  EXPECT_THROW(dut.SetPath("a.b.c", ConfigNode::Scalar("4")), InputError);
}

TEST(Config, AMessageIsOneLineWhateverTheFileHolds) {
  const std::string said = InputError({"a\nb.yaml", 1}, "k\re\ny", "v\x1b[2J", "ru\nle").what();
  EXPECT_EQ(said, "a b.yaml:1: k e y = v?[2J: ru le");
  // Cut at the border of a character: nothing that is no UTF-8 comes of UTF-8.
  std::string long_value(56, 'x');
  long_value += "\u00e9\u00e9\u00e9\u00e9\u00e9";
  EXPECT_THAT(InputError({}, "k", long_value, "r").what(),
              HasSubstr("= " + std::string(56, 'x') + "\u00e9...: r"));
}

TEST(Config, FilesThatAreNoTextAreRefused) {
  EXPECT_THROW(ReadYamlFile("/nonexistent/x.yaml"), InputError);
  EXPECT_THROW(ReadYamlFile("/"), InputError);
}

}  // namespace
}  // namespace floorproof

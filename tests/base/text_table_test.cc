// SPDX-License-Identifier: Apache-2.0
// Tables in windows of any width, with text of any script.
#include "base/text_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/text_width.h"

namespace floorproof {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TextTable Failures() {
  TextTable table({{.heading = "Failure"}, {.heading = "Drives", .right = true}});
  table.Add({"stuck", "12"});
  table.Add({"roll over", "1,250"});
  return table;
}

FactTable Facts() {
  FactTable table;
  table.SetTitle("BELUGA on hall");
  table.Add({"Verdict", {"failure, stuck at 198.8 s: stood still for 7.6 s", Tone::kBad}});
  table.Add({"Covered", "22.8 % of the floor that the tool can reach, and of the rest nothing"});
  return table;
}

TEST(TextTable, LinesNumbersUpAtTheirEnds) {
  EXPECT_THAT(Failures().Lines(80, false), ElementsAre("  Failure    Drives",    //
                                                       "  stuck          12",    //
                                                       "  roll over   1,250"));  //
}

TEST(TextTable, WrapsWhereTheWindowEnds) {
  EXPECT_THAT(Facts().Lines(64, false),
              ElementsAre("BELUGA on hall",  //
                          "  Verdict             failure, stuck at 198.8 s: stood still for",
                          "                      7.6 s",
                          "  Covered             22.8 % of the floor that the tool can",
                          "                      reach, and of the rest nothing"));
}

TEST(TextTable, TurnsIntoLinesWhereEvenThatIsTooWide) {
  EXPECT_THAT(Facts().Lines(40, false), ElementsAre("BELUGA on hall",                           //
                                                    "  Verdict: failure, stuck at 198.8 s:",    //
                                                    "    stood still for 7.6 s",                //
                                                    "  Covered: 22.8 % of the floor that",      //
                                                    "    the tool can reach, and of the rest",  //
                                                    "    nothing"));                            //
  TextTable wide({{.heading = "Variant"}, {.heading = "Success"}, {.heading = "Timeout"}});
  wide.Add({"friction=0.4", "55 of 60 drives", ""});
  wide.Add({"friction=0.8", "59 of 60 drives", "1"});
  EXPECT_THAT(wide.Lines(30, false), ElementsAre("  friction=0.4",                //
                                                 "    Success: 55 of 60 drives",  //
                                                 "  friction=0.8",                //
                                                 "    Success: 59 of 60 drives",  //
                                                 "    Timeout: 1"));              //
}

TEST(TextTable, NoColumnIsNarrowerThanItsWords) {
  TextTable table({{.heading = "Variant", .wraps = true},
                   {.heading = "Interval", .wraps = true},
                   {.heading = "n", .right = true}});
  table.Add({"planner=boustrophedon", "+0.0091 (+0.0023 to +0.0158)", "20"});
  EXPECT_THAT(table.Lines(50, false),
              ElementsAre("  Variant                Interval                n",
                          "  planner=boustrophedon  +0.0091 (+0.0023 to    20",
                          "                         +0.0158)"));
}

TEST(TextTable, AllFactsOfAWindowLookAlike) {
  FactTable table;
  table.Add({"Results", "o"});
  EXPECT_THAT(table.Lines(80, false), ElementsAre("  Results             o"));
  EXPECT_THAT(table.Lines(40, false), ElementsAre("  Results: o"));
}

TEST(TextTable, KeepsWithinTheWindow) {
  for (int width = 20; width <= 200; ++width)
    for (const std::string& line : Facts().Lines(width, false))
      EXPECT_LE(DisplayWidth(line), width) << line;
}

TEST(TextTable, CountsColumnsNotBytes) {
  TextTable table({{.heading = "Site"}, {.heading = "Way", .right = true}});
  table.Add({"階段ホール", "1 m"});
  table.Add({"cafe\u0301", "20 m"});
  const auto dut = table.Lines(80, false);
  ASSERT_EQ(dut.size(), 3u);
  EXPECT_EQ(dut[1], "  階段ホール   1 m");
  EXPECT_EQ(dut[2], "  cafe\u0301        20 m");
  for (const std::string& line : dut) EXPECT_EQ(DisplayWidth(line), 18) << line;
}

TEST(TextTable, ShowsNoControlCharacterOfAName) {
  FactTable table;
  table.SetTitle("hall\033[2J");
  table.Add({"Site", "a\nb\tc\033[31md\u202ee"});
  for (const int width : {24, 80})
    for (const bool colours : {false, true})
      for (const std::string& line : table.Lines(width, colours)) {
        EXPECT_EQ(line.find_first_of("\n\t"), std::string::npos) << line;
        EXPECT_EQ(line.find("\033[2J"), std::string::npos) << line;
        EXPECT_EQ(line.find("\033[31m"), std::string::npos) << line;
      }
  EXPECT_THAT(table.Lines(80, false),
              ElementsAre("hall?[2J", "  Site                a b c?[31md?e"));
}

TEST(TextTable, ColoursChangeNoWord) {
  const auto plain = Facts().Lines(64, false), coloured = Facts().Lines(64, true);
  ASSERT_EQ(plain.size(), coloured.size());
  EXPECT_THAT(coloured[1],
              HasSubstr("\033[1;31mfailure, stuck at 198.8 s: stood still for\033[0m"));
  for (std::size_t i = 0; i < plain.size(); ++i) {
    std::string bare = coloured[i];
    for (const char* sequence : {"\033[1;31m", "\033[1m", "\033[0m"})
      for (std::size_t at; (at = bare.find(sequence)) != std::string::npos;)
        bare.erase(at, std::string_view(sequence).size());
    EXPECT_EQ(bare, plain[i]);
  }
}

TEST(TextTable, RowsSaidOneByOneLineUp) {
  const auto row = [](const char* name) {
    TextTable table({{.least = 8}, {}});
    table.Add({name, "ok"});
    return table.Lines(80, false).front();
  };
  EXPECT_EQ(row("step"), "  step      ok");
  EXPECT_EQ(row("passage"), "  passage   ok");
}

TEST(WrapText, KeepsUnitsWithTheirNumbers) {
  EXPECT_THAT(WrapText("took 198.8 s and 22.8 % of it", 10),
              ElementsAre("took", "198.8 s", "and 22.8 %", "of it"));
}

TEST(WrapText, KeepsPathsWhole) {
  EXPECT_THAT(WrapText("in out/a/very/long/folder it is", 10),
              ElementsAre("in", "out/a/very/long/folder", "it is"));
  EXPECT_THAT(WrapText("", 10), ElementsAre(""));
}

TEST(WrapText, BreaksBetweenWideCharacters) {
  EXPECT_THAT(WrapText("階段ホールの床", 8), ElementsAre("階段ホー", "ルの床"));
}

TEST(CutText, EndsWithinTheWindow) {
  EXPECT_EQ(CutText("driven 12 s", 11), "driven 12 s");
  EXPECT_EQ(CutText("driven 12 s", 10), "driven 12…");
  EXPECT_EQ(CutText("階段ホール", 8), "階段ホ…");
}

}  // namespace
}  // namespace floorproof

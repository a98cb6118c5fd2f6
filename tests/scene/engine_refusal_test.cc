// SPDX-License-Identifier: Apache-2.0
#include "env/scene/engine_refusal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace floorproof {
namespace {

using ::testing::HasSubstr;

std::string Line(const std::string& message, const std::string& file = "/robots/my.xml") {
  return EngineRefusal(file, "does not compile", message).what();
}

TEST(EngineRefusal, BeginsWithFileAndLine) {
  EXPECT_EQ(Line("XML Error: bad format in attribute 'condim'\nElement 'geom', line 18\n"),
            "/robots/my.xml:18: does not compile: XML Error: bad format in attribute 'condim' "
            "Element 'geom'");
  EXPECT_THAT(Line("XML parse error 14:\nError=X ErrorID=14 (0xe) Line number=7: name=geom\n"),
              HasSubstr("my.xml:7: does not compile: XML parse error 14:"));
}

// MuJoCo counts no lines of what a file includes, and says 0.
TEST(EngineRefusal, OfAnIncludeHasNoLine) {
  EXPECT_EQ(Line("Error: a\nElement 'geom', line 0\n"),
            "/robots/my.xml: does not compile: Error: a Element 'geom'");
  EXPECT_EQ(Line(""), "/robots/my.xml: does not compile: ");
  EXPECT_EQ(Line("the line 3 is long"), "/robots/my.xml: does not compile: the line 3 is long");
}

TEST(EngineRefusal, NamesFilesInTheRobotsFolder) {
  EXPECT_EQ(Line("no decoder for mesh '/robots/parts/a.dae'"),
            "/robots/my.xml: does not compile: no decoder for mesh 'parts/a.dae'");
}

TEST(EngineRefusal, QuotesLittle) {
  const std::string spaced =
      "it's bad: '" + std::string(40, 'x') + " " + std::string(900, 'y') + "'";
  const std::string line = Line(spaced);
  EXPECT_THAT(
      line, HasSubstr("it's bad: '" + std::string(40, 'x') + " " + std::string(15, 'y') + "...'"));
  EXPECT_LT(line.size(), 150u);
  EXPECT_LT(Line("unclosed '" + std::string(900, 'x')).size(), 150u);
  EXPECT_LT(Line(std::string(900, 'x') + ", line 3").size(), 150u);
  std::string words;
  for (int i = 0; i < 300; ++i) words += "word ";
  EXPECT_LT(Line(words).size(), 600u);
}

}  // namespace
}  // namespace floorproof

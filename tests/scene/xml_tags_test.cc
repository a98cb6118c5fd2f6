// SPDX-License-Identifier: Apache-2.0
#include "env/scene/xml_tags.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

TEST(XmlTags, SayWhatStandsWhere) {
  const std::string text =
      "<?xml version='1.0'?>\n<!-- <robot> -->\n<a x=\"1 > 2\" y='b'>\n  <b/>\n  <c>t</c>\n</a>";
  const auto dut = XmlElements(text);
  ASSERT_EQ(dut.size(), 3u);
  EXPECT_EQ(dut[0].name, "a");
  EXPECT_EQ(dut[0].line, 3);
  EXPECT_EQ(dut[0].Value("x"), "1 > 2");
  EXPECT_EQ(dut[0].Value("y"), "b");
  EXPECT_EQ(dut[0].Value("z"), "");
  EXPECT_EQ(dut[0].end, text.size());
  EXPECT_EQ(text.substr(dut[0].attributes[1].begin, 1), "b");
  EXPECT_EQ(dut[1].name, "b");
  EXPECT_EQ(dut[1].parent, 0);
  EXPECT_EQ(text.substr(dut[1].begin, dut[1].end - dut[1].begin), "<b/>");
  EXPECT_EQ(dut[2].line, 5);
  EXPECT_EQ(text.substr(dut[2].begin, dut[2].end - dut[2].begin), "<c>t</c>");
}

TEST(XmlTags, EndWithBrokenText) {
  for (const char* text : {"<", "<a", "<a ", "<a x", "<a x=", "<a x=\"", "<a></", "<a></b", "<!--",
                           "<![CDATA[ <a>", "</a>", "<a/", "< a>", "<=>", "<a \"=''>"})
    for (const XmlElement& element : XmlElements(text))
      EXPECT_LE(element.end, std::string_view(text).size()) << text;
  const auto unclosed = XmlElements("<a><b><c></a><d/>");
  ASSERT_EQ(unclosed.size(), 4u);
  EXPECT_EQ(unclosed[2].end, 13u) << "closed with what holds it";
  EXPECT_EQ(unclosed[3].parent, -1);
}

TEST(XmlTags, DecodeEntities) {
  EXPECT_EQ(DecodeXml("a &lt;b&gt; &quot;c&apos; &amp;lt;"), "a <b> \"c' &lt;");
  EXPECT_EQ(DecodeXml("&#110;a&#x6E;"), "nan");
  EXPECT_EQ(DecodeXml("&#xe4;&#8364;&#128512;"), "\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80");
  for (const char* text : {"&", "&#", "&#x", "&#110", "&#z;", "&#99999999999;", "&nan;", "a&b"})
    EXPECT_EQ(DecodeXml(text), text);
}

TEST(XmlTags, CountLines) {
  EXPECT_EQ(LineAt("a\nb\nc", 0), 1);
  EXPECT_EQ(LineAt("a\nb\nc", 4), 3);
}

}  // namespace
}  // namespace floorproof

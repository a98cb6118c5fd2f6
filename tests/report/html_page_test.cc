// SPDX-License-Identifier: Apache-2.0
#include "report/html_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/base64.h"
#include "base/file_output.h"
#include "web/assets.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

HtmlPage Page() {
  HtmlPage page;
  page.over = "Floorproof run";
  page.title = "<script>alert(1)</script> & more";
  page.about = "success";
  page.sections = {{"drive", "The drive", "<p>here</p>"}};
  return page;
}

TEST(HtmlPage, WhatATitleSaysIsNoMarkup) {
  const std::string html = Page().Html();
  EXPECT_THAT(html, HasSubstr("<h1>&lt;script&gt;alert(1)&lt;/script&gt; &amp; more</h1>"));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
}

TEST(HtmlPage, WithoutDataNoScriptMayRun) {
  EXPECT_THAT(Page().Html(), HasSubstr("default-src 'none'"));
  EXPECT_THAT(Page().Html(), Not(HasSubstr("script-src")));
}

TEST(HtmlPage, OnlyTheScriptsThatStandInItMayRun) {
  HtmlPage page = Page();
  page.data = "{}";
  const std::string html = page.Html();
  std::string digest;
  const std::string hex = Sha256(PageScript());
  for (std::size_t i = 0; i < hex.size(); i += 2)
    digest += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  EXPECT_THAT(html, HasSubstr("; script-src 'sha256-" + Base64(digest) + "'\">"));
  EXPECT_THAT(html, Not(HasSubstr("'unsafe-eval'")));
}

TEST(HtmlPage, DataCannotEndItsScript) {
  HtmlPage page = Page();
  page.data = R"({"name":"</script><script>alert(1)</script><!--"})";
  const std::string html = page.Html();
  const auto begin = html.find("id=\"page-data\">");
  ASSERT_NE(begin, html.npos);
  EXPECT_EQ(html.substr(begin, html.find("</script>", begin) - begin).find('<'), html.npos);
  EXPECT_THAT(html, HasSubstr(R"(\u003c/script>\u003cscript>alert(1))"));
}

TEST(HtmlPage, ALibraryIsThereWhereItIsUsed) {
  if (ThreeJs().empty()) GTEST_SKIP() << "built without the libraries of pages";
  HtmlPage page = Page();
  page.data = "{}";
  EXPECT_LT(page.Html().size(), 200000u);
  page.shows_replay = true;
  EXPECT_GT(page.Html().size(), 1000000u);
}

TEST(WebAssets, NoneEndsAScriptOrLoadsAnything) {
  for (const std::string_view script : {PageScript(), ThreeJs(), EChartsJs(), AgGridJs()})
    EXPECT_EQ(script.find("</script"), script.npos);
  EXPECT_EQ(PageScript().find("http"), PageScript().npos);
  EXPECT_EQ(PageStyle().find("url("), PageStyle().npos);
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "report/html.h"
#include "report/page.h"
#include "tests/report/html_page.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kHostile = "<script>alert('x')</script>\" onload=\"y\" & co";

VariantSummary Variant(const std::string& name, int k, int n) {
  VariantSummary v{.name = name, .n = n, .success = n - k, .failure = k};
  const double rate = n > 0 ? static_cast<double>(k) / n : std::numeric_limits<double>::quiet_NaN();
  v.failures = {{"any_failure", k, n, rate, rate / 2, 0.5}, {"stuck", k, n, rate, rate / 2, 0.5}};
  for (auto* per : {&v.per_km, &v.per_1000_h})
    *per = {{"any_failure", k, 2.5, k / 2.5, 0.1, 9}, {"stuck", k, 2.5, k / 2.5, 0.1, 9}};
  return v;
}

// A number that tells, a choice that does not, and a pair of the number with itself.
VariantDependence Dependence(const std::string& variant, const std::string& text) {
  const std::vector<ValueBin> bins = {{0.1, 0.5, {"", 8, 10, 0.8, 0.4, 0.97}},
                                      {0.6, 0.9, {"", 0, 90, 0, 0, 0.04}}};
  ValueDependence number{.key = text, .n = 100, .k = 8, .bins = bins, .p = 0.001, .p_holm = 0.002};
  number.shape = InfluenceShape::kLower;
  number.safe = SafeRange{.answer = SafeAnswer::kPart, .needed = 59, .whole = {0.9, 100, 8}};
  number.safe->from = Stretch{0.6, 90, 0};
  const ValueDependence choice{.key = text,
                               .is_number = false,
                               .n = 100,
                               .k = 8,
                               .bins = {{NAN, NAN, {text, 4, 50, 0.08, 0.02, 0.19}},
                                        {NAN, NAN, {text, 4, 50, 0.08, 0.02, 0.19}}},
                               .choice = text};
  PairDependence pair{text, text, bins, bins, {}};
  for (std::size_t c = 0; c < 4; ++c) pair.cells.push_back({c % 2, c / 2, bins[c % 2].rate});
  pair.cells[2].rate = {"", 0, 0, NAN, 0, 1};
  return {.variant = variant,
          .n = 100,
          .k = 8,
          .looked_at = 2,
          .values = {number, choice},
          .pairs = {pair}};
}

Report Full(const std::string& text) {
  Report r{.title = text};
  r.summary.campaign = text;
  r.summary.versions = {{text, text}};
  r.summary.gate = GateSummary{.metric = text, .max_rate = 0.05, .confidence = 0.95};
  r.summary.gate->variants = {{text, {.text = text}}};
  for (const char* number : {"1", "2"}) {
    VariantSummary v = Variant(text + number, 5, 20);
    v.kinds = v.hazards = {{text, 1, 20, 0.05, 0.01, 0.2}};
    v.metrics = {{text, MetricSpread{.mean = 1, .median = 2, .min = 3, .max = 4}}};
    r.summary.variants.push_back(v);
    r.maps.push_back({"png", text});
  }
  for (const VariantSummary& v : r.summary.variants)
    r.dependence.push_back(Dependence(v.name, text));
  r.pairs = {{.a = text, .b = text, .both = 1, .only_a = 2, .only_b = 3, .neither = 4}};
  r.pairs[0].metrics = {{.name = text, .pairs = text, .n = 10}};
  r.films = {{.variant = text,
              .what = text,
              .mp4 = "film",
              .path = text,
              .frames = {{text, "png"}},
              .maps = {{text, "png"}}},
             {.variant = text, .what = text, .path = text}};
  r.episodes = {{.variant = text, .what = text, .detail = text, .command = text}};
  r.settings = text;
  return r;
}

TEST(Report, TagsBalance) {
  EXPECT_EQ(WhyUnbalanced(ReportHtml(Full("floor"))), "");
  EXPECT_EQ(WhyUnbalanced(ReportHtml({})), "");
  EXPECT_NE(WhyUnbalanced("<p><b></p></b>"), "");
  EXPECT_NE(WhyUnbalanced("<p>"), "");
}

TEST(Report, EveryTextIsEscaped) {
  const std::string page = ReportHtml(Full(kHostile));
  EXPECT_EQ(WhyUnbalanced(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("\" onload")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&quot;"));
  // As many texts as before, none swallowed.
  const auto count = [](const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count(page, "&lt;script&gt;"), count(ReportHtml(Full("Quokka")), "Quokka") - 1)
      << "all but the film's address, which is percent-encoded";
}

TEST(Report, AsksNothingOfTheNetwork) {
  const std::string page = ReportHtml(Full("floor"));
  EXPECT_THAT(page, Not(HasSubstr("://")));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (auto at = page.find(" src=\""); at != std::string::npos; at = page.find(" src=\"", at + 1))
    EXPECT_EQ(page.substr(at + 6, 5), "data:");
}

TEST(Report, SmallFilmsStandInThePageLargeOnesAreLinkedAndNamed) {
  Report r = Full("floor");
  r.films[1].path = "episodes/robot=a b/3/video.mp4";
  const std::string page = ReportHtml(r);
  EXPECT_THAT(page, HasSubstr("src=\"data:video/mp4;base64,ZmlsbQ==\""));
  EXPECT_THAT(page, HasSubstr("href=\"episodes/robot%3Da%20b/3/video.mp4\""));
  EXPECT_THAT(page, HasSubstr("which lie beside it: episodes/robot=a b/3/video.mp4"));
  r.films.pop_back();
  EXPECT_THAT(ReportHtml(r), HasSubstr("complete in itself"));
}

// Of hundreds of variants a page with all maps would be hundreds of megabytes.
TEST(Report, MapsThatAreLeftOutAreCounted) {
  Report r;
  r.summary.variants = {Variant("a", 1, 20), Variant("b", 0, 20), Variant("c", 0, 20)};
  r.maps = {{.png = "png"}, {.left_out = true}, {.left_out = true}};
  const std::string page = ReportHtml(r);
  EXPECT_EQ(WhyUnbalanced(page), "");
  EXPECT_THAT(page, HasSubstr("Of 2 variants the maps are left out"));
  EXPECT_THAT(page, HasSubstr("Left out of so many variants: <code>floorproof compare</code>"));
}

TEST(Report, IntervalsAreDrawnOnOneAxisForAllVariants) {
  Report r;
  r.summary.variants = {Variant("a", 10, 100), Variant("b", 1, 100)};
  r.summary.variants[0].failures[0] = {"any_failure", 10, 100, 0.1, 0.05, 0.18};
  r.summary.variants[1].failures[0] = {"any_failure", 1, 100, 0.01, 0.0, 0.05};
  for (auto& v : r.summary.variants) v.failures.resize(1);
  for (auto& v : r.summary.variants) v.per_km.resize(1), v.per_1000_h.resize(1);
  r.maps.assign(2, {"", "no map"});
  const std::string page = ReportHtml(r);  // the axis ends at 20 %
  EXPECT_THAT(page, HasSubstr("x1=\"25.00%\" x2=\"90.00%\""));
  EXPECT_THAT(page, HasSubstr("x1=\"0.00%\" x2=\"25.00%\""));
  EXPECT_THAT(page, HasSubstr("cx=\"50.00%\""));
  EXPECT_THAT(page, HasSubstr("cx=\"5.00%\""));
}

TEST(Report, ShowsWhatFailuresDependOn) {
  Report r;
  r.summary.variants = {Variant("a", 8, 100)};
  r.maps.push_back({"", "no map"});
  r.dependence = {Dependence("a", "friction")};
  std::string page = ReportHtml(r);
  EXPECT_EQ(WhyUnbalanced(page), "");
  EXPECT_THAT(page,
              HasSubstr("<h4>friction</h4>\n<p>Failures at lower values (p = 0.002 after Holm "
                        "for 2 values).</p>\n<p>Safe on average (not_success below 5 % at 95 %) "
                        "from 0.6 on (0 of 90 failed).</p>"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">0.1 to 0.5</th><td class=\"num\">8 of 10</td>"));
  EXPECT_THAT(page, HasSubstr("<details><summary>friction: no influence shown (p = 1"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">0.6 to 0.9</th><td>–</td>"))
      << "the highest on top; no episode there";
  EXPECT_THAT(page, HasSubstr(">80 %<small>8 of 10</small><small>40 to 97 %</small>"))
      << "to be read on paper and by touch";

  r.dependence[0].values.clear();
  EXPECT_THAT(ReportHtml(r), Not(HasSubstr("id=\"dependence\""))) << "nothing was drawn";
}

TEST(Report, SaysWhatIsSafeWhereNothingFailed) {
  Report r;
  r.summary.variants = {Variant("a", 0, 60)};
  r.maps.push_back({"", "no map"});
  r.dependence = {{.variant = "a", .n = 60, .note = "no episode failed"}};
  r.dependence[0].values = {{.key = "friction", .n = 60}};
  r.dependence[0].values[0].safe =
      SafeRange{.answer = SafeAnswer::kWhole, .needed = 59, .whole = {0.9, 60, 0}};
  EXPECT_THAT(ReportHtml(r),
              HasSubstr("<p>No episode failed.</p>\n<ul><li>friction: safe on average (not_success "
                        "below 5 % at 95 %) over the whole range drawn (0 of 60 failed)"));
}

TEST(Report, AValueThatNeverDiffersIsNotLookedAt) {
  Report r;
  r.summary.variants = {Variant("a", 8, 100)};
  r.maps.push_back({"", "no map"});
  r.dependence = {{.variant = "a", .n = 100, .k = 8}};
  r.dependence[0].values = {{.key = "friction", .n = 100, .k = 8}};
  r.dependence[0].values[0].bins = {{0.5, 0.5, {"", 8, 100, 0.08, 0.04, 0.2}}};
  EXPECT_THAT(ReportHtml(r), HasSubstr("friction has one value in all episodes."));
}

TEST(Report, NumbersForPeople) {
  EXPECT_EQ(NumberText(0.086571), "0.0866");
  EXPECT_EQ(NumberText(94.56), "94.6");
  EXPECT_EQ(NumberText(999.4), "999");
  EXPECT_EQ(NumberText(999.9), "1,000");
  EXPECT_EQ(NumberText(135915.3), "136,000");
  EXPECT_EQ(NumberText(-1234567), "-1,230,000");
  EXPECT_EQ(NumberText(std::numeric_limits<double>::infinity()), "–");
  EXPECT_EQ(PercentText(0.25), "25 %");
  EXPECT_EQ(PercentText(Interval{0, 0.60236}), "0 to 60.3 %") << "ends are rounded outward";
  EXPECT_EQ(PercentText(Interval{0.012349, 0.25}), "1.23 to 25 %");
  EXPECT_EQ(DataUri("a/b", "M"), "data:a/b;base64,TQ==");
  EXPECT_EQ(DataUri("a/b", "Man"), "data:a/b;base64,TWFu");
  EXPECT_EQ(DataUri("a/b", std::string("\xff\x00", 2)), "data:a/b;base64,/wA=");
}

}  // namespace
}  // namespace floorproof

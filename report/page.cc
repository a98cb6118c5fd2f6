// SPDX-License-Identifier: Apache-2.0
#include "report/page.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/quantity.h"
#include "report/dependence_tables.h"
#include "report/html.h"
#include "report/page_drives.h"
#include "report/rates.h"
#include "report/settings_section.h"
#include "report/verdict.h"

namespace floorproof {
namespace {

std::string Rates(const Report& report) {
  std::string html;
  if (report.summary.variants.size() > 1)
    html += "<div class=\"card\">" + VariantsTable(report) + "</div>\n";
  for (const VariantSummary& v : report.summary.variants)
    html +=
        fmt::format("<article class=\"card\">{}{}</article>\n",
                    report.summary.variants.size() > 1 ? "<h3>" + MarkupText(v.name) + "</h3>\n"
                                                       : "<h3 class=\"off\">All episodes</h3>\n",
                    VariantRates(report, v));
  return html + fmt::format(
                    "<p class=\"note\">Rates are of episodes that ended in success, failure or "
                    "timeout; a failure counts once an episode. Bars: two-sided {} Clopper-Pearson "
                    "intervals, on one axis throughout{}.</p>\n",
                    PercentText(kReportedConfidence),
                    report.summary.gate ? "; dashed: the gate's limit" : "");
}

std::string Places(const Report& report) {
  std::string html = TheaterHtml();
  const auto& variants = report.summary.variants;
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const ReportMap& map = report.maps.at(i);
    if (map.left_out) {
      ++left_out;
      continue;
    }
    const std::string rates = PlaceRates(report, variants[i]);
    // Where the map to click takes the picture's place, nothing is left of a card without rates.
    html += fmt::format(
        "<div class=\"card places{}\">",
        !map.png.empty() && !map.data.is_null() && rates.empty() ? " replaced-by-map" : "");
    if (variants.size() > 1) html += "<h3>" + MarkupText(variants[i].name) + "</h3>\n";
    if (!map.png.empty())
      html += "<div class=\"replaced-by-map\">" +
              PictureHtml({"Where " + (variants.size() > 1 ? variants[i].name : "the robot") +
                               " failed; numbers are episodes" +
                               (map.note.empty() ? "" : "; " + map.note),
                           map.png}) +
              "</div>";
    else
      html += "<p class=\"note\">" + MarkupText(map.note) + "</p>\n";
    html += rates + "</div>\n";
  }
  if (left_out > 0)
    html += fmt::format(
        "<p class=\"note\">Of {} the maps are left out: shown are those that failed most.</p>\n",
        CountText(left_out, "variant"));
  return html;
}

// `number`: of the film, by which the scripts find it.
std::string Film(const Report& report, const ReportFilm& film, std::size_t number) {
  std::string name = fmt::format("Episode {}", film.episode);
  if (report.summary.variants.size() > 1) name += " of " + film.variant;
  if (!film.what.empty()) name += ": " + film.what;
  std::string html = "<article class=\"card\"><h3>" + MarkupText(name) + "</h3>\n";
  if (!film.mp4.empty())
    html += fmt::format(
        "<div><video id=\"film-{}\" controls preload=\"metadata\" src=\"{}\" "
        "aria-label=\"{}\"></video></div>\n",
        number, DataUri("video/mp4", film.mp4), MarkupText("Film. " + name));
  else
    html += fmt::format("<p>Film, {:.1f} MB, beside this page: <a href=\"{}\">{}</a></p>\n",
                        film.megabytes, UrlPath(film.path), MarkupText(film.path));
  html += PicturesHtml(film.frames);
  if (!film.maps.empty())
    html +=
        "<details><summary>Maps of this episode</summary>" + PicturesHtml(film.maps) + "</details>";
  return html + "</article>\n";
}

std::string Films(const Report& report) {
  std::string html;
  for (std::size_t i = 0; i < report.films.size(); ++i) html += Film(report, report.films[i], i);
  if (report.films_left_out > 0)
    html +=
        fmt::format("<p class=\"note\">{} more filmed in the folder <code>episodes</code>.</p>\n",
                    report.films_left_out);
  return html;
}

std::string EpisodeRowHtml(const ReportEpisode& e, bool name_variant) {
  const std::string time = e.t_s ? fmt::format("{:.1f} s", *e.t_s) : "";
  const std::string place =
      e.x_m && e.y_m ? fmt::format("x {:.2f}, y {:.2f} m", *e.x_m, *e.y_m) : "";
  return fmt::format(
      "<tr><th scope=\"row\">{}{}</th><td>{}{}</td><td>{}</td><td class=\"num\">{}</td><td "
      "class=\"num\">{}</td><td><code>{}</code></td></tr>\n",
      name_variant ? MarkupText(e.variant) + " " : "", e.episode, MarkupText(e.what),
      e.further > 0 ? fmt::format(" and {} more", e.further) : "", MarkupText(e.detail), time,
      place, MarkupText(e.command));
}

std::string Episodes(const Report& report) {
  if (report.episodes.empty()) return "<p>No episode failed.</p>\n";
  std::string html =
      "<p class=\"note\">Each command drives the recorded episode again, exactly, and films "
      "it; it names folders as they were named when this page was made, from the folder where that "
      "was.</p>\n<div id=\"episode-table\"></div><div class=\"card replaced-by-table\"><table "
      "class=\"list\"><thead><tr><th scope=\"col\">Episode</th>"
      "<th scope=\"col\">Failure</th><th scope=\"col\">Hazard, or reason</th><th scope=\"col\" "
      "class=\"num\">Time</th><th scope=\"col\" class=\"num\">Place</th><th scope=\"col\">Film it"
      "</th></tr></thead><tbody>\n";
  for (const ReportEpisode& e : report.episodes)
    html += EpisodeRowHtml(e, report.summary.variants.size() > 1);
  html += "</tbody></table>";
  if (report.episodes_left_out > 0)
    html += fmt::format("<p>{} more stand in <code>episodes.csv</code>.</p>\n",
                        report.episodes_left_out);
  html += "</div>\n";
  return html;
}

// What this page needs beside it.
std::string Footer(const Report& report) {
  std::string linked;
  for (const ReportFilm& film : report.films)
    if (film.mp4.empty()) linked += (linked.empty() ? "" : ", ") + MarkupText(film.path);
  return "<p class=\"note\">" +
         (linked.empty() ? std::string("This page is complete in itself: everything it shows "
                                       "stands in this one file.")
                         : "Everything this page shows stands in this one file, except films too "
                           "large for it, which lie beside it: " +
                               linked + ".") +
         "</p>";
}

}  // namespace

std::string ReportHtml(const Report& report) {
  HtmlPage page;
  page.over = "Floorproof campaign";
  page.title = report.title;
  page.about = "failure rates";
  page.verdict = VerdictBox(report);
  page.sections.push_back({"places", "Where failures happened", Places(report)});
  page.sections.push_back({"rates", "Failure rates", Rates(report)});
  if (const std::string tables = DependenceTables(report); !tables.empty())
    page.sections.push_back({"dependence", "What it depends on", tables});
  if (report.pairs.empty() && report.summary.variants.size() > 1)
    page.sections.push_back({"pairs", "Paired comparison",
                             "<p class=\"note\">Left out of so many variants: <code>floorproof "
                             "compare</code> compares two of them.</p>\n"});
  if (!report.pairs.empty())
    page.sections.push_back(
        {"pairs", "Paired comparison",
         "<div class=\"card\">" + PairedTables(report) +
             "<p class=\"note\">The same episode number has the same draws in both. "
             "Differences are the variant less the first. Rates: Tango's score "
             "interval; means: Student's t; medians: sign test.</p></div>\n"});
  if (!report.films.empty()) page.sections.push_back({"films", "Films", Films(report)});
  page.sections.push_back({"episodes", "Failing episodes", Episodes(report)});
  page.sections.push_back(SettingsSection(report.summary, report.settings));
  page.footer = Footer(report);
  page.data = report.data;
  page.blobs = report.replays;
  page.shows_replay = !report.replays.empty();
  page.shows_plots = true;
  page.shows_table = !report.episodes.empty();
  return page.Html();
}

}  // namespace floorproof

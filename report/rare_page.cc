// SPDX-License-Identifier: Apache-2.0
#include "report/rare_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/input_file.h"
#include "base/result_folder.h"
#include "base/words.h"
#include "report/films.h"
#include "report/html.h"
#include "report/html_page.h"
#include "report/page_drives.h"
#include "report/rare_films.h"
#include "report/verdict.h"
#include "run/episode/json_file.h"
#include "run/rare/rare_json.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRareStyle = R"css(
.scale { width: 100%; height: auto; } .scale text { font-size: 11px; fill: var(--ink); }
.scale .grid { stroke: var(--line); } .scale .soft { fill: var(--soft); }
.scale .sure { fill: var(--line); } .scale .estimate { fill: var(--mark); }
.scale .point { stroke: var(--ink); stroke-width: 2; }
code { overflow-wrap: anywhere; }
)css";

// The bounds and the estimate on one logarithmic line.
std::string Scale(const JsonValue& rare) {
  const bool estimated = !rare.at("probability").is_null();
  const double most = rare.at("without_sampler").at("upper"),
               least = rare.at("without_sampler").at("lower");
  double low = estimated ? rare.at("lower").get<double>() : most / 100;
  if (least > 0) low = std::min(low, least);
  const double from = std::floor(std::log10(std::max(low, 1e-14))),
               to = std::max(from + 1, std::ceil(std::log10(most)));
  constexpr double kLeft = 150, kWidth = 540;
  const auto x = [&](double p) {
    return kLeft +
           kWidth * std::clamp((std::log10(std::max(p, 1e-15)) - from) / (to - from), 0., 1.);
  };
  std::string svg =
      "<svg class=\"scale\" viewBox=\"0 0 720 130\" role=\"img\" aria-label=\"The estimate and the "
      "bounds on a logarithmic scale; the table below has the numbers\">\n";
  const int step = std::max(1, static_cast<int>(std::ceil((to - from) / 6)));
  for (int e = static_cast<int>(from); e <= static_cast<int>(to); e += step)
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" y1=\"10\" x2=\"{0:.1f}\" y2=\"98\"/><text "
        "x=\"{0:.1f}\" "
        "y=\"118\" text-anchor=\"middle\" class=\"soft\">{1}</text>\n",
        x(std::pow(10, e)), e == 0 ? "always" : OneIn(std::pow(10, e)));
  const auto bar = [&](double y, const char* name, const char* kind, double a, double b) {
    svg += fmt::format(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text><rect class=\"{}\" x=\"{:.1f}\" "
        "y=\"{}\" width=\"{:.1f}\" height=\"16\" rx=\"3\"/>\n",
        kLeft - 8, y + 12, name, kind, x(a), y, std::max(2.0, x(b) - x(a)));
  };
  bar(20, "without the sampler", "sure", least, most);
  if (estimated) {
    bar(60, "estimate", "estimate", rare.at("lower"), rare.at("upper"));
    svg +=
        fmt::format("<line class=\"point\" x1=\"{0:.1f}\" y1=\"56\" x2=\"{0:.1f}\" y2=\"80\"/>\n",
                    x(rare.at("probability")));
  }
  return svg + "</svg>\n";
}

std::string Row(const std::string& name, const std::string& value, const std::string& what) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n", name, value,
                     what);
}

std::string Numbers(const JsonValue& rare) {
  const JsonValue sure = rare.at("without_sampler");
  std::string html =
      "<div class=\"card scroll\" tabindex=\"0\">" + Scale(rare) +
      "<table><thead><tr><th scope=\"col\">Figure</th><th scope=\"col\">Failures a drive</th><th "
      "scope=\"col\">What it rests on</th></tr></thead><tbody>\n";
  if (!rare.at("probability").is_null())
    html += Row("Estimate",
                fmt::format("{}: {} ({} to {} at 95 %)", OneIn(rare.at("probability")),
                            PercentText(rare.at("probability").get<double>()),
                            PercentText(rare.at("lower").get<double>()),
                            PercentText(rare.at("upper").get<double>())),
                "the sampler: it counts the ways to fail that it found");
  html += Row("At least", PercentText(sure.at("lower").get<double>()),
              "the failures that were drawn, whatever the distribution of their weights (95 %)");
  html +=
      Row("At most", PercentText(sure.at("upper").get<double>()),
          fmt::format("{} as they come, of which {} failed, and nothing else (95 %). No sampler "
                      "gives a better bound for ways to fail that it has not found",
                      CountText(sure.at("nominal_draws").get<std::int64_t>(), "drive"),
                      sure.at("nominal_failures").get<int>()));
  if (!rare.at("clean_drives_needed").is_null())
    html +=
        Row("To show the estimate without a sampler",
            CountText(std::llround(std::min(rare.at("clean_drives_needed").get<double>(), 1e15)),
                      "drive"),
            "as they come, and none may fail");
  return html + "</tbody></table></div>\n";
}

std::string Happening(const JsonValue& likeliest) {
  std::string text;
  for (const JsonValue& event : likeliest.at("events").elements()) {
    const std::string hazard = event.at("hazard");
    text += fmt::format("{}{}{} after {} s", text.empty() ? "" : ", ",
                        Words(event.at("mode").get<std::string>()),
                        hazard.empty() ? "" : " at " + hazard, FixedText(event.at("t_s"), 1));
  }
  return text.empty() ? likeliest.at("outcome").get<std::string>() : text;
}

// `number`: of the drive on the page.
std::string Film(const fs::path& folder, const fs::path& file, std::size_t number) {
  const std::string path = fs::path(file).lexically_relative(folder).generic_string();
  if (fs::file_size(file) > kLargestFilm)
    return fmt::format("<p><a href=\"{}\">{}</a></p>\n", UrlPath(path), MarkupText(path));
  return fmt::format(
      "<figure><video id=\"film-{}\" controls preload=\"metadata\" src=\"{}\" aria-label=\"Film of "
      "the failure\"></video></figure>\n",
      number, DataUri("video/mp4", ReadInputFile(file, kLargestFilm)));
}

// The regions; their likeliest failures, where they were driven again, also as drives of the page.
std::string Regions(const JsonValue& rare, const fs::path& folder, HtmlPage& page) {
  std::string html;
  PageDrives drives(page);
  std::size_t number = 0;
  for (const JsonValue& region : rare.at("regions").elements()) {
    ++number;
    html += fmt::format(
        "<article class=\"card\"><h3>{}. {} of the failures</h3>\n<p>{} among the draws; {} of {} "
        "pilots came upon it.</p>\n",
        number, PercentText(region.at("share").get<double>(), 2),
        CountText(region.at("draws").get<std::int64_t>(), "failure"),
        region.at("pilots").get<int>(), rare.at("pilots").elements().size());
    const JsonValue likeliest = region.at("likeliest");
    if (!likeliest.is_null()) {
      html += fmt::format("<p>The likeliest, {} standard deviations from the middle: {}.</p>\n",
                          FixedText(region.at("distance"), 2), MarkupText(Happening(likeliest)));
      std::vector<std::string> sets;
      for (const JsonValue& set : likeliest.at("set").elements()) sets.push_back(set);
      if (const fs::path film = FilmOf(folder, number, sets); !film.empty()) {
        html += Film(folder, film, drives.size());
        drives.Add(RunRecord(film.parent_path()),
                   fmt::format("{}. {}", number, Happening(likeliest)), likeliest.at("command"),
                   fs::file_size(film) <= kLargestFilm);
      }
      html += "<table><tbody>\n";
      for (const std::string& set : sets) {
        const std::size_t at = set.find('=');
        html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n",
                            MarkupText(set.substr(0, at)),
                            MarkupText(at == std::string::npos ? "" : set.substr(at + 1)));
      }
      html +=
          "</tbody></table>\n<details><summary>The command that drives it again, in this "
          "folder</summary><p><code>" +
          MarkupText(likeliest.at("command").get<std::string>()) + "</code></p></details>\n";
    }
    html += "</article>\n";
  }
  if (drives.size() == 0) return html.empty() ? "<p>None was found.</p>\n" : html;
  drives.Finish();
  return TheaterHtml() + html;
}

std::string Search(const JsonValue& rare) {
  std::string coordinates;
  for (const JsonValue& key : rare.at("coordinates").elements())
    coordinates += (coordinates.empty() ? "" : ", ") + key.get<std::string>();
  if (rare.at("noise").get<bool>()) coordinates += ", and the noise of sensors";
  std::string html = fmt::format(
      "<p>{} in all, over what the scenario draws: {}. Five pilots went towards failures, a "
      "density "
      "was fitted to what they found, and {} from it gave the estimate.</p>\n",
      CountText(rare.at("trials").get<std::int64_t>(), "drive"), MarkupText(coordinates),
      CountText(rare.at("diagnostics").at("fresh_draws").get<std::int64_t>(), "weighted draw"));
  html +=
      "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th scope=\"col\">Pilot</th><th "
      "scope=\"col\">How "
      "it "
      "ended</th><th scope=\"col\">Levels</th><th scope=\"col\">Failures met</th><th "
      "scope=\"col\">Its own estimate</th></tr></thead><tbody>\n";
  int number = 0;
  for (const JsonValue& pilot : rare.at("pilots").elements()) {
    const double p = pilot.at("probability");
    html +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", ++number,
                    MarkupText(pilot.at("end").get<std::string>()), pilot.at("levels").get<int>(),
                    pilot.at("failures").get<int>(), p > 0 ? OneIn(p) : "none");
  }
  html += "</tbody></table></div>\n";
  const JsonValue d = rare.at("diagnostics");
  html += fmt::format(
      "<p>Of the draws {} failed, worth {} of equal weight; the heaviest makes {} of the estimate. "
      "There is none where that is more than 25 %, where failures are worth fewer than 20, where "
      "30 "
      "% lies where one pilot alone was, or where draws and pilots differ by a factor of 4.</p>\n",
      FixedText(d.at("fresh_failures"), 0), NumberText(d.at("effective_failures").get<double>()),
      PercentText(d.at("largest_share").get<double>(), 2));
  if (const auto errors = rare.at("errors").get<std::int64_t>(); errors > 0)
    html += fmt::format("<p>{} ended in an error or had no plan, and count as no failure.</p>\n",
                        CountText(errors, "drive"));
  return html;
}

// What drove, by which plan, where; empty: that cannot be read any more.
std::string Subject(const fs::path& folder) {
  try {
    return SubjectOf(ScenarioFile(folder / "scenario.resolved.yaml").Read(std::nullopt), {}) + ": ";
  } catch (const InputError&) {
    return "";
  }
}

std::string Verdict(const JsonValue& rare, const std::string& subject) {
  const std::string mode = subject + Words(rare.at("mode").get<std::string>()),
                    answer = rare.at("answer");
  const JsonValue sure = rare.at("without_sampler");
  const std::string trials = CountText(rare.at("trials").get<std::int64_t>(), "drive");
  if (answer == "estimate")
    return fmt::format("{}: {} drives ({} to {} at 95 %), found with {}", mode,
                       OneIn(rare.at("probability")), OneIn(rare.at("upper")),
                       NumberText(1 / rare.at("lower").get<double>()), trials);
  if (answer == "nothing_found")
    return fmt::format("{}: none of {} failed; at most {} of drives do, at 95 %", mode, trials,
                       PercentText(sure.at("upper").get<double>()));
  return fmt::format("{}: no estimate from {}: {}", mode, trials,
                     rare.at("why").get<std::string>());
}

RarePage Page(const JsonValue& rare, const fs::path& folder) {
  RarePage page;
  page.verdict = Verdict(rare, Subject(folder));
  std::string gate, kind = "none";
  if (!rare.at("gate").is_null()) {
    gate =
        "<ul><li>Gate: " + MarkupText(rare.at("gate").at("text").get<std::string>()) + "</li></ul>";
    kind = rare.at("gate").at("verdict");
  }
  HtmlPage html;
  html.over = "Floorproof, rare failures";
  html.title = rare.at("name").get<std::string>();
  html.about = "rare failures";
  html.extra_style = kRareStyle;
  html.verdict = "<div class=\"verdict " + MarkupText(kind) + "\"><p>" + MarkupText(page.verdict) +
                 "</p>" + gate + "</div>\n";
  html.sections = {{"numbers", "How rare", Numbers(rare)},
                   {"failures", "The likeliest failures", Regions(rare, folder, html)},
                   {"search", "How it was found", Search(rare)}};
  page.html = html.Html();
  return page;
}

}  // namespace

bool HoldsRareSearch(const fs::path& folder) {
  std::error_code none;
  return (fs::exists(folder / "rare.json", none) || fs::exists(folder / "trials.sqlite", none)) &&
         !fs::exists(folder / "campaign.sqlite", none);
}

RarePage MakeRarePage(const fs::path& folder) {
  constexpr std::size_t kMost = 16u << 20;
  const fs::path file = folder / "rare.json";
  if (std::error_code none; !fs::exists(file, none))
    throw InputError({file.string(), 0}, "", "",
                     "no such file: the search has no answer yet; the same `rare` with --resume "
                     "goes on");
  RequirePlainResults(folder);
  const JsonValue rare = ReadJsonFile(file, "an answer of floorproof rare", kMost);
  if (rare.value("rare", 0) != 1)
    throw InputError({file.string(), 0}, "rare", "", "must be 1: not an answer of this version");
  for (const JsonValue& p : {rare.at("probability"), rare.at("lower"), rare.at("upper"),
                             rare.at("without_sampler").at("upper")})
    if (!p.is_null() && !(p.get<double>() > 0 && p.get<double>() <= 1))
      p.Refuse("must be a probability: in (0, 1]");
  return Page(rare, folder);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/input_file.h"
#include "base/shell_word.h"
#include "base/words.h"
#include "report/films.h"
#include "report/html.h"
#include "report/html_page.h"
#include "report/page_drives.h"
#include "report/settings_section.h"
#include "run/episode/metrics.h"
#include "run/episode/records.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// result.json and what stands beside it.
class Run {
 public:
  Run(const fs::path& folder, const std::string& named)
      : folder_(folder), named_(named), record_(folder) {}

  RunPage Make() {
    RunPage page;
    page.verdict = Verdict();
    page.html = Page(page.verdict).Html();
    return page;
  }

 private:
  std::string Text(const char* key) const { return record_.Text(key); }
  std::optional<double> Metric(const std::string& name) const { return record_.Metric(name); }
  const std::vector<JsonValue>& Events() const { return record_.Events(); }

  // "stuck at 198.8 s: stood still for 7.6 s before 'plank' (step, 40 mm), at ..."
  static std::string EventText(const JsonValue& event) {
    return fmt::format("{} at {} s: {}", RunRecord::WhatOf(event), FixedText(event.at("t_s"), 1),
                       event.value("text", std::string()));
  }

  std::string Verdict() const {
    std::string text =
        (record_.subject().empty() ? "" : record_.subject() + ": ") + Words(Text("outcome"));
    if (!Events().empty()) {
      text += ", " + EventText(Events().front());
      if (Events().size() > 1)
        text += fmt::format("; {}", CountText(Events().size() - 1, "further event"));
    } else if (const std::string why = Text("message"); !why.empty()) {
      text += ": " + why;
    } else if (const auto coverage = Metric("coverage")) {
      text += ", covered " + PercentText(*coverage);
    }
    return text;
  }

  std::string VerdictBox(const std::string& verdict) const {
    const std::string outcome = Text("outcome");
    const char* tone = outcome == "success"   ? "passed"
                       : outcome == "failure" ? "failed"
                                              : "undecided";
    std::string facts;
    const auto add = [&](const std::string& text) { facts += "<li>" + MarkupText(text) + "</li>"; };
    if (const auto coverage = Metric("coverage"); coverage && !Events().empty())
      add("Covered " + PercentText(*coverage) + " of the floor that the tool can reach.");
    if (const auto t_s = Metric("duration_s"))
      add(fmt::format("Drove {} in {}, with {}.", LengthText(Metric("path_length_m").value_or(0)),
                      TimeText(*t_s), EnergyText(Metric("energy_j").value_or(0))));
    return fmt::format("<div class=\"verdict {}\"><p>{}</p><ul>{}</ul></div>\n", tone,
                       MarkupText(verdict), facts);
  }

  // The data for the scripts; returns where they show it.
  std::string Theater(HtmlPage& page) const {
    PageDrives drives(page);
    const std::string unread =
        drives.Add(record_, Text("robot") + " on " + Text("site"),
                   "floorproof replay " + ShellWord(named_) + " --video", !film_.empty());
    drives.Finish();
    std::string still, note;
    if (const std::string png = ReadPlainFile(folder_ / "heatmap_failures.png", kMaxResultBytes);
        !png.empty())
      still = PictureHtml({"The plan, what was driven, and where it failed", png});
    if (!record_.why_no_map().empty())
      note =
          "<p class=\"note\">The map cannot be read any more: " + MarkupText(record_.why_no_map()) +
          "</p>";
    if (!unread.empty()) note += "<p class=\"note\">" + MarkupText(unread) + "</p>";
    return TheaterHtml(still, note);
  }

  // Without its unit, which stands behind the value, unless that tells it from another.
  static std::string NameWithin(const MetricColumn& column) {
    const auto bare = [](const MetricColumn& of) {
      const auto cut = of.name.rfind('_');
      const bool has_unit = !of.unit.empty() && cut != of.name.npos && of.name.size() - cut <= 4;
      return std::string(has_unit ? of.name.substr(0, cut) : of.name);
    };
    const std::string name = bare(column);
    const bool twice =
        std::ranges::count_if(kMetrics, [&](const auto& other) { return bare(other) == name; }) > 1;
    return twice ? fmt::format("{} ({})", name, column.unit) : name;
  }

  std::string MetricsTable() const {
    std::string rows;
    for (const MetricColumn& column : kMetrics) {
      const auto value = Metric(std::string(column.name));
      if (!value || column.name.ends_with("_margin")) continue;  // those stand above
      if (!record_.estimates() && column.name.find("estimate") != column.name.npos) continue;
      const std::string name = NameWithin(column);
      const bool share = column.unit.empty() && column.help.find("share") != column.help.npos;
      const std::string text = share                ? PercentText(*value)
                               : column.unit == "J" ? EnergyText(*value)
                               : column.unit == "m" ? LengthText(*value)
                               : column.unit == "s" ? TimeText(*value)
                               : column.unit.empty()
                                   ? NumberText(*value)
                                   : NumberText(*value) + " " + std::string(column.unit);
      rows +=
          fmt::format("<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td>{}</td></tr>\n",
                      MarkupText(Words(name)), MarkupText(text), MarkupText(column.help));
    }
    return "<div class=\"card scroll\" tabindex=\"0\"><table><thead><tr><th "
           "scope=\"col\">Metric</th><th "
           "scope=\"col\" class=\"num\">Value</th><th scope=\"col\">What it is</th></tr></thead>"
           "<tbody>\n" +
           rows + "</tbody></table></div>\n";
  }

  // Each detector's least distance from failing, as a share of its limit.
  std::string Margins() const {
    const auto margins = record_.result().Find("margins");
    if (!margins || margins->is_null()) return "";
    std::string rows;
    for (const auto& [name, ignored] : margins->items()) {
      const auto share = Metric(name + "_margin");
      if (!share) continue;
      const double width = 100 * std::clamp(*share, 0.0, 1.0);
      rows += fmt::format(
          "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"plotted\"><div "
          "class=\"share\"><span style=\"width:{:.1f}%\" class=\"{}\"></span></div></td></tr>\n",
          MarkupText(Words(name)), PercentText(*share), width,
          *share < 0.1   ? "bad"
          : *share < 0.3 ? "warn"
                         : "good");
    }
    return "<div class=\"card\"><p class=\"note\">The least distance from failing, as a share of "
           "the limit: 100 % is as far as can be, 0 is at the limit, below 0 is beyond it.</p>"
           "<table><thead><tr><th scope=\"col\">Failure</th><th scope=\"col\" "
           "class=\"num\">Left</th><th scope=\"col\" "
           "class=\"plotted\"><span class=\"off\">As a bar</span></th></tr></thead><tbody>\n" +
           rows + "</tbody></table></div>\n";
  }

  std::string Film() {
    film_ = ReadPlainFile(folder_ / "video.mp4", kLargestFilm);
    std::string html;
    if (!film_.empty())
      html += fmt::format(
          "<div><video id=\"film-0\" controls preload=\"metadata\" src=\"{}\" "
          "aria-label=\"Film of the drive\"></video></div>\n",
          DataUri("video/mp4", film_));
    else if (std::error_code none; fs::exists(folder_ / "video.mp4", none))
      html += "<p>The film is too large for the page: <a href=\"video.mp4\">video.mp4</a></p>\n";
    const std::vector<ReportPicture> frames = PicturesIn(folder_, "frame_");
    html += PicturesHtml(frames);
    return html.empty() ? "" : "<div class=\"card\">" + html + "</div>\n";
  }

  std::string Settings() const {
    std::string html = "<dl>";
    if (const auto versions = record_.result().Find("versions"))
      for (const auto& [name, version] : versions->items())
        html += "<dt>" + MarkupText(name) + "</dt><dd>" + MarkupText(version.get<std::string>()) +
                "</dd>";
    html += fmt::format("<dt>seed</dt><dd>{}</dd></dl>\n",
                        record_.result().value("seed", std::int64_t{0}));
    if (const auto drawn = record_.result().Find("drawn"); drawn && !drawn->items().empty())
      html += "<details><summary>What was drawn</summary><pre>" +
              MarkupText(JsonText(drawn->json())) + "</pre></details>\n";
    return html + ScenarioDetails(record_.settings());
  }

  HtmlPage Page(const std::string& verdict) {
    HtmlPage page;
    page.over = "Floorproof run";
    page.title = Text("robot") + " on " + Text("site");
    page.about = Words(Text("outcome"));
    page.verdict = VerdictBox(verdict);
    const std::string film = Film();
    page.sections.push_back({"drive", "The drive", Theater(page)});
    if (const std::string margins = Margins(); !margins.empty())
      page.sections.push_back({"margins", "How near it was to failing", margins});
    page.sections.push_back({"metrics", "What was measured", MetricsTable()});
    if (!film.empty()) page.sections.push_back({"film", "Film", film});
    std::vector<ReportPicture> maps = PicturesIn(folder_, "heatmap_");
    for (ReportPicture& plot : PicturesIn(folder_, "plot_")) maps.push_back(std::move(plot));
    if (!maps.empty())
      page.sections.push_back(
          {"maps", "Maps and plots", "<div class=\"card\">" + PicturesHtml(maps) + "</div>\n"});
    page.sections.push_back({"settings", "Settings and versions", Settings()});
    page.footer =
        "<p class=\"note\">This page is complete in itself. Rows of trace.csv beyond 1,500 are "
        "left "
        "out of its curves.</p>";
    return page;
  }

  const fs::path& folder_;
  const std::string& named_;
  RunRecord record_;
  std::string film_;
};

}  // namespace

bool HoldsRun(const fs::path& folder) {
  std::error_code none;
  return fs::exists(folder / "result.json", none) && !fs::exists(folder / "campaign.sqlite", none);
}

RunPage MakeRunPage(const fs::path& folder, const std::string& named) {
  return Run(folder, named).Make();
}

WrittenReport WriteRunReport(const fs::path& folder, const std::string& named) {
  const RunPage made = MakeRunPage(folder, named);
  return WritePage(folder / "report.html",
                   {"page", [](std::string_view name) { return name == "report.html"; }},
                   made.verdict, made.html);
}

}  // namespace floorproof

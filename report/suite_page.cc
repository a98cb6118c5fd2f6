// SPDX-License-Identifier: Apache-2.0
#include "report/suite_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/input_file.h"
#include "base/params.h"
#include "base/quantity.h"
#include "base/shell_word.h"
#include "report/html.h"
#include "report/html_page.h"
#include "report/page_drives.h"
#include "run/scenario/override.h"
#include "stats/demonstration.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFilm = 8u << 20, kAllFilms = 48u << 20;  // in the page, bytes

constexpr const char* kSuiteStyle = R"css(
.films { display: grid; grid-template-columns: repeat(auto-fit, minmax(18rem, 1fr)); gap: 0 1.2rem; }
tbody th { min-width: 10.5rem; }
.result { min-width: 9rem; vertical-align: top; }
.meter { height: .45rem; margin-top: .3rem; border-radius: .25rem; background: var(--line); }
.meter i { display: block; height: 100%; border-radius: .25rem; background: var(--mark); }
.missed { color: var(--bad); } .fine { color: var(--good); } .nil { color: var(--soft); }
)css";

const MethodResult* Find(const RobotSuite& robot, std::string_view method) {
  const auto found = std::ranges::find(robot.methods, method, &MethodResult::method);
  return found == robot.methods.end() ? nullptr : &*found;
}

// What a bar shows: a size, or a measured figure.
std::optional<double> Shown(const MethodResult& result) {
  if (result.sizes) return result.size;
  return result.measures ? result.figure : std::nullopt;
}

bool LessIsBetter(const MethodResult& result) {
  return result.sizes ? result.sizes->smaller_is_harder() : result.measures.has_value();
}

// The methods that any robot has done, in the list's order.
std::vector<const PluginEntry<Method>*> Done(const SuiteReport& report) {
  std::vector<const PluginEntry<Method>*> done;
  for (const auto& entry : Methods())
    if (std::ranges::any_of(report.robots,
                            [&](const RobotSuite& r) { return Find(r, entry.name) != nullptr; }))
      done.push_back(&entry);
  return done;
}

std::string RobotNames(const SuiteReport& report, const char* between) {
  std::string names;
  for (const RobotSuite& robot : report.robots)
    names += (names.empty() ? "" : between) + robot.label;
  return names;
}

// What was set for every run, and so was not drawn; empty: nothing.
std::string SetText(const SuiteReport& report) {
  std::string text;
  for (const Override& o : report.options.overrides)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", o.key_path, o.value);
  return text.empty() ? "" : " Set for every run instead: " + text + ".";
}

std::string RobotVerdict(const SuiteReport& report, const RobotSuite& robot) {
  std::size_t asked = 0;
  std::string missed;
  for (const MethodResult& result : robot.methods) {
    asked += result.not_applicable.empty();
    if (const std::string why = WhyMissed(result, report.required); !why.empty())
      missed += fmt::format("{}{} ({})", missed.empty() ? "" : ", ", result.method, why);
  }
  std::string text = fmt::format("{}: {} driven", robot.label, CountText(asked, "method"));
  if (asked < robot.methods.size())
    text += fmt::format(", {} not applicable", robot.methods.size() - asked);
  text += missed.empty() ? "; every one as it must be." : "; missed: " + missed + ".";
  if (robot.methods.size() < report.asked)
    text += fmt::format(" Interrupted: {} of {} are not done.", report.asked - robot.methods.size(),
                        report.asked);
  return text;
}

std::string VerdictBox(const SuiteReport& report) {
  bool good = true;
  std::string list;
  for (const RobotSuite& robot : report.robots) {
    good = good && robot.methods.size() == report.asked &&
           std::ranges::all_of(robot.methods, [&](const MethodResult& r) {
             return WhyMissed(r, report.required).empty();
           });
    list += "<li>" + MarkupText(RobotVerdict(report, robot)) + "</li>";
  }
  const SuiteOptions& options = report.options;
  list +=
      "<li>" +
      MarkupText(
          fmt::format(
              "Each size and each pass is demonstrated by {} without a failure: {} of such runs "
              "pass, at {} confidence.",
              CountText(RunsToDemonstrate(options.reliability, options.confidence), "run"),
              PercentText(options.reliability), PercentText(options.confidence)) +
          SetText(report)) +
      "</li>";
  return fmt::format(
      "<div class=\"verdict {}\"><p>{}</p><ul>{}</ul></div>\n", good ? "passed" : "failed",
      !good                     ? "Not every method is as it must be."
      : report.required.empty() ? "Every method has its result; no size was required."
                                : "Every method is as it must be.",
      list);
}

std::string ResultCell(const SuiteReport& report, const MethodResult* result, double most) {
  if (result == nullptr) return "<td class=\"result nil\">not done</td>";
  const bool nil = !result->not_applicable.empty();
  const bool missed = !WhyMissed(*result, report.required).empty();
  std::string bar;
  if (const auto shown = Shown(*result); shown && most > 0)
    bar = fmt::format(
        "<div class=\"meter\" aria-hidden=\"true\"><i style=\"width:{:.1f}%\"></i></div>",
        100 * *shown / most);
  const std::string withdrawn = MarkupText(WithdrawnText(*result));
  return fmt::format("<td class=\"result\"><span class=\"{}\">{}</span>{}{}</td>",
                     missed ? "missed"
                     : nil  ? "nil"
                            : "fine",
                     MarkupText(ResultText(*result)), withdrawn.empty() ? "" : "<br>" + withdrawn,
                     bar);
}

std::string Table(const SuiteReport& report) {
  std::string html =
      "<div class=\"card scroll\" tabindex=\"0\"><table><thead><tr><th scope=\"col\">Method</th>";
  for (const RobotSuite& robot : report.robots)
    html += "<th scope=\"col\">" + MarkupText(robot.label) + "</th>";
  html += "<th scope=\"col\">What it tests</th></tr></thead><tbody>\n";
  for (const auto* entry : Done(report)) {
    double most = 0;
    bool less = false;
    std::string cells;
    for (const RobotSuite& robot : report.robots)
      if (const MethodResult* result = Find(robot, entry->name)) {
        most = std::max(most, Shown(*result).value_or(0));
        less = less || LessIsBetter(*result);
      }
    if (report.robots.size() == 1) most = 0;  // a bar says nothing alone
    for (const RobotSuite& robot : report.robots)
      cells += ResultCell(report, Find(robot, entry->name), most);
    html += fmt::format(
        "<tr><th scope=\"row\"><a href=\"#{0}\">{0}</a></th>{1}<td>{2}{3}</td></tr>\n", entry->name,
        cells, MarkupText(entry->help), less ? " <span class=\"nil\">(less is better)</span>" : "");
  }
  return html + "</tbody></table></div>\n";
}

// The runs that were filmed: their films among the methods, and each as a drive of the page.
class FilmShelf {
 public:
  FilmShelf(fs::path folder, HtmlPage& page) : folder_(std::move(folder)), drives_(page) {}

  // Empty where there is none.
  std::string Film(const RobotSuite& robot, const MethodResult& result) {
    const fs::path path = FilmFolder(robot, result.method) / "video.mp4", file = folder_ / path;
    // A film that an earlier suite left shows another run.
    if (std::ranges::find(robot.filmed, result.method) == robot.filmed.end()) return "";
    const std::uintmax_t size = fs::file_size(file);
    const SuiteRun& run = result.runs[result.shown];
    const std::string caption = fmt::format(
        "{}, run {}{}: {}", robot.label, run.run,
        result.sizes ? fmt::format(" at {} {}", NumberText(run.size), result.sizes->unit) : "",
        run.verdict.passed ? "passed" : run.verdict.why);
    std::string film;
    const bool embedded = size <= kLargestFilm && embedded_ + size <= kAllFilms;
    const std::size_t number = drives_.size();
    AddDrive(file.parent_path(), path.parent_path(), caption, embedded);
    if (embedded) {
      embedded_ += size;
      film = fmt::format(
          "<video id=\"film-{}\" controls preload=\"metadata\" src=\"{}\" "
          "aria-label=\"{}\"></video>",
          number, DataUri("video/mp4", ReadInputFile(file, kLargestFilm)),
          MarkupText("Film. " + caption));
    } else {
      linked_ += (linked_.empty() ? "" : ", ") + path.generic_string();
      film = fmt::format("<a href=\"{}\">{}</a>", UrlPath(path.generic_string()),
                         MarkupText(path.generic_string()));
    }
    return fmt::format("<figure><div>{}</div><figcaption>{}</figcaption></figure>\n", film,
                       MarkupText(caption));
  }
  const std::string& linked() const { return linked_; }

  // For the page's scripts, once all films are in it. Returns where they show them.
  std::string Theater() {
    if (drives_.size() == 0) return "";
    drives_.Finish();
    return TheaterHtml();
  }

 private:
  void AddDrive(const fs::path& folder, const fs::path& named, const std::string& caption,
                bool filmed) {
    try {
      drives_.Add(RunRecord(folder), caption,
                  "floorproof run " + ShellWord((named / kRunFile).generic_string()) + " --video",
                  filmed);
    } catch (const InputError&) {
      if (filmed) drives_.AddFilm(caption);  // without its record it is no more
    }
  }

  fs::path folder_;
  PageDrives drives_;
  std::uintmax_t embedded_ = 0;
  std::string linked_;
};

std::string MethodCard(const SuiteReport& report, const PluginEntry<Method>& entry,
                       FilmShelf& films) {
  const auto method = entry.make();
  std::string html = fmt::format(
      "<article class=\"card\" id=\"{0}\"><h3>{0}</h3>\n<p>{1}</p>\n<p class=\"note\">Shaped after "
      "{2}.</p>\n",
      entry.name, MarkupText(method->task()), MarkupText(method->shaped_after()));
  std::string shown;
  for (const RobotSuite& robot : report.robots) {
    const MethodResult* result = Find(robot, entry.name);
    if (result == nullptr) continue;
    html += fmt::format("<p>{}<strong>{}</strong>. {}</p>\n",
                        report.robots.size() > 1 ? MarkupText(robot.label) + ": " : "",
                        MarkupText(ResultText(*result)),
                        MarkupText(ResultSentence(*result, report.options)));
    shown += films.Film(robot, *result);
  }
  if (!shown.empty()) html += "<div class=\"films\">" + shown + "</div>\n";
  return html + "</article>\n";
}

std::string HowText(const SuiteReport& report) {
  return fmt::format(
      "<p>Runs are drawn from one population: {}.{} Run i has the same draws at every size and for "
      "every robot (seed {}). A size counts when all runs pass it and no easier one that was tried "
      "fails; a harder one was tried, and a run failed it, but for sizes at the ladder's end (\"or "
      "more\", \"or less\"). Methods "
      "are shaped after tests of the standards that they name: they "
      "have their idea, not their apparatus, and nothing here conforms to a standard.</p>\n",
      MarkupText(PopulationText()), MarkupText(SetText(report)), report.options.seed);
}

}  // namespace

std::string SuitePage(const SuiteReport& report, const fs::path& folder) {
  HtmlPage page;
  FilmShelf films(folder, page);
  std::string cards;
  for (const auto* entry : Done(report)) cards += MethodCard(report, *entry, films);
  const std::string stands =
      films.linked().empty()
          ? "This page is complete in itself: everything it shows stands in this one file."
          : "Everything this page shows stands in this one file, except films too large for it, "
            "which lie beside it: " +
                films.linked() + ".";
  const std::string theater = films.Theater();
  page.over = "Floorproof suite";
  page.title = RobotNames(report, " and ");
  page.about = "test methods";
  page.extra_style = kSuiteStyle;
  page.verdict = VerdictBox(report);
  page.sections = {{"results", "Results", Table(report) + theater},
                   {"methods", "Methods", cards},
                   {"how", "How it was tested", HowText(report)}};
  page.footer = "<p class=\"note\">" + MarkupText(stands) + "</p>";
  return page.Html();
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/comma_list.h"
#include "base/interrupt.h"
#include "base/progress_line.h"
#include "base/quantity.h"
#include "base/usable_cores.h"
#include "report/suite_films.h"
#include "stats/demonstration.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

struct SuiteCommand {
  std::vector<std::string> robots;
  std::string methods, required;  // with commas between
  std::optional<double> reliability, confidence;
  std::uint64_t seed = 0;
  int jobs = 0;
  std::string out;
  bool no_films = false;
};

std::vector<const PluginEntry<Method>*> Asked(const std::string& text) {
  const std::vector<std::string> names = SplitAtCommas(text);
  for (const std::string& name : names) MakePlugin(Methods(), name, "--methods");
  std::vector<const PluginEntry<Method>*> asked;
  for (const auto& entry : Methods())
    if (names.empty() || std::ranges::find(names, entry.name) != names.end())
      asked.push_back(&entry);
  return asked;
}

std::vector<RobotSuite> NamedRobots(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 6;  // columns of the page
  if (names.size() > kMost)
    throw InputError({"ROBOT", 0}, "", names[kMost], "is one robot more than six");
  std::vector<RobotSuite> robots;
  for (const std::string& name : names) {
    const fs::path file = FindRobotFile(name, {"ROBOT", 0});
    RobotSuite suite;
    suite.robot = file == name ? fs::absolute(file).string() : name;
    suite.label = file == name ? file.stem().string() : name;
    if (suite.label.starts_with('.') || SuiteResults().has(suite.label))
      throw InputError({"ROBOT", 0}, "", name,
                       "its films' folder would be named " + suite.label + ": rename the file");
    if (std::ranges::find(robots, suite.label, &RobotSuite::label) != robots.end())
      throw InputError({"ROBOT", 0}, "", name, "another robot is named so, too");
    robots.push_back(std::move(suite));
  }
  return robots;
}

// Each is read once: what all of its methods start from.
std::vector<RobotModel> Models(const std::vector<RobotSuite>& robots) {
  std::vector<RobotModel> models;
  for (const RobotSuite& robot : robots)
    models.push_back(ReadRobot(FindRobotFile(robot.robot, {})));
  return models;
}

fs::path Folder(const std::string& out, const std::vector<RobotSuite>& robots) {
  if (!out.empty()) return out;
  std::string name;
  for (const RobotSuite& robot : robots) name += (name.empty() ? "" : "_") + robot.label;
  return fs::path("out/suite") / name;
}

SuiteReport Request(const SuiteCommand& options, const Globals& globals) {
  SuiteReport report;
  report.options = {.reliability = options.reliability.value_or(0.95),
                    .confidence = options.confidence.value_or(0.95),
                    .seed = options.seed,
                    .jobs = options.jobs > 0 ? options.jobs : UsableCores(),
                    .overrides = globals.Overrides()};
  RunsToDemonstrate(report.options.reliability, report.options.confidence);  // refuses
  const auto asked = Asked(options.methods);
  report.asked = asked.size();
  for (const std::string& text : SplitAtCommas(options.required)) {
    report.required.push_back(ReadRequirement(text));
    if (std::ranges::none_of(
            asked, [&](const auto* entry) { return entry->name == report.required.back().method; }))
      throw InputError({"--require", 0}, "", text, "its method is not among --methods");
    if (std::ranges::count(report.required, report.required.back().method,
                           &SuiteRequirement::method) > 1)
      throw InputError({"--require", 0}, "", text, "is asked of this method already");
  }
  report.robots = NamedRobots(options.robots);
  return report;
}

// Lays out and reads one run of each method: what is wrong with one costs no drive. A robot of whom
// nothing can be asked is refused, for a gate that asks nothing would always be green.
void CheckMethods(const SuiteReport& report, const std::vector<RobotModel>& models,
                  const std::string& methods) {
  const auto asked = Asked(methods);
  for (std::size_t i = 0; i < models.size(); ++i) {
    const RobotSuite& robot = report.robots[i];
    RefuseBeyondLadders(report.required, models[i]);
    if (std::ranges::none_of(
            asked, [&](const auto* entry) { return entry->make()->WhyNot(models[i]).empty(); }))
      throw InputError({"--methods", 0}, "", methods,
                       fmt::format("nothing of this can be asked of {}: {}", robot.label,
                                   asked.front()->make()->WhyNot(models[i])));
    for (const auto* entry : asked) CheckMethod(*entry, models[i], robot.robot, report.options);
  }
}

// Runs a method and adds what came of it; false when interrupted.
bool Run(const PluginEntry<Method>& entry, const RobotModel& model, const SuiteReport& report,
         RobotSuite& robot, const Globals& globals) {
  ProgressLine line(globals);
  auto result = RunMethod(entry, model, robot.robot, report.options, [&](const SuiteProgress& now) {
    if (line.IsDue())
      line.Show(fmt::format("  {} {}, {} of {}: {} of {} driven, {} in all", robot.label,
                            now.method, robot.methods.size() + 1, CountText(report.asked, "method"),
                            now.driven, CountText(now.asked, "run"), now.driven_in_all));
  });
  if (!result) return false;
  line.Clear();
  const std::string missed = WhyMissed(*result, report.required);
  // Said as they come, so their columns are wide enough for most.
  TextTable row({{.least = 10}, {.least = 18}, {.least = 18}, {.wraps = true}});
  row.Add({robot.label, std::string(entry.name), ResultText(*result),
           missed.empty() ? TextCell(WithdrawnText(*result))
                          : TextCell("MISSED: " + missed, Tone::kBad)});
  globals.Say(row);
  robot.methods.push_back(std::move(*result));
  return true;
}

int RunSuiteMethods(const SuiteCommand& options, const Globals& globals) {
  SuiteReport report = Request(options, globals);
  const std::vector<RobotModel> models = Models(report.robots);
  CheckMethods(report, models, options.methods);
  const fs::path folder = Folder(options.out, report.robots);
  ResultFolder out(folder, SuiteResults(), {});
  out.Begin();
  SayWhenInterrupted("the methods that were done are in " + folder.string());
  const HoldInterrupts hold;
  const int n = RunsToDemonstrate(report.options.reliability, report.options.confidence);
  globals.Say(fmt::format("{} of {}; {} each: {}", CountText(report.asked, "method"),
                          CountText(report.robots.size(), "robot"), CountText(n, "run"),
                          PopulationText()));
  WriteSuiteFiles(report, folder);  // what an earlier suite left does not stand for this one
  for (const auto* entry : Asked(options.methods))
    for (std::size_t i = 0; i < models.size(); ++i) {
      RobotSuite& robot = report.robots[i];
      if (!Run(*entry, models[i], report, robot, globals)) throw Interruption();
      WriteSuiteFiles(report, folder);
      if (!options.no_films && robot.methods.back().not_applicable.empty()) {
        FilmMethod(robot, models[i], robot.methods.back(), report.options, folder);
        robot.filmed.emplace_back(entry->name);
        WriteSuiteFiles(report, folder);
      }
      if (Interrupted()) throw Interruption();
    }
  out.RequireInPlace({"suite.json", "runs.csv"});
  globals.Result(SuiteJson(report));
  globals.Say("the page is " + (folder / "report.html").string());
  for (const RobotSuite& robot : report.robots)
    for (const MethodResult& result : robot.methods)
      if (!WhyMissed(result, report.required).empty()) return kExitNotSuccess;
  return kExitDone;
}

}  // namespace

void AddSuite(CommandLine& line, const Globals& globals, int& status) {
  auto options = std::make_shared<SuiteCommand>();
  Subcommand command =
      line.Add("suite",
               "Test methods over and over on a robot: the largest size of each that it passes, "
               "demonstrated; several robots side by side");
  command.Texts("ROBOT", options->robots, "Names of `floorproof list robots`, or files (.xml)",
                Subcommand::Need::kRequired);
  command.Number("--reliability", options->reliability,
                 "Share of runs that must pass (default: 0.95)", 0, 1);
  command.Number("--confidence", options->confidence,
                 "At which that is demonstrated (default: 0.95)", 0, 1);
  command.Text("--methods", options->methods, "Only these, with commas between (default: all)");
  command.Text("--require", options->required,
               "METHOD=VALUE, with commas between: sizes that must be reached, figures that must "
               "not be exceeded");
  command.Integer("--seed", options->seed, "Of all draws (default: 0)", 0, 2147483647);
  command.Integer("--jobs", options->jobs, "Threads (default: one a core)", 1, 1024);
  command.Text("--out", options->out, "Output folder (default: out/suite/ROBOT)");
  command.Flag("--no-films", options->no_films, "Do not film");
  command.OnRun([options, &globals, &status] { status = RunSuiteMethods(*options, globals); });
}

}  // namespace floorproof

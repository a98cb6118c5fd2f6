// SPDX-License-Identifier: Apache-2.0
#include "report/suite_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/markup.h"
#include "base/params.h"
#include "base/printable.h"
#include "report/suite_page.h"
#include "run/episode/records.h"
#include "run/scenario/override.h"
#include "stats/demonstration.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kDegree = kPi / 180;

template <class T>
std::string OrEmpty(const std::optional<T>& value) {
  return value ? FormatDouble(*value) : "";
}

std::string Unit(const MethodResult& result) {
  return result.sizes ? std::string(result.sizes->unit) : "";
}

// Calls see(robot, method) for each that is done.
template <class See>
void ForEachMethod(const SuiteReport& report, const See& see) {
  for (const RobotSuite& robot : report.robots)
    for (const MethodResult& method : robot.methods) see(robot, method);
}

Json MethodJson(const SuiteReport& report, const MethodResult& result) {
  Json json = {{"method", result.method}, {"verdict", VerdictWord(result)}};
  if (!result.not_applicable.empty()) {
    json["why"] = result.not_applicable;
    return json;
  }
  const auto or_null = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  if (result.sizes) {
    json["size"] = or_null(result.size);
    json["unit"] = result.sizes->unit;
    json["size_is"] = result.sizes->what;
    json["or_harder"] = result.above_all;
    json["easier_runs"] = result.easier;
    json["fails_at"] = or_null(FailsAt(result));
    json["withdrawn"] = or_null(result.withdrawn);
  }
  if (result.measures) {
    json["figure"] = or_null(result.figure);
    json["figure_unit"] = result.measures->unit;
  }
  json["n"] = result.n;
  json["failures"] = result.failures;
  json["reliability_lower"] = result.reliability_lower;
  json["runs"] = result.runs.size();
  json["simulated_s"] = result.simulated_s;
  json["text"] = ResultSentence(result, report.options);
  if (const std::string why = WhyMissed(result, report.required); !why.empty())
    json["missed"] = why;
  return json;
}

// What was set for every run, and so was not drawn.
Json SetJson(const SuiteOptions& options) {
  Json set = Json::object();
  for (const Override& o : options.overrides) set[o.key_path] = o.value;
  return set;
}

std::string JunitCase(const SuiteReport& report, const RobotSuite& robot,
                      const MethodResult& result) {
  const std::string why = MarkupText(WhyMissed(result, report.required));
  std::string verdict;
  if (!why.empty())
    verdict = fmt::format("      <failure message=\"{0}\">{0}</failure>\n", why);
  else if (!result.not_applicable.empty())
    verdict = fmt::format("      <skipped message=\"{}\"/>\n", MarkupText(result.not_applicable));
  return fmt::format(
      "    <testcase classname=\"suite.{}\" name=\"{}\" time=\"{:.3f}\">\n{}      "
      "<system-out>{}</system-out>\n    </testcase>\n",
      MarkupText(robot.label), result.method, result.simulated_s, verdict,
      MarkupText(ResultSentence(result, report.options)));
}

}  // namespace

ResultNames SuiteResults() {
  return {"suite", [](std::string_view name) {
            constexpr std::array<std::string_view, 5> kNames = {
                "suite.json", "suite.csv", "runs.csv", "junit.xml", "report.html"};
            return std::ranges::find(kNames, name) != kNames.end();
          }};
}

std::string SuiteCsv(const SuiteReport& report) {
  std::string csv =
      "robot,method,verdict,size,unit,or_harder,fails_at,withdrawn,figure,figure_unit,n,failures,"
      "reliability_lower,missed\n";
  ForEachMethod(report, [&](const RobotSuite& robot, const MethodResult& r) {
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", CsvField(robot.label),
                       r.method, VerdictWord(r), OrEmpty(r.size), Unit(r), r.above_all ? 1 : 0,
                       OrEmpty(FailsAt(r)), OrEmpty(r.withdrawn), OrEmpty(r.figure),
                       r.measures ? std::string(r.measures->unit) : "", r.n, r.failures,
                       FormatDouble(r.reliability_lower), CsvField(WhyMissed(r, report.required)));
  });
  return csv;
}

std::string SuiteRunsCsv(const SuiteReport& report) {
  std::string csv =
      "robot,method,size,unit,run,friction,mass_kg,angle_deg,offset_m,speed_share,bearing_deg,"
      "passed,why,figure,figure_unit,duration_s\n";
  ForEachMethod(report, [&](const RobotSuite& robot, const MethodResult& r) {
    for (const SuiteRun& run : r.runs)
      csv += fmt::format(
          "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", CsvField(robot.label), r.method,
          r.sizes ? FormatDouble(run.size) : "", Unit(r), run.run, FormatDouble(run.friction),
          FormatDouble(run.mass_kg), FormatDouble(run.draw.angle_rad / kDegree),
          FormatDouble(run.draw.offset_m), FormatDouble(run.draw.speed_share),
          FormatDouble(run.draw.bearing_rad / kDegree), run.verdict.passed ? 1 : 0,
          CsvField(run.verdict.why), OrEmpty(run.verdict.figure),
          r.measures ? std::string(r.measures->unit) : "", FormatDouble(run.duration_s));
  });
  return csv;
}

std::string SuiteJunit(const SuiteReport& report) {
  std::string suites;
  std::size_t tests = 0, failures = 0, skipped = 0;
  for (const RobotSuite& robot : report.robots) {
    std::string cases;
    std::size_t missed = 0, passed_over = 0;
    double time_s = 0;
    for (const MethodResult& result : robot.methods) {
      cases += JunitCase(report, robot, result);
      const bool misses = !WhyMissed(result, report.required).empty();
      missed += misses;
      passed_over += !misses && !result.not_applicable.empty();
      time_s += result.simulated_s;
    }
    suites += fmt::format(
        "  <testsuite name=\"suite.{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\" "
        "time=\"{:.3f}\">\n{}  </testsuite>\n",
        MarkupText(robot.label), robot.methods.size(), missed, passed_over, time_s, cases);
    tests += robot.methods.size();
    failures += missed;
    skipped += passed_over;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{}\" failures=\"{}\" "
      "errors=\"0\" skipped=\"{}\">\n{}</testsuites>\n",
      tests, failures, skipped, suites);
}

Json SuiteJson(const SuiteReport& report) {
  const SuiteOptions& options = report.options;
  Json required = Json::object();
  for (const SuiteRequirement& r : report.required) required[r.method] = r.value;
  Json robots = Json::array();
  for (const RobotSuite& robot : report.robots) {
    Json methods = Json::array();
    for (const MethodResult& result : robot.methods) methods.push_back(MethodJson(report, result));
    robots.push_back({{"robot", robot.label},
                      {"whole", robot.methods.size() == report.asked},
                      {"methods", std::move(methods)}});
  }
  return {{"schema", 1},
          {"reliability", options.reliability},
          {"confidence", options.confidence},
          {"n", RunsToDemonstrate(options.reliability, options.confidence)},
          {"seed", options.seed},
          {"population", PopulationText()},
          {"set", SetJson(options)},
          {"required", std::move(required)},
          {"robots", std::move(robots)},
          {"versions", VersionsJson()}};
}

fs::path FilmFolder(const RobotSuite& robot, std::string_view method) {
  return fs::path(robot.label) / method;
}

void WriteSuiteFiles(const SuiteReport& report, const fs::path& folder) {
  WriteFileWhole(folder / "runs.csv", SuiteRunsCsv(report));
  WriteFileWhole(folder / "suite.csv", SuiteCsv(report));
  WriteFileWhole(folder / "junit.xml", SuiteJunit(report));
  WriteFileWhole(folder / "report.html", SuitePage(report, folder));
  WriteFileWhole(folder / "suite.json", JsonText(SuiteJson(report)) + "\n");
}

}  // namespace floorproof

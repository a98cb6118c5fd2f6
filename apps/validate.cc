// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/ladder.h"
#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/quantity.h"
#include "base/result_folder.h"
#include "base/usable_cores.h"
#include "report/ladder_files.h"
#include "validate/bounce_chart.h"
#include "validate/law.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

void SayLaw(const LawResult& result, const Globals& globals) {
  TextTable table({{.heading = "Law", .least = 44},
                   {.heading = "Expected", .right = true, .least = 12},
                   {.heading = "Measured", .right = true, .least = 12},
                   {.heading = "Tolerance", .right = true},
                   {.heading = "Unit", .least = 6},
                   {.heading = "Holds"}});
  table.SetTitle(result.name + ": " + result.statement);
  for (const LawRow& row : result.rows)
    table.Add({row.law, NumberText(row.expected, 5), NumberText(row.measured, 5),
               NumberText(row.tolerance, 2), row.unit,
               row.ok() ? TextCell("ok") : TextCell("FAILS", Tone::kBad)});
  globals.Say(table);
}

// The ladder's files among them.
ResultNames LawResults() {
  return {"laws", [](std::string_view name) {
            return name == "validate.csv" || name == "bounce.csv" || IsLadderFile(name);
          }};
}

// Returns how many comparisons failed; `json_result` gets the rows.
int CheckAllLaws(const fs::path& folder, const Globals& globals,
                 nlohmann::ordered_json& json_result) {
  const auto results =
      CheckLaws(UsableCores(), [&](const LawResult& result) { SayLaw(result, globals); });
  WriteFileWhole(folder / "validate.csv", ValidateCsv(results));
  if (Interrupted()) return 0;
  SayWhenInterrupted("the laws are in " + folder.string());
  const auto bounces = BounceChart(UsableCores());
  if (Interrupted()) return 0;
  WriteFileWhole(folder / "bounce.csv", BounceCsv(bounces));
  int rows = 0, failed = 0;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const auto& result : results)
    for (const auto& row : result.rows) {
      ++rows;
      failed += !row.ok();
      json.push_back({{"law", row.law},
                      {"expected", row.expected},
                      {"measured", row.measured},
                      {"tolerance", row.tolerance},
                      {"unit", row.unit},
                      {"ok", row.ok()}});
    }
  json_result["laws"] = std::move(json);
  json_result["failed"] = failed;
  globals.Say(failed == 0 ? fmt::format("{} of {} comparisons hold", rows, rows)
                          : fmt::format("{} of {} comparisons fail", failed, rows));
  return failed;
}

}  // namespace

void AddValidate(CommandLine& line, const Globals& globals, int& status) {
  struct Options {
    std::string out = "out/validate";
    bool ladder = false;
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add(
      "validate", "Compare the physics with closed-form laws; measure what each robot can cross");
  command.Text("--out", options->out, "Output folder (default: out/validate)");
  command.Flag("--ladder", options->ladder,
               "Also find the largest hazards that each robot crosses: the capability charts (some "
               "20 minutes on two cores)");
  command.OnRun([options, &globals, &status] {
    const fs::path folder = options->out;
    ResultFolder out(folder, LawResults(), {});
    out.Begin();
    // What an earlier run left does not stand for this one; and a full disk shows at once.
    WriteFileWhole(folder / "validate.csv", ValidateCsv({}));
    WriteFileWhole(folder / "bounce.csv", BounceCsv({}));
    if (options->ladder) ClearLadder(folder);
    SayWhenInterrupted("the laws that were done are in " + folder.string());
    const HoldInterrupts hold;
    nlohmann::ordered_json result;
    const int failed = CheckAllLaws(folder, globals, result);
    if (Interrupted()) throw Interruption();
    if (options->ladder) {
      result["ladder"] = RunLadder(folder, UsableCores(), globals);
      if (Interrupted()) throw Interruption();
    }
    globals.Result(result);
    globals.SayFact("Results", folder.string());
    if (failed > 0) status = kExitNotSuccess;
  });
}

}  // namespace floorproof

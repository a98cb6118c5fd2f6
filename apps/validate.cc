// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <thread>

#include "apps/command.h"
#include "env/core/interrupt.h"
#include "env/run/file_output.h"
#include "env/validate/bounce_chart.h"
#include "env/validate/law.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

int Cores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void SayLaw(const LawResult& result, const Globals& globals) {
  globals.Say(fmt::format("{}: {}", result.name, result.statement));
  for (const LawRow& row : result.rows)
    globals.Say(fmt::format("  {:<44} {:>12.5g} {:>12.5g} {:>10.2g} {:<6} {}", row.law,
                            row.expected, row.measured, row.tolerance, row.unit,
                            row.ok() ? "ok" : "FAILS"));
}

int CheckAllLaws(const fs::path& folder, const Globals& globals) {
  globals.Say(fmt::format("  {:<44} {:>12} {:>12} {:>10} {}", "law", "expected", "measured",
                          "tolerance", "unit"));
  const auto results =
      CheckLaws(Cores(), [&](const LawResult& result) { SayLaw(result, globals); });
  if (Interrupted()) return 0;
  const auto bounces = BounceChart(Cores());
  if (Interrupted()) return 0;
  WriteFileWhole(folder / "validate.csv", ValidateCsv(results));
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
  globals.Result({{"laws", std::move(json)}, {"failed", failed}});
  globals.Say(failed == 0 ? fmt::format("{} of {} comparisons hold", rows, rows)
                          : fmt::format("{} of {} comparisons fail", failed, rows));
  return failed;
}

}  // namespace

void AddValidate(CLI::App& app, const Globals& globals, int& status) {
  auto out = std::make_shared<std::string>("out/validate");
  CLI::App* command =
      app.add_subcommand("validate", "Compare the physics with closed-form laws, as a table");
  command->add_option("--out", *out, "Output folder (default: out/validate)");
  command->callback([out, &globals, &status] {
    const fs::path folder = *out;
    MakeFolder(folder);
    SayWhenInterrupted("nothing is written");
    const HoldInterrupts hold;
    const int failed = CheckAllLaws(folder, globals);
    if (Interrupted()) EndInterrupted();
    globals.Say("results are in " + folder.string());
    if (failed > 0) status = kNotSuccess;
  });
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A run's result folder from elsewhere, read as `report` and `replay` do: the page is made of it.
// The input is several files: each begins with a line "=== NAME".
#include <array>

#include "fuzz/read_or_refuse.h"
#include "report/page_data.h"
#include "report/replay.h"
#include "report/run_page.h"
#include "run/campaign/summary_json.h"

namespace floorproof {
namespace {

constexpr std::array kNames = {"result.json", "trace.csv",  "safety.csv",   "visits.pgm",
                               "video.json",  "replay.bin", "summary.json", "plan.csv"};
constexpr std::string_view kResult = R"({"outcome": "success", "events": [], "metrics": {}})";

// The file of this name; none if the input has no such file.
std::optional<std::string_view> FileIn(std::string_view input, const std::string& name) {
  const std::string begin = "=== " + name + "\n";
  std::size_t at = input.find(begin);
  if (at == input.npos) return std::nullopt;
  at += begin.size();
  return input.substr(at, input.find("\n=== ", at) - at);
}

}  // namespace
}  // namespace floorproof

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floorproof;
  const std::string_view input = View(data, size);
  for (const char* name : kNames)
    if (const auto bytes = FileIn(input, name))
      Save(name, *bytes);
    else
      std::filesystem::remove(Folder() / name);
  if (!FileIn(input, "result.json")) Save("result.json", kResult);
  ReadOrRefuse([&] { MakeRunPage(Folder(), "out/run"); });
  // What is read only where the scenario can be, too.
  if (const auto visits = FileIn(input, "visits.pgm"))
    if (const auto read = ReadVisits(*visits)) PageText(VisitsData(*read));
  if (const auto safety = FileIn(input, "safety.csv")) PageText(SafetyData(*safety, "clean"));
  if (FileIn(input, "summary.json")) ReadOrRefuse([&] { ReadSummary(Folder() / "summary.json"); });
  return 0;
}

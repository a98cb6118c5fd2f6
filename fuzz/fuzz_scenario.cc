// SPDX-License-Identifier: Apache-2.0
// A scenario file, beside a small site.yaml and plan.csv that it may name. One that is read must
// survive being resolved.
#include "fuzz/read_or_refuse.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"

namespace {

constexpr const char* kSite =
    "site: 1\ngrid: {rows: \"....\\n.#..\\n....\"}\nstart: {x_m: 0.6, y_m: 0.6, yaw_deg: 0}\n";
constexpr const char* kPlan = "x_m,y_m\n0.3,0.3\n0.6,0.3\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floorproof;
  static const bool once_only = [] {
    unsetenv("FLOORPROOF_MODELS");
    Save("site.yaml", kSite);
    Save("plan.csv", kPlan);
    return true;
  }();
  static_cast<void>(once_only);
  const auto file = Save("scenario.yaml", View(data, size));
  std::string once;
  ReadOrRefuse([&] { once = ResolvedScenario(ReadScenario(file), Folder()); });
  if (once.empty()) return 0;
  try {
    const auto again = Save("resolved.yaml", once);
    if (ResolvedScenario(ReadScenario(again), Folder()) != once)
      Finding("resolved twice it differs:\n" + once);
  } catch (const InputError& e) {
    Finding(std::string("its resolved form is refused: ") + e.what() + "\n" + once);
  }
  return 0;
}

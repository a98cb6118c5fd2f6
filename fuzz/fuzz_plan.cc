// SPDX-License-Identifier: Apache-2.0
// A plan.csv. One that is read must be the same when written and read once more.
#include "fuzz/read_or_refuse.h"
#include "run/scenario/plan_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floorproof;
  const GridFrame map{200, 100, 0.05, {-1, -2, 0.1}};
  const auto file = Save("plan.csv", View(data, size));
  Path path;
  ReadOrRefuse([&] { path = ReadPlan(file, map); });
  if (path.empty()) return 0;
  const std::string once = PlanCsv(path);
  try {
    if (PlanCsv(ReadPlan(Save("again.csv", once), map)) != once)
      Finding("written and read again it differs:\n" + once);
  } catch (const InputError& e) {
    Finding(std::string("written, it is refused: ") + e.what() + "\n" + once);
  }
  return 0;
}

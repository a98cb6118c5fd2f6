// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <mutex>

#include "base/params.h"
#include "validate/law.h"
#include "validate/parallel.h"

namespace floorproof {

std::vector<LawResult> CheckLaws(int jobs, const std::function<void(const LawResult&)>& on_done) {
  const auto laws = Laws();
  std::vector<LawResult> results(laws.size());
  std::mutex one_at_a_time;
  RunParallel(static_cast<int>(laws.size()), jobs, [&](int i) {
    const auto& entry = laws[static_cast<std::size_t>(i)];
    const auto law = entry.make();
    LawResult& result = results[static_cast<std::size_t>(i)];
    result.name = entry.name;
    result.statement = law->statement();
    law->Check({}, result.rows);
    const std::lock_guard lock(one_at_a_time);
    if (on_done) on_done(result);
  });
  return results;
}

std::string ValidateCsv(std::span<const LawResult> results) {
  std::string out = "law,expected,measured,tolerance,unit,ok\n";
  for (const auto& result : results)
    for (const auto& row : result.rows)
      out += fmt::format("{},{},{},{},{},{}\n", row.law, FormatDouble(row.expected),
                         FormatDouble(row.measured), FormatDouble(row.tolerance), row.unit,
                         row.ok() ? 1 : 0);
  return out;
}

}  // namespace floorproof

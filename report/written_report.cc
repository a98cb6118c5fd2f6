// SPDX-License-Identifier: Apache-2.0
#include "report/written_report.h"

#include "base/file_output.h"

namespace floorproof {

WrittenReport WritePage(const std::filesystem::path& page, const ResultNames& names,
                        const std::string& verdict, const std::string& html) {
  ResultFolder results(page.parent_path(), names, {});
  results.Begin();
  WriteFileWhole(page, html);
  return {page, verdict, html.size(), {}};
}

}  // namespace floorproof

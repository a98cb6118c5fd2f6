// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_report.h"

#include "base/file_output.h"
#include "base/result_folder.h"
#include "report/campaign_page.h"
#include "report/page.h"
#include "report/verdict.h"

namespace floorproof {

WrittenReport WriteCampaignReport(const std::filesystem::path& folder, const std::string& named,
                                  const Console& console) {
  ResultFolder out(folder, PageResults(), {});
  const Report report = GatherReport(folder, named, out, console);
  const std::string html = ReportHtml(report);
  WrittenReport written{folder / "report.html", VerdictText(report), html.size(), {}};
  WriteFileWhole(written.page, html);
  for (const ReportFilm& film : report.films)
    if (film.mp4.empty()) written.linked.push_back(film.path);
  return written;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/experts_table.h"

#include <fmt/format.h>

#include <vector>

#include "base/config.h"
#include "base/params.h"
#include "base/words.h"
#include "env/core/event.h"
#include "planners/risk/fmea_tables.h"
#include "report/html.h"

namespace floorproof {
namespace {

const ConfigNode& At(const ConfigNode& node, const std::string& key) {
  if (const ConfigNode* found = node.Find(key)) return *found;
  throw InputError(node.mark, key, "", "is missing: not a file of floorproof measure");
}

double Share(const ConfigNode& node, const std::string& key) {
  return AsDouble(At(node, key), key, Between(0, 1));
}

std::string Cell(const ConfigNode& share) {
  const std::string experts = "experts " + PercentText(Share(share, "experts"));
  if (share.Find("k") == nullptr) return "<td>–<small>" + experts + "</small></td>";
  const bool excluded = AsBool(At(share, "excluded"), "excluded");
  return fmt::format("<td style=\"--share:{:.0f}%\">{}<small>{}</small><small{}>{}{}</small></td>",
                     100 * Share(share, "p"), PercentText(Share(share, "p")),
                     PercentText(Interval{Share(share, "lower"), Share(share, "upper")}),
                     excluded ? " class=\"apart\"" : "", excluded ? "≠ " : "", experts);
}

struct Grid {
  const char* caption;
  const char *list, *row;  // key of the rows, and what each begins with: C1, C2, ..
  int rows = 0;
  const char *shares, *column;  // likewise
  std::vector<std::string> columns;
};

std::string Table(const ConfigNode& file, const Grid& grid) {
  std::string html = fmt::format(
      "<div class=\"card scroll\" tabindex=\"0\"><h3>{}</h3>\n<table "
      "class=\"grid\"><thead><tr><td></td>",
      grid.caption);
  for (std::size_t c = 0; c < grid.columns.size(); ++c)
    html += fmt::format("<th scope=\"col\">{}{} {}</th>", grid.column, c + 1, grid.columns[c]);
  html += "</tr></thead><tbody>\n";
  const ConfigNode& list = At(file, grid.list);
  for (int r = 0; r < grid.rows; ++r) {
    const std::string key = fmt::format("{}{}", grid.row, r + 1);
    const ConfigNode& row = At(list, key);
    html += "<tr><th scope=\"row\">" + key + " " + MarkupText(AsString(At(row, "name"), "name")) +
            "</th>";
    const ConfigNode& shares = At(row, grid.shares);
    for (std::size_t c = 0; c < grid.columns.size(); ++c)
      html += Cell(At(shares, fmt::format("{}{}", grid.column, c + 1)));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string ExpertsTables(const std::filesystem::path& file, const std::string& robot) {
  const ConfigNode node = ReadYamlFile(file);
  const ConfigNode& measured = At(node, "robot");
  if (AsString(measured, "robot") != robot)
    throw InputError(measured.mark, "robot", measured.scalar,
                     "is another robot than risk_model.json's, " + robot);
  const ConfigNode& damage = At(node, "damage");
  std::vector<std::string> modes;
  for (int m = 0; m < kNumFailureModes; ++m)
    modes.push_back(Words(Name(static_cast<FailureMode>(m))));
  return Table(node, {"Which failure it is, at a class of hazard", "classes", "C",
                      static_cast<int>(kNumHazardClasses), "given_failure", "F", modes}) +
         Table(node,
               {"What comes of a failure",
                "modes",
                "F",
                kNumFailureModes,
                "effects",
                "E",
                {"no damage, takes longer", "recoverable, finishes alone",
                 "recoverable, needs a person", "lasting, finishes", "lasting, cannot finish"}}) +
         fmt::format(
             "<p class=\"note\">Shares of what was counted, each with its exact 95 % interval, and "
             "what the experts of the hTetro FMEA paper hold; ≠ where the interval excludes that, "
             "as one in twenty would by chance. "
             "Damage is assumed, not measured: recoverable from as hard a blow as when one edge "
             "drops by {} mm, lasting from {} mm. Counts and more stand in "
             "<code>fmea_measured.yaml</code>.</p>\n",
             NumberText(AsDouble(At(damage, "recoverable_drop_mm"), "recoverable_drop_mm")),
             NumberText(AsDouble(At(damage, "lasting_drop_mm"), "lasting_drop_mm")));
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/html.h"

#include <fmt/format.h>

#include "base/base64.h"
#include "stats/outward.h"

namespace floorproof {

std::string DataUri(std::string_view type, std::string_view bytes) {
  return fmt::format("data:{};base64,", type) + Base64(bytes);
}

std::string UrlPath(std::string_view path) {
  static constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string out;
  for (const char c : path) {
    if (kPlain.find(c) != std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string TableHtml(const TextTable& table) {
  const auto num = [](const TextColumn& column) { return column.right ? " class=\"num\"" : ""; };
  std::string html = "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr>";
  for (const TextColumn& column : table.columns())
    html += fmt::format("<th scope=\"col\"{}>{}</th>", num(column), MarkupText(column.heading));
  html += "</tr></thead><tbody>\n";
  for (const std::vector<TextCell>& row : table.rows()) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      html += i == 0
                  ? fmt::format("<th scope=\"row\">{}</th>", MarkupText(row[i].text))
                  : fmt::format("<td{}>{}</td>", num(table.columns()[i]), MarkupText(row[i].text));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string PercentText(const Interval& share) {
  const Interval percent = RoundedOutward({100 * share.lower, 100 * share.upper});
  return NumberText(percent.lower) + " to " + PercentText(percent.upper / 100);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/html_page.h"

#include <fmt/format.h>

#include <string_view>

#include "base/base64.h"
#include "base/file_output.h"
#include "report/html.h"
#include "web/assets.h"

namespace floorproof {
namespace {

// As a policy names a script.
std::string HashOf(std::string_view script) {
  const std::string hex = Sha256(script);
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return "'sha256-" + Base64(bytes) + "'";
}

// In a script of data "<" could begin its end.
std::string DataText(const std::string& json) {
  std::string text;
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

}  // namespace

std::string PictureHtml(const ReportPicture& picture) {
  return fmt::format("<figure><img src=\"{0}\" alt=\"{1}\"><figcaption>{1}</figcaption></figure>\n",
                     DataUri("image/png", picture.png), MarkupText(picture.caption));
}

std::string PicturesHtml(const std::vector<ReportPicture>& pictures) {
  if (pictures.empty()) return "";
  std::string html = "<div class=\"frames\">";
  for (const ReportPicture& picture : pictures) html += PictureHtml(picture);
  return html + "</div>";
}

std::string HtmlPage::Html() const {
  std::vector<std::string_view> scripts;
  if (!data.empty()) {
    if (shows_replay) scripts.push_back(ThreeJs());
    if (shows_plots) scripts.push_back(EChartsJs());
    if (shows_table) scripts.push_back(AgGridJs());
    std::erase_if(scripts, [](std::string_view script) { return script.empty(); });
    scripts.push_back(PageScript());
  }
  std::string allowed;
  for (const std::string_view script : scripts) allowed += " " + HashOf(script);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data: "
      "blob:; media-src data:; font-src data:; style-src 'unsafe-inline'" +
      (allowed.empty() ? "" : "; script-src" + allowed) +
      "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      MarkupText(about.empty() ? title : title + ": " + about) + "</title>\n<style>" +
      std::string(PageStyle()) + extra_style + "</style></head>\n<body><header><p class=\"over\">" +
      MarkupText(over) + "</p><h1>" + MarkupText(title) + "</h1>\n" + verdict + "<nav>";
  for (const PageSection& section : sections)
    if (!section.heading.empty())
      html += fmt::format("<a href=\"#{}\">{}</a>", section.id, MarkupText(section.heading));
  html += "</nav></header>\n<main>\n";
  for (const PageSection& section : sections)
    html +=
        fmt::format("<section id=\"{}\">{}\n{}</section>\n", section.id,
                    section.heading.empty() ? "" : "<h2>" + MarkupText(section.heading) + "</h2>",
                    section.html);
  html += "</main>\n" + (footer.empty() ? "" : "<footer>" + footer + "</footer>\n");
  if (!data.empty()) {
    html += "<script type=\"application/json\" id=\"page-data\">" + DataText(data) + "</script>\n";
    for (const auto& [id, bytes] : blobs)
      html += fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", id,
                          Base64(bytes));
    for (const std::string_view script : scripts)
      html.append("<script>").append(script).append("</script>\n");
  }
  return html + "</body></html>\n";
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// An HTML page that needs nothing beside it: style, scripts, libraries and data stand in it.
//
// A policy in its head lets the browser load nothing from anywhere, and run only the scripts that
// were put here: their hashes are in it. Without scripts the page is whole, too.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace floorproof {

struct ReportPicture {
  std::string caption{}, png{};
};
// With its caption, as one figure; and several, side by side.
std::string PictureHtml(const ReportPicture& picture);
std::string PicturesHtml(const std::vector<ReportPicture>& pictures);

struct PageSection {
  std::string id{}, heading{}, html{};
};

struct HtmlPage {
  std::string over{}, title{};  // texts: what made the page; what it is about
  std::string about{};          // behind the title in the window's bar: "failure rates"
  std::string verdict{};        // HTML, below the title
  std::vector<PageSection> sections{};
  std::string footer{};       // HTML
  std::string extra_style{};  // behind page.css
  // For the scripts, as JSON; empty: the page has none.
  std::string data{};
  std::vector<std::pair<std::string, std::string>> blobs{};  // id and bytes, for the scripts
  bool shows_replay = false, shows_plots = false, shows_table = false;  // of `data`

  std::string Html() const;
};

}  // namespace floorproof

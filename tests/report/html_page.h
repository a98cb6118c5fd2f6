// SPDX-License-Identifier: Apache-2.0
// What tests ask of an HTML page.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace floorproof {

// Why the page's tags do not balance, or an attribute has no end; empty when all is well. A style's
// content is text.
inline std::string WhyUnbalanced(std::string_view page) {
  static constexpr std::string_view kVoid[] = {"meta", "img", "br", "!DOCTYPE"};
  std::vector<std::string> open;
  for (std::size_t at = 0; at < page.size(); ++at) {
    if (page[at] != '<') continue;
    std::size_t end = at + 1;
    for (char quote = 0; end < page.size() && (quote != 0 || page[end] != '>'); ++end) {
      if (quote == 0 && page[end] == '<') return "a bare <";
      if (page[end] == '"') quote = quote == 0 ? '"' : 0;
    }
    if (end == page.size()) return "a tag without an end";
    const std::string_view tag = page.substr(at + 1, end - at - 1);
    const std::string name(tag.substr(0, tag.find_first_of(" /\n", 1)));
    if (name.front() == '/') {
      if (open.empty() || open.back() != name.substr(1)) return "unexpected <" + name + ">";
      open.pop_back();
    } else if (tag.back() != '/' && std::ranges::find(kVoid, name) == std::end(kVoid)) {
      open.push_back(name);
    }
    at = name == "style" ? page.find("</style>", end) - 1 : end;
  }
  return open.empty() ? "" : "<" + open.back() + "> stays open";
}

}  // namespace floorproof

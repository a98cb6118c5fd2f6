// SPDX-License-Identifier: Apache-2.0
#include "base/markup.h"

#include "base/printable.h"

namespace floorproof {

std::string MarkupText(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : Printable(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else if ((static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) || c == '\n' || c == '\t')
      out += c;
  }
  return out;
}

}  // namespace floorproof

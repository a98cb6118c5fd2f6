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

std::string PercentText(const Interval& share) {
  const Interval percent = RoundedOutward({100 * share.lower, 100 * share.upper});
  return NumberText(percent.lower) + " to " + PercentText(percent.upper / 100);
}

}  // namespace floorproof

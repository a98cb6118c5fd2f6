// SPDX-License-Identifier: Apache-2.0
// Text within XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace floorproof {

// Escaped for element content and quoted attributes of either; control characters that neither may
// hold are left out.
std::string MarkupText(std::string_view text);

}  // namespace floorproof

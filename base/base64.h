// SPDX-License-Identifier: Apache-2.0
// Any bytes as a text, and back (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace floorproof {

std::string Base64(std::string_view bytes);
// Throws InternalError where the text is none of Base64's.
std::string FromBase64(std::string_view text);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// JSON texts of a file from elsewhere, checked before a parser builds them: nesting, keys and
// length have limits, so that a small file cannot take much time or memory in any reader, in C++ or
// Python.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace floorproof {

inline constexpr std::size_t kMaxJson_bytes = 4u << 20;
inline constexpr int kMaxJsonLevels = 32;
inline constexpr std::size_t kMaxJsonKeys = 1000;  // of an object

// Why the text is refused, a phrase; empty if it is JSON within these limits.
std::string WhyUnboundedJson(std::string_view text);

}  // namespace floorproof

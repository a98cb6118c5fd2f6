// SPDX-License-Identifier: Apache-2.0
// JSON texts of a file from elsewhere, checked before a parser builds them: nesting, keys and
// length have limits, so that a small file cannot take much time or memory in any reader, in C++ or
// Python.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace floorproof {

// The defaults are for a text in a row of a database.
struct JsonLimits {
  std::size_t bytes = 4u << 20;
  std::size_t keys = 1000;  // of an object: the ordered parser compares each with all before it
  std::size_t levels = 32;  // copies and writers of parsed JSON recurse
};

// Why the text is refused, a phrase; empty if it is JSON within these limits.
std::string WhyUnboundedJson(std::string_view text, const JsonLimits& limits = {});

}  // namespace floorproof

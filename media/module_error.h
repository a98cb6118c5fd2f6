// SPDX-License-Identifier: Apache-2.0
// How a module says that a call failed. Only plain C types cross its border and nothing is thrown:
// every function that returns int gives 0 when done; else it fills `error` (of kModuleErrorSize
// bytes) with a line.
#pragma once

#include <cstddef>
#include <cstdio>
#include <exception>

namespace floorproof {

inline constexpr std::size_t kModuleErrorSize = 256;

// The module's side: runs `body`, and turns what it throws into such a line.
template <class Body>
int Guarded(char* error, const Body& body) noexcept {
  const auto say = [&](const char* why) { std::snprintf(error, kModuleErrorSize, "%s", why); };
  try {
    body();
    return 0;
  } catch (const std::exception& e) {
    say(e.what());
  } catch (...) {
    say("unknown exception");
  }
  return 1;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// How a call crosses the border of a module. Only plain C types do, and nothing is thrown: every
// function that returns int gives 0 when done; else it fills `error` (of kModuleErrorSize bytes)
// with a line.
#pragma once

#include <cstddef>
#include <cstdio>
#include <exception>
#include <memory>

namespace floorproof {

inline constexpr std::size_t kModuleErrorSize = 256;

// The caller's side: frees what a module hands out by the module's own function.
using ModuleHandle = std::unique_ptr<void, void (*)(void*)>;

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

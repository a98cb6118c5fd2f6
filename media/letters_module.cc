// SPDX-License-Identifier: Apache-2.0
// The table of functions of the module of letters. Built as a library of its own because fonts
// bring a dozen shared libraries, which only those who draw pay for.
#include "media/letters.h"
#include "media/letters_api.h"
#include "media/module_call.h"

namespace floorproof {
namespace {

int Draw(const char* utf8, double cap_px, int bold, LettersApi::Drawn* out, void** handle,
         char* error) {
  return Guarded(error, [&] {
    auto drawn = DrawLetters(utf8, cap_px, bold != 0);
    *handle = nullptr;
    if (!drawn) return;
    *out = {drawn->coverage.cols, drawn->coverage.rows, drawn->coverage.data, drawn->base,
            drawn->advance_px};
    *handle = drawn.release();
  });
}
void Release(void* handle) { delete static_cast<DrawnLetters*>(handle); }

constexpr LettersApi kApi = {.version = LettersApi::kVersion, .draw = Draw, .release = Release};

}  // namespace
}  // namespace floorproof

extern "C" __attribute__((visibility("default"))) const floorproof::LettersApi*
FloorproofLetters() {
  return &floorproof::kApi;
}

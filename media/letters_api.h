// SPDX-License-Identifier: Apache-2.0
// What crosses the border between the program and the module of letters (media/module_call.h).
#pragma once

#include <cstdint>

namespace floorproof {

struct LettersApi {
  static constexpr int kVersion = 1;
  int version;

  // One line of UTF-8 as the share of each pixel that it covers: 8 bits, rows from the top.
  struct Drawn {
    int width, height;
    const std::uint8_t* coverage;
    int base;  // row of the base line
    double advance_px;
  };
  // `handle` owns the pixels until release(handle), and is nullptr where no installed font has all
  // letters.
  int (*draw)(const char* utf8, double cap_px, int bold, Drawn* drawn, void** handle, char* error);
  void (*release)(void* handle);
};

}  // namespace floorproof

// The module's one symbol.
extern "C" const floorproof::LettersApi* FloorproofLetters();
inline constexpr const char* kLettersSymbol = "FloorproofLetters";
inline constexpr const char* kLettersModule = "libfp_letters.so";

// SPDX-License-Identifier: Apache-2.0
// Where tests find the checkout and the program. Only places.cc names absolute folders: every other
// file compiles to the same object in every clone (cmake/CompilerCache.cmake).
#pragma once

#include <filesystem>
#include <string_view>

namespace floorproof {

// A file or folder of the checkout, by its path from the checkout's root.
std::filesystem::path SourceFile(std::string_view path);

// A file or folder of the data beside the checkout. It need not exist: tests skip where it doesn't.
std::filesystem::path SharedFile(std::string_view path);

// The program that was built with these tests.
std::filesystem::path ProgramFile();

}  // namespace floorproof

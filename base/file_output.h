// SPDX-License-Identifier: Apache-2.0
// Writing result files: whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace floorproof {

// Makes the folder and its parents; throws InputError when it cannot be.
void MakeFolder(const std::filesystem::path& folder);
// Writes beside the file and renames, so that a reader finds the old file or the whole new one.
// Throws InputError naming the file when the disk is full or it cannot be written.
void WriteFileWhole(const std::filesystem::path& path, std::string_view text);
// The text's SHA-256 in hexadecimal.
std::string Sha256(std::string_view text);
// The file's SHA-256 in hexadecimal. Throws InputError when it cannot be read.
std::string Sha256OfFile(const std::filesystem::path& path);

}  // namespace floorproof

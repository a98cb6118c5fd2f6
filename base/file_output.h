// SPDX-License-Identifier: Apache-2.0
// Writing result files: whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace floorproof {

// Makes the folder and its parents; throws InputError when it cannot be.
void MakeFolder(const std::filesystem::path& folder);
// Makes a new, empty file beside `path`, hidden and of its extension, to be renamed to it once it
// is whole. A link of that name is replaced, not followed. Throws InputError naming `path`.
std::filesystem::path MakePartFile(const std::filesystem::path& path);
// Writes a new file beside the old one and renames it. So a reader finds either the old file or the
// whole new one. Throws InputError naming the file when the disk is full or the file cannot be
// written.
void WriteFileWhole(const std::filesystem::path& path, std::string_view text);
// The text's SHA-256 in hexadecimal.
std::string Sha256(std::string_view text);
// The file's SHA-256 in hexadecimal. Throws InputError when it cannot be read.
std::string Sha256OfFile(const std::filesystem::path& path);

}  // namespace floorproof

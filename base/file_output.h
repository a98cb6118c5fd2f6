// SPDX-License-Identifier: Apache-2.0
// Writing result files: whole or not at all. A place that cannot be written to is bad input; a disk
// that is full, or fails, is not: whoever named the place did nothing wrong.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "base/error.h"

namespace floorproof {

// The disk is full, or fails (exit status 3).
class DiskError : public InternalError {
 public:
  using InternalError::InternalError;
};
// Whether that is the reason: no space, no quota, a file as large as they may be, an input/output
// error.
bool IsOfTheDisk(const std::error_code& reason);
// Throws "PATH: WHY": DiskError where the reason is of the disk, else InputError.
[[noreturn]] void RefuseToWrite(const std::filesystem::path& path, const std::error_code& reason,
                                const std::string& why);

// All below throw as RefuseToWrite does.

// Makes the folder and its parents.
void MakeFolder(const std::filesystem::path& folder);
// Makes a new, empty file beside `path`, hidden and of its extension, to be renamed to it once it
// is whole. A link of that name is replaced, not followed. What it throws names `path`.
std::filesystem::path MakePartFile(const std::filesystem::path& path);
// The name of the file that one of this name is to become; empty: it is no such file.
std::string WholeOfPart(const std::string& part);
// Writes a new file beside the old one and renames it. So a reader finds either the old file or the
// whole new one. A device or pipe is written to.
void WriteFileWhole(const std::filesystem::path& path, std::string_view text);
// The text's SHA-256 in hexadecimal.
std::string Sha256(std::string_view text);
// Whether a text is one, as Sha256 writes it.
bool IsSha256(std::string_view text);
// The file's SHA-256 in hexadecimal. Throws InputError when it cannot be read.
std::string Sha256OfFile(const std::filesystem::path& path);

}  // namespace floorproof

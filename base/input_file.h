// SPDX-License-Identifier: Apache-2.0
// Files that a user names. They are checked before they are opened, so that a pipe or a device
// cannot make the program wait for ever.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace floorproof {

struct ConfigNode;

// Why the file cannot be read: missing, a folder, a pipe or device, larger than most_bytes, not
// permitted, a loop of links, a file of /proc or /sys. Empty when it can. Never throws, whatever
// the path holds.
std::string WhyUnreadable(const std::filesystem::path& file, std::uintmax_t most_bytes);

// Whether it is a plain file and no link, which could lead to a file that is nobody's to show.
bool IsPlainFile(const std::filesystem::path& file);

// The absolute path without links, those that lead to nothing included.
std::filesystem::path ResolvedPath(const std::filesystem::path& path);
// Whether a path is `folder` or lies below it, as both are written: the disk is not asked.
bool LiesBelow(const std::filesystem::path& folder, const std::filesystem::path& path);
// Whether it is a hidden file (.env) or lies in a hidden folder (.git, .ssh), seen from `folder`.
bool IsHiddenIn(const std::filesystem::path& folder, const std::filesystem::path& path);

// Of a file that the program wrote and reads again.
inline constexpr std::uintmax_t kMaxResultBytes = 64u << 20;

// The whole file. Throws InputError naming it.
std::string ReadInputFile(const std::filesystem::path& file, std::uintmax_t most_bytes);

// The same of a plain file. Empty: it is none, or cannot be read, or is larger.
std::string ReadPlainFile(const std::filesystem::path& file, std::uintmax_t most_bytes);

// Its first `count` bytes, or all where it has fewer, to look at before the rest is read. Throws as
// ReadInputFile.
std::string ReadStartOfFile(const std::filesystem::path& file, std::size_t count,
                            std::uintmax_t most_bytes);

// A path written in a file of `folder`, under `key`. It may leave that folder only in plain words:
// absolute, or beginning with "../" (a/../../b is refused). Throws InputError.
std::filesystem::path PathIn(const std::filesystem::path& folder, const ConfigNode& node,
                             const std::string& key);

}  // namespace floorproof

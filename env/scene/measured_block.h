// SPDX-License-Identifier: Apache-2.0
// Measured limits in the text of a robot's MJCF: one block under <custom>, between two comments.
// All else of the text stays as whoever wrote it did. What stands in it: measured_names.h.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "base/input_files.h"

namespace floorproof {

// The text without its block, both comments and their indent; the same where it has none.
std::string WithoutMeasured(std::string_view text);
// The text with `elements`, one a line, as its block: in place of the one that it has, else at the
// end of its first <custom> element, else in one of its own. Line breaks are the text's own.
// Throws InputError naming `file` where it is no MJCF's text.
std::string WithMeasured(std::string_view text, std::string_view elements,
                         const std::filesystem::path& file);

// SHA-256 of what the model is by these files, the MJCF first: its text without the block, without
// comments and without spaces between words that say nothing, and the bytes of the others.
std::string ModelHash(std::span<const std::filesystem::path> files, const InputFiles& read);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Bad input: one line that names file, line, key, value and the rule broken.
//
// Every error is one printable line of at most kMaxErrorLine characters, whatever a file holds or
// is called. Values and keys are quoted with at most 60 characters, and file names with at most
// 200.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace floorproof {

constexpr std::size_t kMaxErrorLine = 1000;

// Any text as such a line; words of more than 200 characters are cut in the middle.
std::string ErrorLine(std::string_view text);

// Where a value was written. line 0: unknown (the file as a whole, or the command line).
struct SourceMark {
  std::string file;
  int line = 0;
};

// Thrown once for bad input; the command line prints what() and exits with status 2.
class InputError : public std::runtime_error {
 public:
  // "FILE:LINE: KEY = VALUE: RULE", leaving out what is empty.
  InputError(const SourceMark& mark, std::string_view key, std::string_view value,
             std::string_view rule);
  explicit InputError(const std::string& message);
};

// The tool or the physics broke (exit status 3).
class InternalError : public std::runtime_error {
 public:
  explicit InternalError(const std::string& message);
};

// The candidate with the least edit distance to `word`; empty when none is near.
std::string Nearest(std::string_view word, std::span<const std::string> candidates);
// "; did you mean X?" of that one, to go behind a rule; empty when none is near.
std::string DidYouMean(std::string_view word, std::span<const std::string> candidates);

// That, and behind it " (known: ...)" with all of them.
std::string DidYouMeanOneOf(std::string_view word, std::span<const std::string> candidates);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Bad input: one line that names file, line, key, value and the rule broken.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace floorproof {

// Where a value was written. line 0: unknown (the file as a whole, or the command line).
struct SourceMark {
  std::string file;
  int line = 0;
};

// Thrown once for bad input; the command line prints what() and exits with status 2.
class InputError : public std::runtime_error {
 public:
  // "FILE:LINE: KEY = VALUE: RULE", leaving out what is empty; one line, whatever they hold.
  InputError(const SourceMark& mark, std::string_view key, std::string_view value,
             std::string_view rule);
  explicit InputError(const std::string& message);
};

// The tool or the physics broke (exit status 3).
class InternalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The candidate with the least edit distance to `word`; empty when none is near.
std::string Nearest(std::string_view word, std::span<const std::string> candidates);
// "; did you mean X?" of that one, to go behind a rule; empty when none is near.
std::string DidYouMean(std::string_view word, std::span<const std::string> candidates);

// That, and behind it " (known: ...)" with all of them.
std::string DidYouMeanOneOf(std::string_view word, std::span<const std::string> candidates);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A table of text, fitted to a window. Where it is too wide, columns that may wrap give way; where
// that is not enough, each row turns into lines of their own.
//
//   Verdict   failure, stuck at       or   Verdict: failure,
//             198.8 s                          stuck at 198.8 s
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floorproof {

// How a terminal with colours shows a cell. Good and bad are cyan and red, which no eye mistakes
// for each other; the words say the same.
enum class Tone { kPlain, kHeading, kGood, kBad };

struct TextCell {
  TextCell(std::string words) : text(std::move(words)) {}  // NOLINT: a text is a plain cell
  TextCell(const char* words) : text(words) {}             // NOLINT
  TextCell(std::string words, Tone how) : text(std::move(words)), tone(how) {}
  std::string text;
  Tone tone = Tone::kPlain;
};

struct TextColumn {
  std::string heading = {};
  bool right = false;  // aligned there: numbers
  bool wraps = false;  // gives way in a narrow window
  int least = 0;       // columns that it takes at least: rows that are said one by one line up
};

class TextTable {
 public:
  // A line of headings where a column has one.
  explicit TextTable(std::vector<TextColumn> columns) : columns_(std::move(columns)) {}
  // A line before all rows.
  void SetTitle(std::string_view title);
  // A cell a column, of which the last ones may be left out. Of text from elsewhere, what cannot be
  // shown becomes a question mark, and line breaks become spaces.
  void Add(std::vector<TextCell> row);
  bool empty() const { return rows_.empty(); }
  const std::vector<TextColumn>& columns() const { return columns_; }
  const std::vector<std::vector<TextCell>>& rows() const { return rows_; }

  // Of at most `width` columns, but for words that are wider. `colours`: with ANSI sequences.
  std::vector<std::string> Lines(int width, bool colours) const;

 private:
  using Row = std::vector<TextCell>;

  bool HasHeadings() const;
  // The columns' widths; empty where they do not fit.
  std::vector<int> Fit(int width) const;
  std::vector<std::string> RowLines(const Row& row, const std::vector<int>& widths,
                                    bool colours) const;
  std::vector<std::string> ListLines(const Row& row, int width, bool colours) const;

  std::vector<TextColumn> columns_;
  std::string title_;
  std::vector<Row> rows_;
};

// A thing a row: what it is, and what is to be said of it. All such tables line up.
class FactTable : public TextTable {
 public:
  FactTable();
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "base/text_table.h"

#include <algorithm>
#include <utility>

#include "base/printable.h"
#include "base/text_width.h"

namespace floorproof {
namespace {

constexpr int kIndent = 2, kGap = 2;
constexpr int kLeastText = 24;    // a narrower column of text is hard to read
constexpr int kLeastFigure = 12;  // of a column under a heading
constexpr int kLeastWindow = 20;
constexpr int kFactName = 18;  // "Nearest to failing"

std::string Spaces(int n) { return std::string(static_cast<std::size_t>(std::max(n, 0)), ' '); }

int WidestWord(const std::string& text) {
  int widest = 0;
  for (const std::string& word : WrapText(text, 1)) widest = std::max(widest, DisplayWidth(word));
  return widest;
}

// On one line, of what can be shown.
std::string Clean(std::string_view text) {
  std::string clean = Printable(text);
  std::ranges::replace_if(
      clean, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return clean;
}

std::string Coloured(const std::string& text, Tone tone, bool colours) {
  if (!colours || tone == Tone::kPlain || text.empty()) return text;
  const char* begin = tone == Tone::kGood  ? "\033[1;36m"
                      : tone == Tone::kBad ? "\033[1;31m"
                                           : "\033[1m";
  return begin + text + "\033[0m";
}

}  // namespace

void TextTable::SetTitle(std::string_view title) { title_ = Clean(title); }

void TextTable::Add(Row row) {
  row.resize(columns_.size(), TextCell(""));
  for (TextCell& cell : row) cell.text = Clean(cell.text);
  rows_.push_back(std::move(row));
}

bool TextTable::HasHeadings() const {
  return std::ranges::any_of(columns_, [](const TextColumn& c) { return !c.heading.empty(); });
}

std::vector<int> TextTable::Fit(int width) const {
  const bool headings = HasHeadings();
  std::vector<int> widths, least;  // least: what a column that wraps may shrink to
  int over = kIndent - kGap - width;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const TextColumn& column = columns_[i];
    int most = std::max(column.least, DisplayWidth(column.heading));
    int few = headings ? std::max(kLeastFigure, WidestWord(column.heading)) : kLeastText;
    for (const Row& row : rows_) {
      most = std::max(most, DisplayWidth(row[i].text));
      if (headings) few = std::max(few, WidestWord(row[i].text));
    }
    // Without headings all tables of a window look alike, whatever they hold.
    if (column.wraps && !headings) most = std::max(most, few);
    widths.push_back(most);
    least.push_back(column.wraps ? few : most);
    over += most + kGap;
  }
  for (std::size_t i = 0; i < widths.size() && over > 0; ++i) {
    const int given = std::clamp(widths[i] - least[i], 0, over);
    widths[i] -= given;
    over -= given;
  }
  return over > 0 ? std::vector<int>() : widths;
}

std::vector<std::string> TextTable::RowLines(const Row& row, const std::vector<int>& widths,
                                             bool colours) const {
  std::vector<std::vector<std::string>> cells;
  std::size_t height = 1;
  for (std::size_t i = 0; i < row.size(); ++i) {
    cells.push_back(WrapText(row[i].text, widths[i]));
    height = std::max(height, cells.back().size());
  }
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < height; ++k) {
    std::string line = Spaces(kIndent - kGap);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string text = k < cells[i].size() ? cells[i][k] : "";
      const std::string padding = Spaces(widths[i] - DisplayWidth(text));
      line += Spaces(kGap) + (columns_[i].right ? padding : "") +
              Coloured(text, row[i].tone, colours) + (columns_[i].right ? "" : padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<std::string> TextTable::ListLines(const Row& row, int width, bool colours) const {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& text, int indent, Tone tone) {
    bool first = true;
    for (const std::string& line : WrapText(text, width - indent - kIndent))
      lines.push_back(Spaces(std::exchange(first, false) ? indent : indent + kIndent) +
                      Coloured(line, tone, colours));
  };
  if (HasHeadings()) {
    add(row.front().text, kIndent, row.front().tone);
    for (std::size_t i = 1; i < row.size(); ++i)
      if (!row[i].text.empty())
        add(columns_[i].heading + ": " + row[i].text, 2 * kIndent, row[i].tone);
    return lines;
  }
  std::string text = row.front().text;
  Tone tone = row.front().tone;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i].text.empty()) continue;
    text += (i == 1 ? ": " : "  ") + row[i].text;
    if (tone == Tone::kPlain) tone = row[i].tone;
  }
  add(text, kIndent, tone);
  return lines;
}

std::vector<std::string> TextTable::Lines(int width, bool colours) const {
  width = std::max(width, kLeastWindow);
  std::vector<std::string> lines;
  const auto add = [&](const std::vector<std::string>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
  };
  if (!title_.empty())
    for (const std::string& line : WrapText(title_, width))
      lines.push_back(Coloured(line, Tone::kHeading, colours));
  const std::vector<int> widths = Fit(width);
  if (HasHeadings() && !widths.empty()) {
    Row headings;
    for (const TextColumn& column : columns_) headings.emplace_back(column.heading, Tone::kHeading);
    add(RowLines(headings, widths, colours));
  }
  for (const Row& row : rows_)
    add(widths.empty() ? ListLines(row, width, colours) : RowLines(row, widths, colours));
  return lines;
}

FactTable::FactTable() : TextTable({{.least = kFactName}, {.wraps = true}}) {}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A scan of tags and attributes, no parser: whatever else is wrong with the XML MuJoCo says itself.
#include "env/scene/mjcf_check.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace floorproof {
namespace {

constexpr std::uintmax_t kMaxBytes = 64u << 20;
constexpr int kMaxIncludes = 20;
constexpr double kMaxCopies = 10000;  // of what stands in nested <replicate>, or in a composite
constexpr double kMaxPixels = 8192;   // of a texture's side or a height field's

// The numbers of an attribute such as count="4 4 1", multiplied.
double Product(std::string_view value) {
  std::istringstream in{std::string(value)};
  double product = 1;
  for (double number; in >> number;) product *= std::max(1.0, number);
  return product;
}

// Reads tags one after the other: <name key="value" ...>, </name>, <name/>.
class Tags {
 public:
  struct Attribute {
    std::string_view key, value;
  };
  std::string_view name;
  std::vector<Attribute> attributes;
  bool closes = false, empty = false;
  int line = 1;

  explicit Tags(std::string_view text) : text_(text) {}

  bool Next() {
    if (!Skip('<')) return false;
    name = {};
    attributes.clear();
    closes = Take('/');
    empty = false;
    name = Word();
    while (at_ < text_.size() && text_[at_] != '>' && text_[at_] != '<') {
      if (Take('/')) {
        empty = true;
      } else if (const std::string_view key = Word(); !key.empty()) {
        Blank();
        if (!Take('=')) continue;
        Blank();
        if (const char quote = at_ < text_.size() ? text_[at_] : ' ';
            quote == '"' || quote == '\'') {
          const std::size_t begin = ++at_;
          if (!Skip(quote)) return false;
          attributes.push_back({key, text_.substr(begin, at_ - 1 - begin)});
        }
      } else {
        Step();
      }
    }
    return true;
  }

 private:
  void Step() { line += text_[at_++] == '\n'; }
  bool Take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  // To behind the next c.
  bool Skip(char c) {
    while (at_ < text_.size() && text_[at_] != c) Step();
    return Take(c);
  }
  void Blank() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) Step();
  }
  std::string_view Word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

class Scan {
 public:
  explicit Scan(const InputFiles& files) : inputs_(files) {}

  void File(const std::filesystem::path& file) {
    if (++files_ > kMaxIncludes)
      throw InputError({file.string(), 0}, "include", "", "files include each other without end");
    const std::string text = WithoutComments(inputs_.Read(file, kMaxBytes));
    std::vector<double> copies = {1};  // of what stands here, by nested <replicate>
    for (Tags tag(text); tag.Next();) {
      const bool replicate = tag.name == "replicate";
      if (tag.closes) {
        if (replicate && copies.size() > 1) copies.pop_back();
        continue;
      }
      const double here = Attributes(file, tag, copies.back());
      if (replicate && !tag.empty) copies.push_back(here);
    }
  }

 private:
  static std::string WithoutComments(std::string text) {
    for (std::size_t at = 0; (at = text.find("<!--", at)) != std::string::npos;) {
      const std::size_t end = std::min(text.find("-->", at), text.size());
      for (; at < end; ++at)
        if (text[at] != '\n') text[at] = ' ';  // line numbers stay
    }
    return text;
  }

  // Checks a tag's attributes; returns how often what it holds is copied.
  double Attributes(const std::filesystem::path& file, const Tags& tag, double copies) {
    const SourceMark mark{file.string(), tag.line};
    for (const auto& [key, value] : tag.attributes) {
      if (key == "count") {
        copies *= Product(value);
        if (!(copies <= kMaxCopies))
          throw InputError(mark, key, value, "makes more than 10000 copies");
      } else if (key == "nrow" || key == "ncol" || key == "width" || key == "height") {
        if (!(Product(value) <= kMaxPixels))
          throw InputError(mark, key, value, "must be at most 8192");
      } else if (key == "meshdir" || key == "texturedir" || key == "assetdir") {
        asset_folders_.emplace_back(file.parent_path() / value,
                                    std::filesystem::path(value).is_absolute());
      } else if (key == "file") {
        Named(mark, file.parent_path(), tag.name, value);
      }
    }
    return copies;
  }

  // A file that the model names: what is there must be a plain file. What is not there MuJoCo says.
  void Named(const SourceMark& mark, const std::filesystem::path& folder, std::string_view tag,
             std::string_view value) {
    std::vector<std::filesystem::path> places = {folder / value};
    for (const auto& place : asset_folders_) places.push_back(place.first / value);
    for (const auto& place : places) {
      if (!IsThere(place)) continue;
      if (const std::string why = inputs_.WhyUnreadable(place, kMaxBytes); !why.empty())
        throw InputError(mark, "file", value, why);
      const bool by_folder = std::ranges::any_of(asset_folders_, [&](const auto& assets) {
        return assets.second && place == assets.first / value;
      });
      if (by_folder || std::filesystem::path(value).is_absolute()) inputs_.MarkAbsolute(place);
    }
    if (tag == "include" && IsThere(places[0])) File(places[0]);
  }
  bool IsThere(const std::filesystem::path& file) const {
    std::error_code error;
    return inputs_.HasStandIn(file) || std::filesystem::exists(file, error);
  }

  int files_ = 0;
  const InputFiles& inputs_;
  std::vector<std::pair<std::filesystem::path, bool>> asset_folders_;  // absolute as written
};

}  // namespace

void CheckMjcf(const std::filesystem::path& file, const InputFiles& files) {
  Scan(files).File(file);
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// Built on yaml-cpp's event parser and not on its node tree. So line numbers, duplicate keys and
// the cost of aliases are under our control.
#include "base/config.h"

#include <yaml-cpp/emitter.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <charconv>
#include <map>
#include <sstream>
#include <unordered_map>

#include "base/input_files.h"
#include "base/params.h"
#include "base/printable.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxNodes = 400'000;
constexpr std::size_t kMaxNesting = 100;
// yaml-cpp takes up to 0.25 us for a byte (plain text in brackets): well under a second for a file.
constexpr std::uintmax_t kMaxBytes = 3u << 20;
constexpr std::size_t kMaxTreeBytes = 96u << 20;  // 400,000 nodes with room for their texts

// What a tree takes.
struct Cost {
  std::size_t nodes = 0, bytes = 0;
  Cost& operator+=(const Cost& more) {
    nodes += more.nodes;
    bytes += more.bytes;
    return *this;
  }
};

// Of the node alone.
Cost CostOf(const ConfigNode& node, std::size_t key_bytes) {
  return {1, sizeof node + key_bytes + node.scalar.size() + node.mark.file.size()};
}

Cost CostOfTree(const ConfigNode& node, std::size_t key_bytes = 0) {
  Cost cost = CostOf(node, key_bytes);
  for (const auto& item : node.items) cost += CostOfTree(item);
  for (const auto& [key, value] : node.entries) cost += CostOfTree(value, key.size());
  return cost;
}

// The list's entry of this `id`, or of this index.
ConfigNode& EntryOf(ConfigNode& list, const std::string& key, const SourceMark& mark) {
  for (ConfigNode& item : list.items)
    if (const ConfigNode* id = item.Find("id"); id != nullptr && id->scalar == key) return item;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  if (error == std::errc() && end == key.data() + key.size() && index < list.items.size())
    return list.items[index];
  throw InputError(mark, key, "",
                   "is neither the id nor the index of an entry of this list of " +
                       std::to_string(list.items.size()));
}

class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::string file) : file_(std::move(file)) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    ConfigNode node;
    node.mark = At(mark);
    Remember(anchor, node);
    Put(std::move(node));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto it = anchors_.find(anchor);
    if (it == anchors_.end())
      throw InputError(At(mark), "", "", "an alias inside its own anchor is not allowed");
    Charge(CostOfTree(it->second), At(mark));
    PutCharged(it->second);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    ConfigNode node = ConfigNode::Scalar(value, tag == "!");
    node.mark = At(mark);
    if (tag != "!" && tag != "?" && !tag.empty())
      throw InputError(node.mark, "", tag, "YAML tags are not allowed");
    if (const std::string why = WhyUnprintable(value); !why.empty())
      throw InputError(node.mark, KeyHere(), value, why);
    if (!node.quoted && (value == "~" || value == "null" || value.empty()))
      node.kind = ConfigNode::Kind::kNull;
    Remember(anchor, node);
    Put(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Open(ConfigNode::List(), mark, anchor);
  }
  void OnSequenceEnd() override { Close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Open(ConfigNode::Map(), mark, anchor);
  }
  void OnMapEnd() override { Close(); }

  ConfigNode Take() { return std::move(root_); }

 private:
  struct Level {
    ConfigNode node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;
    std::string key;
    SourceMark key_mark;
    std::unordered_map<std::string, int> lines;  // by key
  };

  SourceMark At(const YAML::Mark& mark) const { return {file_, mark.line + 1}; }
  // Of the value that is read now; none in a list, or where it is a key itself.
  std::string KeyHere() const {
    return !stack_.empty() && stack_.back().has_key ? stack_.back().key : "";
  }
  // What is copied counts each time: for aliases, and for anchors, which may be nested.
  void Charge(const Cost& cost, const SourceMark& mark) {
    cost_ += cost;
    if (cost_.nodes > kMaxNodes)
      throw InputError(mark, "", "",
                       "more than " + std::to_string(kMaxNodes) + " values (aliases expanded)");
    if (cost_.bytes > kMaxTreeBytes)
      throw InputError(mark, "", "",
                       "takes more than " + std::to_string(kMaxTreeBytes >> 20) +
                           " MiB of memory (aliases expanded)");
  }
  void Remember(YAML::anchor_t anchor, const ConfigNode& node) {
    if (!anchor) return;
    Charge({0, CostOfTree(node).bytes}, node.mark);
    anchors_[anchor] = node;
  }
  void Open(ConfigNode node, const YAML::Mark& mark, YAML::anchor_t anchor) {
    node.mark = At(mark);
    if (stack_.size() >= kMaxNesting)
      throw InputError(node.mark, "", "", "nested more than 100 levels deep");
    stack_.push_back({std::move(node), anchor, false, {}, {}, {}});
  }
  void Close() {
    Level level = std::move(stack_.back());
    stack_.pop_back();
    Remember(level.anchor, level.node);
    Put(std::move(level.node));
  }
  // The entries of a map or list were charged before.
  void Put(ConfigNode node) {
    Charge(CostOf(node, 0), node.mark);
    PutCharged(std::move(node));
  }
  void PutCharged(ConfigNode node) {
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Level& top = stack_.back();
    if (top.node.IsList()) {
      top.node.items.push_back(std::move(node));
    } else if (!top.has_key) {
      if (!node.IsScalar()) throw InputError(node.mark, "", "", "a key must be plain text");
      const auto [earlier, is_new] = top.lines.emplace(node.scalar, node.mark.line);
      if (!is_new)
        throw InputError(
            node.mark, node.scalar, "",
            "the key stands twice (first in line " + std::to_string(earlier->second) + ")");
      top.has_key = true;
      top.key = node.scalar;
      top.key_mark = node.mark;
    } else {
      if (node.IsNull()) node.mark = top.key_mark;  // an empty value has no place of its own
      top.node.entries.emplace_back(std::move(top.key), std::move(node));
      top.has_key = false;
    }
  }

  std::string file_;
  ConfigNode root_;
  std::vector<Level> stack_;
  std::map<YAML::anchor_t, ConfigNode> anchors_;
  Cost cost_;
};

bool IsShortList(const ConfigNode& node) {
  for (const auto& item : node.items)
    if (!item.IsScalar() && !(item.IsList() && item.items.size() <= 3 && IsShortList(item)))
      return false;
  return true;
}

// Text that reads the same as a block (`|`): lines that begin with no space, the last one ended.
bool IsBlockOfLines(const std::string& text) {
  if (text.size() < 2 || text.back() != '\n' || text[text.size() - 2] == '\n') return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if ((c < 0x20 && c != '\n') || c == 0x7f) return false;
    if (c == ' ' && (i == 0 || text[i - 1] == '\n')) return false;
  }
  return text.front() != '\n';
}

void Emit(const ConfigNode& node, YAML::Emitter& out) {
  switch (node.kind) {
    case ConfigNode::Kind::kNull:
      out << YAML::Null;
      break;
    case ConfigNode::Kind::kScalar:
      if (IsBlockOfLines(node.scalar))
        out << YAML::Literal << node.scalar;
      else if (node.quoted || node.scalar.find('\n') != std::string::npos)
        out << YAML::DoubleQuoted << node.scalar;
      else
        out << node.scalar;
      break;
    case ConfigNode::Kind::kList:
      if (IsShortList(node)) out << YAML::Flow;
      out << YAML::BeginSeq;
      for (const auto& item : node.items) Emit(item, out);
      out << YAML::EndSeq;
      break;
    case ConfigNode::Kind::kMap:
      out << YAML::BeginMap;
      for (const auto& [key, value] : node.entries) {
        out << YAML::Key << key << YAML::Value;
        Emit(value, out);
      }
      out << YAML::EndMap;
      break;
  }
}

}  // namespace

ConfigNode ConfigNode::Scalar(std::string text, bool quoted) {
  ConfigNode node;
  node.kind = Kind::kScalar;
  node.scalar = std::move(text);
  node.quoted = quoted;
  return node;
}

ConfigNode ConfigNode::List(std::vector<ConfigNode> items) {
  ConfigNode node;
  node.kind = Kind::kList;
  node.items = std::move(items);
  return node;
}

ConfigNode ConfigNode::Map() {
  ConfigNode node;
  node.kind = Kind::kMap;
  return node;
}

const ConfigNode* ConfigNode::Find(std::string_view key) const {
  for (const auto& entry : entries)
    if (entry.first == key) return &entry.second;
  return nullptr;
}

ConfigNode* ConfigNode::Find(std::string_view key) {
  for (auto& entry : entries)
    if (entry.first == key) return &entry.second;
  return nullptr;
}

ConfigNode& ConfigNode::Add(std::string key, ConfigNode value) {
  if (ConfigNode* there = Find(key)) {
    *there = std::move(value);
    return *there;
  }
  return entries.emplace_back(std::move(key), std::move(value)).second;
}

void ConfigNode::Remove(std::string_view key) {
  std::erase_if(entries, [key](const auto& entry) { return entry.first == key; });
}

void ConfigNode::SetPath(std::string_view key_path, ConfigNode value) {
  const auto dot = key_path.find('.');
  const std::string key(key_path.substr(0, dot));
  if (key.empty()) throw InputError(value.mark, std::string(key_path), "", "an empty key");
  if (IsList()) {
    ConfigNode& entry = EntryOf(*this, key, value.mark);
    if (dot == std::string_view::npos)
      entry = std::move(value);
    else
      entry.SetPath(key_path.substr(dot + 1), std::move(value));
    return;
  }
  if (IsScalar())
    throw InputError(value.mark, std::string(key_path), "", "stands below a value that is no map");
  kind = Kind::kMap;
  if (mark.file.empty()) mark = value.mark;  // made for it
  if (dot == std::string_view::npos) {
    Add(key, std::move(value));
    return;
  }
  ConfigNode* child = Find(key);
  if (child == nullptr) child = &Add(key, Map());
  child->SetPath(key_path.substr(dot + 1), std::move(value));
}

namespace {

// The parser does not say that a tab is what it cannot read. `line` from 0 on.
std::string TabHint(const std::string& text, int line) {
  std::istringstream in(text);
  std::string found;
  for (int i = 0; i <= line; ++i)
    if (!std::getline(in, found)) return "";
  const std::string indent = found.substr(0, found.find_first_not_of(" \t"));
  return indent.find('\t') == indent.npos ? "" : " (a tab stands before it: must be spaces)";
}

}  // namespace

ConfigNode ParseYaml(const std::string& text, const std::string& file) {
  try {
    // yaml-cpp takes a quote that is never closed at the end of a file; at a document's it does
    // not.
    const bool ended = text.empty() || text.back() == '\n';
    std::istringstream stream(text + (ended ? "...\n" : "\n...\n"));
    YAML::Parser parser(stream);
    TreeBuilder builder(file);
    if (!parser.HandleNextDocument(builder)) return {};
    ConfigNode root = builder.Take();
    TreeBuilder second(file);
    if (parser.HandleNextDocument(second))
      throw InputError({file, 0}, "", "", "holds more than one YAML document");
    return root;
  } catch (const YAML::Exception& e) {
    throw InputError({file, e.mark.line + 1}, "", "",
                     "bad YAML: " + e.msg + TabHint(text, e.mark.line));
  }
}

namespace {

std::string ReadText(const std::filesystem::path& file, const InputFiles& files) {
  const std::string& text = files.Read(file, kMaxBytes);
  if (!IsUtf8Text(text)) throw InputError({file.string(), 0}, "", "", "not a text file (UTF-8)");
  return text;
}

// Whether a text that is no YAML holds this key all the same.
bool HoldsKey(const std::string& text, std::string_view key) {
  for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at + 1)) {
    const bool begins = at == 0 || std::string_view("\n{, \"'").find(text[at - 1]) != text.npos;
    const std::size_t end = text.find_first_not_of("\"' ", at + key.size());
    if (begins && end != text.npos && text[end] == ':') return true;
  }
  return false;
}

}  // namespace

ConfigNode ReadYamlFile(const std::filesystem::path& path) {
  return ParseYaml(ReadText(path, InputFiles()), path.string());
}

ConfigNode ReadYamlFile(const std::filesystem::path& path, const InputFiles& files,
                        std::string_view marker) {
  const std::string text = ReadText(path, files);
  try {
    return ParseYaml(text, path.string());
  } catch (const InputError&) {
    if (HoldsKey(text, marker)) throw;
    throw InputError({path.string(), 0}, "", "",
                     "is not YAML with the key `" + std::string(marker) + "`");
  }
}

std::string WriteYaml(const ConfigNode& node) {
  YAML::Emitter out;
  out.SetIndent(2);
  Emit(node, out);
  return std::string(out.c_str()) + "\n";
}

std::string WriteYamlLine(const ConfigNode& node) {
  YAML::Emitter out;
  out.SetSeqFormat(YAML::Flow);
  out.SetMapFormat(YAML::Flow);
  Emit(node, out);
  return out.c_str();
}

std::string QuotedYaml(const std::string& text) {
  YAML::Emitter out;
  out << YAML::DoubleQuoted << text;
  return out.c_str();
}

}  // namespace floorproof

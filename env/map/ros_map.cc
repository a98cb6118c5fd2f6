// SPDX-License-Identifier: Apache-2.0
#include "env/map/ros_map.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "base/config.h"
#include "base/input_file.h"
#include "base/params.h"
#include "media/media.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMaxPixels = 64'000'000;
// More of them take longer to plan for than anybody waits, and gigabytes (bench_plan_area).
constexpr double kMaxFineCells = 40e6;
constexpr int kSaversUnknown = 205;  // the grey that every map_saver writes for unknown

enum class Mode { kTrinary, kScale, kRaw };

struct Keys {
  fs::path image;
  SourceMark image_mark;
  double resolution_m = 0;
  Pose2 X_WG;
  bool negate = false;
  double occupied_thresh = 0, free_thresh = 0;
  Mode mode = Mode::kTrinary;
};

const std::vector<std::string> kKnown = {"image",           "resolution",  "origin", "negate",
                                         "occupied_thresh", "free_thresh", "mode"};

// The value of a key that map_server needs; a misspelt one is named.
const ConfigNode& Need(const ConfigNode& node, const std::string& key) {
  if (const ConfigNode* value = node.Find(key)) return *value;
  std::string rule = "missing; a ROS map needs it";
  std::vector<std::string> foreign;
  for (const auto& [name, value] : node.entries)
    if (std::ranges::find(kKnown, name) == kKnown.end()) foreign.push_back(name);
  if (const std::string near = Nearest(key, foreign); !near.empty())
    rule += " (is " + near + " it, misspelt?)";
  throw InputError({node.mark.file, 0}, key, "", rule);
}

bool ReadNegate(const ConfigNode& node) {
  std::string text = AsString(node, "negate");
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  if (text == "1" || text == "true" || text == "yes" || text == "on") return true;
  if (text == "0" || text == "false" || text == "no" || text == "off") return false;
  throw InputError(node.mark, "negate", text, "must be 0, 1, true or false");
}

Mode ReadMode(const ConfigNode& node) {
  const std::string text = AsString(node, "mode");
  if (text == "trinary") return Mode::kTrinary;
  if (text == "scale") return Mode::kScale;
  if (text == "raw") return Mode::kRaw;
  throw InputError(node.mark, "mode", text, "must be trinary, scale or raw");
}

Pose2 ReadOrigin(const ConfigNode& node) {
  if (!node.IsList() || node.items.size() != 3)
    throw InputError(node.mark, "origin", "", "must be [x, y, yaw], in metres and radians");
  const Bounds place = Between(-1e6, 1e6);
  return {AsDouble(node.items[0], "origin[0]", place), AsDouble(node.items[1], "origin[1]", place),
          WrapAngle(AsDouble(node.items[2], "origin[2]", Between(-1e3, 1e3)))};
}

// Whether the file begins as an image does: the picture is what people think of as the map. What
// cannot be read is told by who reads it.
bool IsImage(const fs::path& file, const InputFiles& files) {
  if (!files.WhyUnreadable(file, kMaxImageBytes).empty()) return false;
  const std::string start = files.ReadStart(file, 4, kMaxImageBytes);
  const bool netpbm = start.size() > 2 && start[0] == 'P' && start[1] >= '1' && start[1] <= '6' &&
                      std::isspace(static_cast<unsigned char>(start[2]));
  return netpbm || start.starts_with("\x89PNG") || start.starts_with("BM");
}

// The .yaml of the image's name that lies beside it; empty: none does.
std::string YamlBeside(fs::path image) {
  image.replace_extension(".yaml");
  return WhyUnreadable(image, kMaxImageBytes).empty() ? image.string() : "";
}

void RefuseImage(const fs::path& yaml_path, const InputFiles& files) {
  if (!IsImage(yaml_path, files)) return;
  const std::string beside = YamlBeside(yaml_path);
  throw InputError(
      {yaml_path.string(), 0}, "", "",
      "is the map's image: name its .yaml, which says how large a pixel is and where it lies" +
          (beside.empty() ? "" : ", " + beside));
}

Keys ReadKeys(const fs::path& yaml_path, const InputFiles& files) {
  RefuseImage(yaml_path, files);
  const ConfigNode node = ReadYamlFile(yaml_path, files, "image");
  if (!node.IsMap())
    throw InputError({yaml_path.string(), 0}, "", "", "is not a ROS map (image, resolution, ...)");
  for (const char* kind : {"scenario", "site"})
    if (node.Find(kind) != nullptr && node.Find("image") == nullptr)
      throw InputError({yaml_path.string(), 0}, "", "",
                       std::string("is a ") + kind +
                           ", not a ROS map: name the map's own .yaml (image, resolution, ...)");
  Keys keys;
  const ConfigNode& image = Need(node, "image");
  keys.image = PathIn(yaml_path.parent_path(), image, "image");
  keys.image_mark = image.mark;
  if (fs::path(image.scalar).is_absolute()) files.MarkAbsolute(keys.image);
  keys.resolution_m = AsDouble(Need(node, "resolution"), "resolution", Between(1e-4, 100));
  keys.X_WG = ReadOrigin(Need(node, "origin"));
  keys.occupied_thresh = AsDouble(Need(node, "occupied_thresh"), "occupied_thresh", Between(0, 1));
  const ConfigNode& free = Need(node, "free_thresh");
  keys.free_thresh = AsDouble(free, "free_thresh", Between(0, 1));
  if (keys.free_thresh > keys.occupied_thresh)
    throw InputError(free.mark, "free_thresh", free.scalar,
                     "must be at most occupied_thresh, " + FormatDouble(keys.occupied_thresh));
  if (const ConfigNode* negate = node.Find("negate")) keys.negate = ReadNegate(*negate);
  if (const ConfigNode* mode = node.Find("mode")) keys.mode = ReadMode(*mode);
  return keys;
}

// The image, or where else it may lie when it is not where the map says.
Image ReadMapImage(const Keys& keys, const fs::path& yaml_path, const InputFiles& files) {
  if (std::string rule = files.WhyUnreadable(keys.image, kMaxImageBytes); !rule.empty()) {
    const fs::path beside = yaml_path.parent_path() / keys.image.filename();
    if (beside != keys.image && WhyUnreadable(beside, kMaxImageBytes).empty())
      rule +=
          "; one of that name lies beside the map: write image: " + keys.image.filename().string();
    throw InputError(keys.image_mark, "image", keys.image.string(), rule);
  }
  return ReadImage(keys.image, kMaxPixels, files);
}

// Cell states by the sum of the channels that count, from 0 (black) to 255 x channels.
std::vector<CellState> StateBySum(const Keys& keys, int channels) {
  const int white = 255 * channels;
  std::vector<CellState> states(static_cast<std::size_t>(white) + 1);
  const auto by_threshold = [&](double p) {
    if (p > keys.occupied_thresh) return CellState::kOccupied;
    return p < keys.free_thresh ? CellState::kFree : CellState::kUnknown;
  };
  const auto by_percent = [](double percent) {
    if (percent == 100) return CellState::kOccupied;
    return percent == 0 ? CellState::kFree : CellState::kUnknown;
  };
  for (int sum = 0; sum <= white; ++sum) {
    // One division of whole numbers: p is the double nearest to the exact fraction.
    const double p = static_cast<double>(keys.negate ? sum : white - sum) / white;
    CellState state = by_threshold(p);
    if (keys.mode == Mode::kScale && state == CellState::kUnknown &&
        keys.free_thresh < keys.occupied_thresh) {
      const double share = (p - keys.free_thresh) / (keys.occupied_thresh - keys.free_thresh);
      state = by_percent(std::rint(share * 100.0));
    }
    if (keys.mode == Mode::kRaw) {
      const double percent = std::round(static_cast<double>(sum) / channels);
      if (percent > 100)
        state = CellState::kUnknown;
      else if (percent == 0 || percent == 100)
        state = by_percent(percent);
      else
        state = by_threshold(percent / 100);
    }
    states[static_cast<std::size_t>(sum)] = state;
  }
  return states;
}

struct Tally {
  std::int64_t free = 0;
  std::int64_t savers_unknown_free = 0;  // pixels of grey 205 that came out free
};

Grid<CellState> ToCells(const Image& image, const Keys& keys, Tally& tally) {
  const bool has_alpha = image.channels == 2 || image.channels == 4;
  const int colors = image.channels - (has_alpha ? 1 : 0);
  // Grey is averaged as its three equal colours, which matters where alpha is a fourth.
  const int weight = colors == 1 ? 3 : 1;
  const bool average_alpha = has_alpha && keys.mode == Mode::kTrinary;
  const std::vector<CellState> states = StateBySum(keys, average_alpha ? 4 : 3);

  Grid<CellState> cells(image.width, image.height);
  const std::uint8_t* pixel = image.data.data();
  for (int row = 0; row < image.height; ++row) {
    CellState* out = &cells.cells[cells.Index(0, image.height - 1 - row)];
    for (int ix = 0; ix < image.width; ++ix, pixel += image.channels) {
      int sum = 0;
      for (int k = 0; k < colors; ++k) sum += weight * pixel[k];
      const bool is_205 = sum == 3 * kSaversUnknown;
      if (average_alpha) sum += pixel[colors];
      CellState state = states[static_cast<std::size_t>(sum)];
      if (keys.mode == Mode::kScale && has_alpha && pixel[colors] != 255)
        state = CellState::kUnknown;
      out[ix] = state;
      if (state == CellState::kFree) {
        ++tally.free;
        tally.savers_unknown_free += is_205;
      }
    }
  }
  return cells;
}

std::vector<std::string> Warnings(const Keys& keys, const Image& image, const Tally& tally,
                                  const fs::path& yaml_path) {
  std::vector<std::string> out;
  const std::string file = yaml_path.string() + ": ";
  if (tally.savers_unknown_free > 0) {
    std::string why = "free_thresh " + FormatDouble(keys.free_thresh) +
                      " is above its 0.196; write 0.196 if it is unknown";
    if (keys.mode == Mode::kTrinary && image.channels % 2 == 0)
      why = "mode trinary counts an alpha channel as one more colour; save the image without";
    out.push_back(file + "grey 205, which map savers write for unknown, counts as free in " +
                  std::to_string(tally.savers_unknown_free) + " cells: " + why);
  }
  if (tally.free == 0) out.push_back(file + "no cell is free");
  if (keys.mode == Mode::kRaw && keys.negate)
    out.push_back(file + "negate does nothing in mode raw");
  return out;
}

}  // namespace

void RefuseMapImage(const fs::path& file, const std::string& expected, const InputFiles& files) {
  if (!IsImage(file, files)) return;
  const std::string beside = YamlBeside(file);
  throw InputError({file.string(), 0}, "", "",
                   "is an image, not " + expected + ": `floorproof init " +
                       (beside.empty() ? "MAP.yaml" : beside) +
                       "` writes a site and a scenario for the ROS map that names it");
}

void CheckFloorSize(const GridFrame& frame, const SourceMark& mark, const std::string& key) {
  const double per_cell = std::max(1.0, std::ceil(frame.cell_m / 0.05 - 1e-9));
  const double cells = static_cast<double>(frame.width) * frame.height * per_cell * per_cell;
  if (cells > kMaxFineCells)
    throw InputError(mark, key, FormatDouble(frame.cell_m),
                     "the floor measures " +
                         std::to_string(std::lround(frame.width * frame.cell_m)) + " m x " +
                         std::to_string(std::lround(frame.height * frame.cell_m)) + " m, " +
                         std::to_string(std::lround(cells / 1e6)) +
                         " million cells of at most 0.05 m; at most 40 million are taken (100000 "
                         "m^2 in cells of 0.05 m)");
}

RosMap ReadRosMap(const fs::path& yaml_path, const InputFiles& files) {
  const Keys keys = ReadKeys(yaml_path, files);
  const Image image = ReadMapImage(keys, yaml_path, files);
  RosMap map;
  map.image = keys.image;
  map.frame = {image.width, image.height, keys.resolution_m, keys.X_WG};
  CheckFloorSize(map.frame, {yaml_path.string(), 0}, "resolution");
  Tally tally;
  map.occupancy = ToCells(image, keys, tally);
  map.warnings = Warnings(keys, image, tally, yaml_path);
  return map;
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// One more than each limit allows. The files are made when their test runs.
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

using Text = std::function<std::string()>;

std::string Listed(int count, const std::function<std::string(int)>& item) {
  std::string list = "[";
  for (int i = 0; i < count; ++i) list += (i > 0 ? ", " : "") + item(i);
  return list + "]";
}
std::string Numbers(int count, int from = 1) {
  return Listed(count, [&](int i) { return std::to_string(from + i); });
}
// On a circle.
std::string Polygon(int corners) {
  return Listed(corners, [=](int i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    return "[" + std::to_string(2 + std::cos(angle)) + ", " + std::to_string(2 + std::sin(angle)) +
           "]";
  });
}

BadInput Many(const std::string& name, const std::string& file, Text text,
              std::vector<std::string> named) {
  BadInput input{name, {"run", "scenario.yaml", "--out", "o"}, {}, std::move(named)};
  input.prepare = [file, text = std::move(text)](const fs::path& folder) {
    std::ofstream(folder / file, std::ios::binary) << text();
    return true;
  };
  return input;
}
BadInput InSite(const std::string& name, const std::string& key, Text text,
                std::vector<std::string> named) {
  named.insert(named.begin(), "site.yaml:3: ");
  return Many(
      name, "site.yaml",
      [key, text = std::move(text)] {
        return "site: 1\nmap: map.yaml\n" + key + ": " + text() + "\n";
      },
      std::move(named));
}
BadInput InScenario(const std::string& name, const std::string& where, Text text,
                    std::vector<std::string> named) {
  return Many(
      name, "scenario.yaml",
      [text = std::move(text)] { return GoodFiles().at("scenario.yaml") + text() + "\n"; },
      [&] {
        named.insert(named.begin(), "scenario.yaml:" + where);
        return std::move(named);
      }());
}
// A key of the good scenario with another value.
BadInput Set(const std::string& name, const std::string& key, const std::string& value,
             std::vector<std::string> named) {
  return {name, {"run", "scenario.yaml", "--set", key + "=" + value}, {}, std::move(named)};
}

}  // namespace

std::vector<BadInput> InputLimitCases() {
  const auto polygon = [](int corners) {
    return "{type: carpet, polygon_m: " + Polygon(corners) + "}";
  };
  return {
      InSite("HazardsOfASite", "hazards", [] { return Listed(10'001, [](int) { return "{}"; }); },
             {"hazards = 10,001 hazards: must be a list of at most 10000 hazards"}),
      InSite("CornersOfAPolygon", "hazards", [=] { return "[" + polygon(10'001) + "]"; },
             {"hazards[0].polygon_m = 10,001 points: must be a list of 3 to 10000 points"}),
      InSite("CornersOfASite", "hazards",
             [=] { return Listed(51, [&](int) { return polygon(1'000); }); },
             {"hazards[50].polygon_m = 51,000 corners up to here: a site's hazards have at most "
              "50000 corners together"}),
      InSite("NameOfASite", "name", [] { return std::string(201, 'n'); },
             {"name = nnn", "...: must be at most 200 bytes"}),
      InScenario("NameOfAScenario", "13: ", [] { return "name: " + std::string(201, 'n'); },
                 {"name = nnn", "...: must be at most 200 bytes"}),
      InScenario("Variants", "14: ", [] { return "matrix:\n  robot.mass_kg: " + Numbers(1'001); },
                 {"matrix.robot.mass_kg = 1,001 variants: must be at most 1000 variants"}),
      InScenario("VariantsOfSeveralKeys", "14: ",
                 [] {
                   return "matrix:\n  robot.mass_kg: " + Numbers(26) +
                          "\n  time_limit_s: " + Numbers(39);
                 },
                 {"matrix = 1,014 variants: must be at most 1000 variants"}),
      InScenario("Choices", "14: ",
                 [] { return "randomise:\n  robot.mass_kg: {choice: " + Numbers(1'001) + "}"; },
                 {"randomise.robot.mass_kg.choice = 1,001 values: must be a list of at most 1000"}),
      InScenario("RangesOfADraw", "14: ",
                 [] {
                   return "randomise:\n  robot.mass_kg: {uniform: " +
                          Listed(1'001,
                                 [](int i) {
                                   return "[" + std::to_string(2 * i) + ", " +
                                          std::to_string(2 * i + 1) + "]";
                                 }) +
                          "}";
                 },
                 {"randomise.robot.mass_kg.uniform = 1,001 values: must be a list of at most"}),
      InScenario("DrawnKeys", "14: ",
                 [] {
                   std::string keys = "randomise:\n";
                   for (int i = 0; i < 1'001; ++i)
                     keys += "  k" + std::to_string(i) + ": {uniform: [0, 1]}\n";
                   return keys;
                 },
                 {"randomise = 1,001 keys: must be a map of at most 1000 keys"}),
      Many("RowsOfAPlan", "plan.csv",
           [] {
             std::string rows = "x_m,y_m\n";
             for (int i = 0; i < 250'001; ++i) rows += i % 2 ? "1,1\n" : "2,1\n";
             return rows;
           },
           {"plan.csv:250002: a file has at most 250000 rows, a waypoint each"}),
      Set("WidthOfAFilm", "video.width", "100000",
          {"--set video.width:1: video.width = 100000: must be in [64, 1920]"}),
      Set("HeightOfAFilm", "video.height", "1082",
          {"--set video.height:1: video.height = 1082: must be in [64, 1080]"}),
      Set("BeamsOfALidar", "sensors.lidar.beams", "3601",
          {"--set sensors.lidar.beams:1: sensors.lidar.beams = 3601: must be in [1, 3600]"}),
  };
}

}  // namespace floorproof

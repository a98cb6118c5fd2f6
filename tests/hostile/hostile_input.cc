// SPDX-License-Identifier: Apache-2.0
#include "tests/hostile/hostile_input.h"

#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <stdexcept>

#include "apps/run_floorproof.h"
#include "tests/bad_input/bad_input.h"
#include "tests/bad_input/child.h"
#include "tests/places.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

struct Kind {
  std::vector<std::string> spoiled;                  // files, of which one or two are spoiled
  std::vector<std::vector<std::string>> commands;    // of which one is run
  std::vector<std::vector<std::string>> first = {};  // that make the good files
};

const std::map<std::string, Kind>& Kinds() {
  const std::vector<std::string> plan = {"plan", "scenario.yaml", "--out", "o"};
  const std::vector<std::string> scene = {"scene", "scenario.yaml", "--out", "o.xml"};
  const std::vector<std::string> drive = {"run", "scenario.yaml", "--out",
                                          "o",   "--set",         "time_limit_s=1"};
  const std::vector<std::vector<std::string>> campaign = {
      {"campaign", "drawn.yaml", "-n", "2", "--jobs", "1", "--set", "gate=none", "--set",
       "time_limit_s=1", "--no-films", "--out", "r"}};
  static const std::map<std::string, Kind> kinds = {
      {"scenario", {{"scenario.yaml"}, {plan, scene, drive}}},
      {"site", {{"site.yaml"}, {plan, scene}}},
      {"map", {{"map.yaml", "map.pgm"}, {plan, {"init", "map.yaml", "--out", "o"}}}},
      {"plan", {{"plan.csv"}, {plan}}},
      {"robot", {{"robot.xml"}, {{"scene", "robot.yaml", "--out", "o.xml"}}}},
      {"urdf", {{"robot.urdf"}, {{"scene", "urdf.yaml", "--out", "o.xml"}}}},
      {"mission", {{"mission.yaml"}, {{"plan", "mission_drive.yaml", "--out", "o"}}}},
      {"fmea", {{"fmea.yaml"}, {{"plan", "fmea_plan.yaml", "--out", "o"}}}},
      {"run_folder",
       {{"r/scenario.resolved.yaml", "r/result.json", "r/plan.json", "r/trace.csv", "r/replay.bin",
         "r/plan.csv", "r/files.sha256"},
        {{"report", "r"}, {"replay", "r"}},
        {{"run", "drawn.yaml", "--out", "r", "--set", "time_limit_s=1"}}}},
      {"campaign_folder",
       {{"r/campaign.sqlite", "r/summary.json", "r/scenario.resolved.yaml", "r/files.sha256"},
        {{"report", "r"},
         {"compare", "r", "r"},
         {"merge", "r", "--out", "m"},
         {"replay", "r", "--episode", "0"}},
        campaign}},
      {"program", {{"plan.sh"}, {{"plan", "asks.yaml", "--trust", "--out", "o"}}}}};
  return kinds;
}

Files MoreFiles() {
  const Files& good = GoodFiles();
  const auto with = [&](const std::string& from, const std::string& to) {
    return Replaced(good.at("scenario.yaml"), from, to);
  };
  return {{"robot.xml", Slurp(SourceFile("models/beluga.xml"))},
          {"robot.yaml", with("robot: beluga", "robot: ./robot.xml")},
          {"robot.urdf", Slurp(SourceFile("models/others/turtlebot3_burger.urdf"))},
          {"urdf.yaml", with("robot: beluga", "robot: ./robot.urdf")},
          {"mission.yaml", Slurp(SourceFile("models/missions/follow_plan.yaml"))},
          {"mission_drive.yaml", with("seed: 3", "seed: 3\nmission: mission.yaml\nsafety: {}")},
          {"fmea.yaml", Slurp(SourceFile("models/fmea/htetro.yaml"))},
          {"fmea_plan.yaml", with("seed: 3", "seed: 3\nrisk: {tables: fmea.yaml}")},
          {"plan.sh", "#!/bin/sh\nprintf 'x_m,y_m\\n1.0,1.0\\n1.6,1.0\\n' > \"$1\"/plan.csv\n"},
          {"asks.yaml", with("{file: plan.csv}", "{command: [./plan.sh], timeout_s: 1}")}};
}

// Draws one.
template <class T>
const T& OneOf(const std::vector<T>& of, std::mt19937_64& random) {
  return of[random() % of.size()];
}

const std::vector<std::string>& HostileNumbers() {
  static const std::vector<std::string> numbers = {"nan",    "-inf",       ".inf",
                                                   "1e999",  "-1",         "0",
                                                   "1e-320", "1e300",      "99999999999999999999",
                                                   "-0.0",   "0x10",       "1_000",
                                                   "1,5",    "2147483648", "1e9",
                                                   "''",     "[]",         "{}",
                                                   "null",   "true"};
  return numbers;
}

std::vector<std::string> HostileTexts(const fs::path& outside) {
  return {"/proc/self/environ",
          "/dev/zero",
          "/dev/stdin",
          (outside / "environ").string(),
          "../" + outside.filename().string() + "/yaml",
          "../../../../../../etc/passwd",
          "/",
          ".",
          "link",
          "pipe",
          std::string(5000, 'a'),
          "\xe2\x80\xae"
          "evil",
          "\x1b[31m",
          "\xff\xfe",
          std::string("nul\0l", 5),
          "*alias",
          "&a [*a, *a]",
          "!!python/object:os.system",
          "<script>alert(1)</script>",
          "=cmd|' /C calc'!A0",
          "%s%s%n",
          "{{7*7}}"};
}

// Where numbers begin and how long they are.
std::vector<std::pair<std::size_t, std::size_t>> NumbersIn(const std::string& text) {
  constexpr std::string_view kOfNumbers = "0123456789.eE+-";
  std::vector<std::pair<std::size_t, std::size_t>> numbers;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && kOfNumbers.find(text[end]) != std::string_view::npos) ++end;
    if (end > i &&
        std::any_of(text.begin() + static_cast<long>(i), text.begin() + static_cast<long>(end),
                    [](char c) { return c >= '0' && c <= '9'; }))
      numbers.emplace_back(i, end - i);
    i = std::max(end, i + 1);
  }
  return numbers;
}

std::size_t LineAt(const std::string& text, std::mt19937_64& random) {
  const std::size_t at = text.empty() ? 0 : random() % text.size();
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return before == std::string::npos ? 0 : before + 1;
}

// One change to a text; what it was.
std::string Change(std::string& text, std::mt19937_64& random, const fs::path& outside) {
  const auto at = [&] { return text.empty() ? 0 : random() % text.size(); };
  switch (random() % 9) {
    case 0:
    case 1: {
      const auto numbers = NumbersIn(text);
      if (numbers.empty()) return "nothing";
      const auto& [from, size] = OneOf(numbers, random);
      const std::string& number = OneOf(HostileNumbers(), random);
      text.replace(from, size, number);
      return "a number made " + number;
    }
    case 2: {  // the value of a key, or a word
      const std::vector<std::string> texts = HostileTexts(outside);
      const std::size_t from = text.find_first_of(":,\"", at());
      if (from == std::string::npos) return "nothing";
      const std::size_t end = text.find_first_of(",}\"\n", from + 1);
      text.replace(from + 1, end == std::string::npos ? 0 : end - from - 1,
                   " " + OneOf(texts, random));
      return "a value made hostile";
    }
    case 3: {
      const std::size_t from = LineAt(text, random);
      text.erase(from, text.find('\n', from) - from);
      return "a line left out";
    }
    case 4: {
      const std::size_t from = LineAt(text, random), end = text.find('\n', from);
      const std::string line = text.substr(from, end == std::string::npos ? end : end + 1 - from);
      for (auto n = random() % 3 + 1; n > 0; --n) text.insert(from, line);
      return "a line repeated";
    }
    case 5:
      text.resize(at());
      return "cut off";
    case 6:
      if (!text.empty()) text[at()] = static_cast<char>(random());
      return "a byte changed";
    case 7: {
      std::string bytes(random() % 8 + 1, '\0');
      for (char& c : bytes) c = static_cast<char>(random());
      text.insert(at(), bytes);
      return "bytes put in";
    }
    default: {
      const std::size_t a = LineAt(text, random), b = LineAt(text, random);
      text = text.substr(std::max(a, b)) + text.substr(0, std::min(a, b));
      return "parts exchanged";
    }
  }
}

// In a file's place: what is no plain file, or another kind of file.
std::string Exchange(const fs::path& file, std::mt19937_64& random, const fs::path& outside) {
  fs::remove(file);
  switch (random() % 5) {
    case 0:
      fs::create_symlink("/proc/self/environ", file);
      return "a link to the environment";
    case 1:
      fs::create_symlink(outside / "assignment", file);
      return "a link to a secret";
    case 2:
      mkfifo(file.c_str(), 0600);
      return "a pipe";
    case 3:
      fs::create_directory(file);
      return "a folder";
    default:
      fs::create_symlink(file.filename(), file);
      return "a loop of links";
  }
}

const std::vector<std::string>& Scripts() {
  static const std::vector<std::string> scripts = {"exit 3",
                                                   "sleep 60",
                                                   "kill -9 $$",
                                                   "yes > \"$1\"/plan.csv & sleep 60",
                                                   "ln -s /proc/self/environ \"$1\"/plan.csv",
                                                   "mkfifo \"$1\"/plan.csv",
                                                   "printf 'x_m,y_m\\nnan,1\\n' > \"$1\"/plan.csv",
                                                   "printf '\\377\\376' > \"$1\"/plan.csv",
                                                   "head -c 100000 /dev/urandom >&2; exit 1",
                                                   "rm -rf \"$1\"",
                                                   "chmod 0 \"$1\"",
                                                   "(sleep 60 &) ; exit 0",
                                                   "printf 'x_m,y_m\\n1e9,1\\n' > \"$1\"/plan.csv"};
  return scripts;
}

}  // namespace

const std::vector<std::string>& HostileKinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, kind] : Kinds()) all.push_back(name);
    return all;
  }();
  return names;
}

void MakeGoodFiles(const std::string& kind, const fs::path& folder) {
  for (const Files& files : {GoodFiles(), MoreFiles()})
    for (const auto& [name, content] : files)
      std::ofstream(folder / name, std::ios::binary) << content;
  fs::permissions(folder / "plan.sh", fs::perms::owner_all);
  for (const std::vector<std::string>& command : Kinds().at(kind).first) {
    const ChildResult made = RunForked(RunFloorproof, command, folder);
    if (made.status != 0 && made.status != 1)
      throw std::runtime_error(kind + ": the good files are not made: " + made.err);
  }
}

HostileInput Spoil(const std::string& name, std::uint64_t seed, const fs::path& folder,
                   const fs::path& outside) {
  std::mt19937_64 random(seed);
  const Kind& kind = Kinds().at(name);
  HostileInput input{OneOf(kind.commands, random), ""};
  fs::create_symlink(outside / "environ", folder / "link");
  mkfifo((folder / "pipe").c_str(), 0600);
  const std::string& spoiled = OneOf(kind.spoiled, random);
  const fs::path file = folder / spoiled;
  if (name == "program") {
    const std::string& script = OneOf(Scripts(), random);
    std::ofstream(file, std::ios::binary) << "#!/bin/sh\n" << script << "\n";
    input.what = script;
  } else if (random() % 20 == 0) {
    input.what = spoiled + ": " + Exchange(file, random, outside);
  } else {
    std::string text = Slurp(file);
    for (auto n = random() % 3 + 1; n > 0; --n)
      input.what += (input.what.empty() ? spoiled + ": " : ", ") + Change(text, random, outside);
    std::ofstream(file, std::ios::binary) << text;
  }
  return input;
}

}  // namespace floorproof

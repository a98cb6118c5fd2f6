// SPDX-License-Identifier: Apache-2.0
// Files that are not YAML, or far larger than anybody writes.
#include <filesystem>
#include <fstream>
#include <functional>

#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

BadInput Scenario(const std::string& name, const std::string& text,
                  std::vector<std::string> named) {
  return {
      name, {"run", "scenario.yaml", "--out", "o"}, {{"scenario.yaml", text}}, std::move(named)};
}

// A scenario of megabytes, which is made when its test runs: all cases are held in memory, copied,
// each time that one of them starts.
BadInput Long(const std::string& name, std::function<std::string()> text,
              std::vector<std::string> named) {
  BadInput input = Scenario(name, "", std::move(named));
  input.prepare = [text = std::move(text)](const std::filesystem::path& folder) {
    std::ofstream(folder / "scenario.yaml", std::ios::binary) << text();
    return true;
  };
  return input;
}

// Ten levels of ten aliases each: 10^10 values from 500 bytes.
std::string ManyLaughs() {
  std::string text = "scenario: 1\na0: &a0 [ha, ha, ha, ha, ha, ha, ha, ha, ha, ha]\n";
  for (int level = 1; level < 10; ++level) {
    const std::string below = "*a" + std::to_string(level - 1);
    text += "a" + std::to_string(level) + ": &a" + std::to_string(level) + " [" + below;
    for (int i = 1; i < 10; ++i) text += ", " + below;
    text += "]\n";
  }
  return text;
}

std::string Repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

}  // namespace

std::vector<BadInput> YamlCases() {
  const std::string first = "scenario: 1\n";
  const std::string file = "floorproof: scenario.yaml";
  return {
      Scenario("Empty", "", {file, "must be a map of keys"}),
      Scenario("OnlyAComment", "# nothing\n", {file, "must be a map of keys"}),
      Scenario("AList", "- scenario\n- 1\n", {file, "must be a map of keys"}),
      Scenario("JustText", "hello\n", {file, "must be a map of keys"}),
      Scenario("WrongIndent", first + "robot: beluga\n  seed: 1\n", {file + ":3", "bad YAML"}),
      Scenario("OpenBracket", first + "start: [1, 2\n", {file + ":", "bad YAML"}),
      Scenario("OpenQuote", first + "robot: \"beluga\n", {file + ":", "bad YAML"}),
      Scenario("TabIndent", first + "robot:\n\tname: beluga\n",
               {file + ":3", "bad YAML", "a tab stands before it"}),
      Scenario("UnknownAlias", first + "robot: *r\n", {file + ":2", "bad YAML", "r"}),
      Scenario("AliasInItself", first + "robot: &r [*r]\n", {file + ":2", "alias"}),
      Scenario("ManyLaughs", ManyLaughs(), {file + ":", "values (aliases expanded)"}),
      Long("NestedBrackets",
           [first] { return first + "robot: " + std::string(20'000, '[') + "\n"; },
           {file + ":2", "nested more than 100 levels deep"}),
      Long("NestedBraces", [first] { return first + "robot: " + Repeated("{a: ", 20'000) + "\n"; },
           {file + ":2", "nested more than 100 levels deep"}),
      Long("NestedDashes",
           [first] { return first + "robot:\n  " + Repeated("- ", 20'000) + "1\n"; },
           {file + ":3", "nested more than 100 levels deep"}),
      Long("ManyValues",
           [first] { return first + "robot: [" + Repeated("1,", 1'200'000) + "1]\n"; },
           {file + ":2", "values (aliases expanded)"}),
      Long("OneLongTextManyTimes",
           [first] {
             return first + "name: &a " + std::string(1'000'000, 'x') + "\nrobot: [*a" +
                    Repeated(", *a", 4'000) + "]\n";
           },
           {file + ":", "MiB of memory (aliases expanded)"}),
      Long("NestedAnchors",
           [first] {
             std::string text = first + "robot: ";
             for (int i = 0; i < 95; ++i) text += "&a" + std::to_string(i) + " [";
             return text + std::string(2'000'000, 'x') + std::string(95, ']') + "\n";
           },
           {file + ":", "MiB of memory (aliases expanded)"}),
      Long("ManyOtherKeys",
           [first] {
             std::string text = first + "randomise:\n";
             for (int i = 0; i < 100'000; ++i) text += "  k" + std::to_string(i) + ": 1\n";
             return text;
           },
           {file + ":3: randomise = 100,000 keys"}),
      Scenario("AnEscapeInAName", first + "name: \"a\\e[2Jb\"\n",
               {file + ":2", "name", "holds a control character"}),
      Scenario("ATurnedName", first + "name: a\u202egnp.exe\n",
               {file + ":2", "holds a mark of writing direction"}),
      Long("ManyKeys", [first] { return first + Repeated("k: 1\n", 100'000); },
           {file + ":3", "k", "stands twice"}),
      // What takes the parser longest, byte for byte.
      Long("PlainTextInBrackets",
           [first] { return first + "robot: [" + Repeated("x ", 1'500'000) + "]\n"; },
           {file + ":", "the key is missing"}),
      Long("LargerThanAnybodyWrites",
           [first] { return first + "robot: [" + Repeated("x ", 2'000'000) + "]\n"; },
           {file + ": ", "larger than 3 MiB"}),
      Long("LongLine",
           [first] {
             return first + "site: site.yaml\nrobot: " + std::string(3'000'000, 'x') + "\n";
           },
           {file + ":3", "robot = xxxxxxxx", "...", "unknown robot"}),
      Scenario("TwiceTheSameKey", first + "seed: 1\nseed: 2\n",
               {file + ":3", "seed", "stands twice", "line 2"}),
      Scenario("AKeyThatIsAList", first + "? [a, b]\n: 1\n", {file + ":2", "plain text"}),
      Scenario("ATag", first + "robot: !!python/object:os.system beluga\n",
               {file + ":2", "tags are not allowed"}),
      Scenario("TwoDocuments", first + "---\nscenario: 1\n", {file, "more than one YAML document"}),
      Scenario("Binary",
               std::string("\x7f"
                           "ELF\2\1\1\0\0\0",
                           10),
               {file, "not a text file"}),
      Scenario("ANulByte", first + std::string("robot: bel\0uga\n", 15), {file, "not a text file"}),
      Scenario("Latin1", first + "name: caf\xe9\n", {file, "not a text file"}),
      Scenario("Utf16", std::string("\xff\xfes\0c\0e\0n\0", 10), {file, "not a text file"}),
      {"LargerThanAnyScenario",
       {"run", "scenario.yaml"},
       {},
       {file, "larger than", "MiB"},
       [](const std::filesystem::path& folder) {
         std::error_code error;  // a file of holes: nothing is stored
         std::filesystem::resize_file(folder / "scenario.yaml", 3ULL << 30, error);
         return !error;
       }},
  };
}

}  // namespace floorproof

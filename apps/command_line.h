// SPDX-License-Identifier: Apache-2.0
// Options and arguments of the commands. The library that parses them is read in one file alone.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace floorproof {

// One command. A name that begins with a dash is an option, any other an argument. What is written
// into must live until the command has run.
class Subcommand {
 public:
  enum class Need { kOptional, kRequired };

  explicit Subcommand(CLI::App& app) : app_(app) {}

  void Text(const std::string& name, std::string& into, const std::string& help,
            Need need = Need::kOptional);
  // Its help states the value that `into` has now.
  void TextWithDefault(const std::string& name, std::string& into, const std::string& help);
  void OneOf(const std::string& name, std::string& into, const std::string& help,
             const std::vector<std::string>& known, Need need = Need::kOptional);
  // `count`: how many are asked for; none: one or more.
  void Texts(const std::string& name, std::vector<std::string>& into, const std::string& help,
             Need need = Need::kOptional, std::optional<int> count = {});
  void Integer(const std::string& name, int& into, const std::string& help, int least, int most,
               Need need = Need::kOptional);
  void Integer(const std::string& name, std::uint64_t& into, const std::string& help, int least,
               int most, Need need = Need::kOptional);
  void NonNegative(const std::string& name, int& into, const std::string& help);
  void NonNegative(const std::string& name, std::int64_t& into, const std::string& help);
  void Number(const std::string& name, std::optional<double>& into, const std::string& help,
              double least, double most);
  void Flag(const std::string& name, bool& into, const std::string& help);
  void OnRun(std::function<void()> run);

 private:
  CLI::App& app_;
};

class CommandLine {
 public:
  explicit CommandLine(CLI::App& app) : app_(app) {}
  Subcommand Add(const std::string& name, const std::string& help);

 private:
  CLI::App& app_;
};

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace floorproof {
namespace {

CLI::Option* Require(CLI::Option* option, Subcommand::Need need) {
  return option->required(need == Subcommand::Need::kRequired);
}

}  // namespace

Subcommand CommandLine::Add(const std::string& name, const std::string& help) {
  CLI::App* command = app_.add_subcommand(name, help);
  command->footer(
      "Every command takes --set KEY=VALUE, --json and --quiet: see floorproof --help.");
  return Subcommand(*command);
}

void Subcommand::Text(const std::string& name, std::string& into, const std::string& help,
                      Need need) {
  Require(app_.add_option(name, into, help), need);
}

void Subcommand::TextWithDefault(const std::string& name, std::string& into,
                                 const std::string& help) {
  app_.add_option(name, into, help)->capture_default_str();
}

void Subcommand::OneOf(const std::string& name, std::string& into, const std::string& help,
                       const std::vector<std::string>& known, Need need) {
  Require(app_.add_option(name, into, help), need)->check(CLI::IsMember(known));
}

void Subcommand::Texts(const std::string& name, std::vector<std::string>& into,
                       const std::string& help, Need need, std::optional<int> count) {
  CLI::Option* option = Require(app_.add_option(name, into, help), need);
  if (count) option->expected(*count);
}

void Subcommand::Integer(const std::string& name, int& into, const std::string& help, int least,
                         int most, Need need) {
  Require(app_.add_option(name, into, help), need)->check(CLI::Range(least, most));
}

void Subcommand::Integer(const std::string& name, std::uint64_t& into, const std::string& help,
                         int least, int most, Need need) {
  Require(app_.add_option(name, into, help), need)->check(CLI::Range(least, most));
}

void Subcommand::NonNegative(const std::string& name, int& into, const std::string& help) {
  app_.add_option(name, into, help)->check(CLI::Range(0, std::numeric_limits<int>::max()));
}

void Subcommand::NonNegative(const std::string& name, std::int64_t& into, const std::string& help) {
  app_.add_option(name, into, help)
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
}

void Subcommand::Number(const std::string& name, std::optional<double>& into,
                        const std::string& help, double least, double most) {
  app_.add_option(name, into, help)
      ->check(CLI::Range(least, most))
      ->check([](const std::string& text) {  // it passes for one within any range
        return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is no number" : "";
      });
}

void Subcommand::Flag(const std::string& name, bool& into, const std::string& help) {
  app_.add_flag(name, into, help);
}

void Subcommand::OnRun(std::function<void()> run) { app_.callback(std::move(run)); }

}  // namespace floorproof

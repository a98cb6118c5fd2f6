// SPDX-License-Identifier: Apache-2.0
#include "apps/run_floorproof.h"

#include <floorproof/version.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <span>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/printable.h"

namespace floorproof {
#define FP_COMMAND(Function) void Function(CommandLine&, const Globals&, int&);
#include "apps/commands.inc"
#undef FP_COMMAND

namespace {

// The parser's message, which quotes arguments whole, with long ones cut.
std::string CutArguments(std::string message, std::span<char* const> arguments) {
  constexpr std::size_t kMaxArgument = 60;
  for (const std::string_view argument : arguments) {
    // The parser takes `--option=VALUE` apart.
    for (const std::string_view quoted : {argument, argument.substr(argument.find('=') + 1)}) {
      const std::string cut = CutEnd(quoted, kMaxArgument);
      if (cut.size() == quoted.size()) continue;
      if (const std::size_t at = message.find(quoted); at != std::string::npos)
        message.replace(at, quoted.size(), cut);
    }
  }
  return ErrorLine(message);
}

// What is wrong with a command line, with the nearest known word; in one line.
std::string ParseErrorText(const CLI::App& app, const CLI::ParseError& error,
                           std::span<char* const> arguments) {
  const auto commands = app.get_subcommands();
  const CLI::App& at = commands.empty() ? app : *commands.front();
  std::vector<std::string> known;
  std::string kind = "option";
  const auto rest = app.remaining(true);
  const auto first = std::ranges::find_if(
      rest, [&](const std::string& word) { return commands.empty() || word.starts_with("-"); });
  if (first == rest.end()) return CutArguments(error.what(), arguments);
  if (first->starts_with("-")) {
    for (const CLI::App* part : {&at, &app})
      for (const CLI::Option* option : part->get_options())
        if (!option->get_positional()) known.push_back(option->get_name());
  } else {
    kind = "command";
    for (const CLI::App* command : app.get_subcommands(nullptr))
      known.push_back(command->get_name());
  }
  return InputError({}, "", *first, "unknown " + kind + DidYouMean(*first, known)).what();
}

// True if all output was written; otherwise prints an error.
bool StdoutIsWritten() {
  const bool written =
      std::cout.flush().good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!written) std::fprintf(stderr, "floorproof: stdout cannot be written\n");
  return written;
}

}  // namespace

int RunFloorproof(int argc, char** argv) {
  CatchInterrupts();
  // If the reader of stdout ends, files are still written.
  std::signal(SIGPIPE, SIG_IGN);
  // The parent process may have ignored it; then the exit status of a child would be lost.
  std::signal(SIGCHLD, SIG_DFL);
  CLI::App app{
      "Floorproof drives a floor robot's plan through physics before the robot drives it over a "
      "floor.\nStart with `floorproof demo`, or with your own map: `floorproof init MAP.yaml`, "
      "then "
      "`floorproof run scenario.yaml --video`.",
      "floorproof"};
  Globals globals;
  int status = kExitDone;
  app.set_version_flag("--version", FLOORPROOF_VERSION);
  app.add_flag("--json", globals.json, "The result as JSON on stdout; all else goes to stderr");
  app.add_flag("--quiet", globals.quiet, "Say nothing but errors");
  app.add_option("--set", globals.sets,
                 "Override a scenario's key: --set key.path=value (repeatable; site.key.path "
                 "reaches into the site)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("--trust", globals.trusted,
               "Let the scenario run the program that it names and read files outside its folder");
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Exit status: 0 done; 1 the outcome is not success, a plan was not found, or a gate failed; "
      "2 "
      "bad usage or\nbad input; 3 the tool or the physics broke, or the disk is full; 4 a gate is "
      "undecided; 130 "
      "interrupted (what was done is kept).");
  CommandLine line(app);
#define FP_COMMAND(Function) Function(line, globals, status);
#include "apps/commands.inc"
#undef FP_COMMAND

  // An error while cleaning up after an interrupt is printed; the status stays "interrupted".
  const auto said = [](int failure) {
    if (Interrupted()) EndInterrupted();
    return failure;
  };
  try {
    app.parse(argc, argv);
    return StdoutIsWritten() ? status : kExitBroken;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {  // --help, --version
      const int code = app.exit(e);
      return StdoutIsWritten() ? code : kExitBroken;
    }
    std::fprintf(stderr, "floorproof: %s (floorproof --help)\n",
                 ParseErrorText(app, e, {argv, static_cast<std::size_t>(argc)}).c_str());
    return kExitBadInput;
  } catch (const Interruption&) {
    EndInterrupted();
  } catch (const InputError& e) {
    std::fprintf(stderr, "floorproof: %s\n", e.what());
    return said(kExitBadInput);
  } catch (const std::filesystem::filesystem_error& e) {
    std::fprintf(stderr, "floorproof: %s\n",
                 InputError({e.path1().string(), 0}, "", "", e.code().message()).what());
    return said(IsOfTheDisk(e.code()) ? kExitBroken : kExitBadInput);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "floorproof: %s\n", ErrorLine(e.what()).c_str());
    return said(kExitBroken);
  }
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include <floorproof/version.h>

#include <cstdio>
#include <exception>

#include "apps/command.h"

namespace floorproof {
#define FP_COMMAND(Function) void Function(CLI::App&, const Globals&, int&);
#include "apps/commands.inc"
#undef FP_COMMAND
}  // namespace floorproof

int main(int argc, char** argv) {
  using namespace floorproof;
  CLI::App app{
      "Floorproof drives a floor robot's plan through physics before the robot drives it over a "
      "floor.\nStart with `floorproof demo`, or with your own map: `floorproof init MAP.yaml`, "
      "then "
      "`floorproof run scenario.yaml --video`.",
      "floorproof"};
  Globals globals;
  int status = kDone;
  app.set_version_flag("--version", FLOORPROOF_VERSION);
  app.add_flag("--json", globals.json, "The result as JSON on stdout; all else goes to stderr");
  app.add_flag("--quiet", globals.quiet, "Say nothing but errors");
  app.add_option("--set", globals.sets,
                 "Override a scenario's key: --set key.path=value (repeatable; site.key.path "
                 "reaches into the site)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Exit status: 0 done; 1 the outcome is not success, or a plan was not found; 2 bad usage or "
      "bad input;\n3 the tool or the physics broke; 130 interrupted (what was done is kept).");
#define FP_COMMAND(Function) Function(app, globals, status);
#include "apps/commands.inc"
#undef FP_COMMAND

  try {
    app.parse(argc, argv);
    return status;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    std::fprintf(stderr, "floorproof: %s (floorproof --help)\n", e.what());
    return kBadInput;
  } catch (const InputError& e) {
    std::fprintf(stderr, "floorproof: %s\n", e.what());
    return kBadInput;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "floorproof: %s\n", e.what());
    return kBroken;
  }
}

// SPDX-License-Identifier: Apache-2.0
#include "apps/command.h"

#include <csignal>
#include <cstdio>

namespace floorproof {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

void OnSignal(int signal_number) {
  if (g_interrupted) std::_Exit(kInterruptedExit);
  g_interrupted = 1;
  std::signal(signal_number, OnSignal);
}

}  // namespace

std::vector<Override> Globals::Overrides() const {
  std::vector<Override> overrides;
  for (const auto& text : sets) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError({"--set", 0}, text, "", "must be key.path=value");
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

void Globals::Say(const std::string& line) const {
  if (quiet) return;
  std::FILE* out = json ? stderr : stdout;
  std::fprintf(out, "%s\n", line.c_str());
  std::fflush(out);
}

void Globals::Result(const nlohmann::ordered_json& json_result) const {
  if (json) std::printf("%s\n", json_result.dump(2).c_str());
}

void CatchInterrupts() {
  std::signal(SIGINT, OnSignal);
  std::signal(SIGTERM, OnSignal);
}

bool Interrupted() { return g_interrupted != 0; }

std::filesystem::path OutputFolder(const std::string& out, const Scenario& scenario) {
  return out.empty() ? std::filesystem::path("out") / scenario.name : std::filesystem::path(out);
}

}  // namespace floorproof

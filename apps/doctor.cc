// SPDX-License-Identifier: Apache-2.0
#include <floorproof/version.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/usable_cores.h"
#include "env/scene/models_folder.h"
#include "render/gl_context.h"

namespace floorproof {

void AddDoctor(CommandLine& line, const Globals& globals, int&) {
  line.Add("doctor", "Versions, GL backend, threads: what this machine can do").OnRun([&globals] {
    const GlReport gl = ProbeGl();
    nlohmann::ordered_json json = {{"floorproof", FLOORPROOF_VERSION},
                                   {"compiler", FLOORPROOF_COMPILER},
                                   {"mujoco", mj_versionString()},
                                   {"threads", UsableCores()},
                                   {"models", ModelsFolder().string()},
                                   {"gl",
                                    {{"backend", gl.backend},
                                     {"renderer", gl.renderer},
                                     {"version", gl.version},
                                     {"failures", gl.failures}}}};
    globals.Say(fmt::format("floorproof {} ({})", FLOORPROOF_VERSION, FLOORPROOF_COMPILER));
    globals.Say(fmt::format("MuJoCo {}", mj_versionString()));
    globals.Say(fmt::format("threads {}", UsableCores()));
    globals.Say("models " + ModelsFolder().string());
    globals.Say(gl.backend.empty()
                    ? "pictures: no GL backend (driving works; films do not)"
                    : fmt::format("pictures: {} ({}; {})", gl.backend, gl.renderer, gl.version));
    for (const auto& failure : gl.failures) globals.Say("  " + failure);
    globals.Result(json);
  });
}

}  // namespace floorproof

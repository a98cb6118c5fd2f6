// SPDX-License-Identifier: Apache-2.0
// floorproof._core: the C++ library as Python sees it. Nested values travel as JSON text, numbers
// in bulk as numpy arrays; python/floorproof makes of them what users see.
#include "python/bindings/host.h"
#include "python/bindings/modules.h"

NB_MODULE(_core, m) {
  using namespace floorproof;
  // Plug-ins and their table live as long as the interpreter.
  nb::set_leak_warnings(false);
  BindHost(m);
  BindScenario(m);
  BindEpisode(m);
  BindPictures(m);
  BindPlannerPlugins(m);
  BindOnlinePlugins(m);
  BindTrackerPlugins(m);
  BindCampaign(m);
  BindStepped(m);
}

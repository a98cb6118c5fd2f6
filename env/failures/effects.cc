// SPDX-License-Identifier: Apache-2.0
// Effects after the hTetro FMEA paper: Table 2 defines them by damage and by the help needed,
//   E1 no damage, more time, alone      E2 recoverable damage, alone
//   E3 recoverable damage, needs a person   E4 irrevocable damage, yet completes   E5 irrevocable,
//   the end
// and Table 3 gives P(Fj, Ek) for hTetro. An event gets its mode's most probable effect:
//   F1 E1 (0.75)   F2 E3 (0.9)   F3 E5 (0.7)   F4 E1 (0.55).
// One kind differs from its mode: a robot that only tips off a wheel stands and can be set back by
// a person. That is the other effect of roll over in Table 3, E3 (0.3).
#include "env/failures/effects.h"

#include <array>

namespace floorproof {
namespace {

struct Row {
  FailureMode mode;
  std::string_view kind;  // empty: any kind that has no row of its own
  std::string_view effect;
};

constexpr std::array kEffects = {
    Row{FailureMode::kRollOver, "tipped", "E3"}, Row{FailureMode::kVeerOff, "", "E1"},
    Row{FailureMode::kStuck, "", "E3"},          Row{FailureMode::kRollOver, "", "E5"},
    Row{FailureMode::kBounceBack, "", "E1"},
};

}  // namespace

std::string_view EffectOf(FailureMode mode, std::string_view kind) {
  for (const Row& row : kEffects)
    if (row.mode == mode && (row.kind.empty() || row.kind == kind)) return row.effect;
  return "";
}

}  // namespace floorproof

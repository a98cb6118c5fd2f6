// SPDX-License-Identifier: Apache-2.0
// Numbers as people read them: plain decimals, thousands grouped, never in powers of ten.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace floorproof {

// So many significant digits, zeros at the end left out: 0.0866, 94.6, 136,000, 0.00000123. NaN and
// infinity: "–".
std::string NumberText(double value, int digits = 3);
// So many decimals: 0.50, 1,160.0. NaN and infinity: "–".
std::string FixedText(double value, int decimals);
// A share in percent: "25 %", "100 %".
std::string PercentText(double share, int digits = 3);
// An energy given in J: "551 J", "51.1 kJ", "1,160 kJ".
std::string EnergyText(double energy_j);
// A length given in m: "15 mm" below a metre, "1.25 m" from there on.
std::string LengthText(double length_m);
// A time given in s: "8.2 s", "964 s", from two hours on "2.7 h".
std::string TimeText(double time_s);
// So many of what `one` names in the singular: "1 turn", "1,250 turns".
template <std::integral Number>
std::string CountText(Number n, std::string_view one) {
  return FixedText(static_cast<double>(n), 0).append(" ").append(one).append(n == 1 ? "" : "s");
}
// What exceeds a limit, and the limit, with as many decimals as tell them apart (`decimals` at
// least, six at most): "0.2504 m, limit 0.2500 m" is not "0.25 m, limit 0.25 m". `unit` may be
// empty.
struct Compared {
  std::string value, limit;
};
Compared ComparedText(double value, double limit, int decimals, std::string_view unit);

}  // namespace floorproof

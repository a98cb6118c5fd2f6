// SPDX-License-Identifier: Apache-2.0
#include "measure/measured_fmea_yaml.h"

#include <fmt/format.h>

#include "base/params.h"
#include "base/round.h"
#include "stats/outward.h"

namespace floorproof {
namespace {

constexpr std::array kClassNames = {"blind object", "glass", "level change", "terrain"};
constexpr std::array kModeNames = {"veer off", "stuck in place", "roll over", "bounce back"};

std::string Ends(const Interval& interval, const char* between) {
  const Interval told = RoundedOutward(interval);
  return FormatDouble(RoundedTo6(told.lower)) + between + FormatDouble(RoundedTo6(told.upper));
}

// Nothing was counted: said, and not filled with a number.
std::string Counts(const CountedShare& share) {
  if (share.of == 0) return "p: none";
  return fmt::format("k: {}, p: {}, lower: {}", share.events,
                     FormatDouble(RoundedTo6(share.value())), Ends(share.interval, ", upper: "));
}

std::string Compared(const ComparedShare& share) {
  std::string text =
      fmt::format("{{experts: {}, {}", FormatDouble(share.experts), Counts(share.measured));
  if (share.measured.of > 0) text += fmt::format(", excluded: {}", share.excluded());
  return text + "}";
}

void WriteShares(const std::string& indent, const std::string& key, const EncounterShares& shares,
                 std::string& text) {
  text +=
      fmt::format("{}{}:\n{}  encounters: {}\n{}  censored: {}\n{}  none: {{{}}}\n", indent, key,
                  indent, shares.encounters, indent, shares.censored, indent, Counts(shares.none));
  for (std::size_t m = 0; m < shares.modes.size(); ++m)
    text += fmt::format("{}  F{}: {{{}}}\n", indent, m + 1, Counts(shares.modes[m]));
}

void WriteClass(const MeasuredFmea& fmea, std::size_t c, std::string& text) {
  const MeasuredClass& of = fmea.classes[c];
  text += fmt::format("  C{}:\n    name: {}\n    types: [{}]\n", c + 1, kClassNames[c],
                      fmt::join(of.types, ", "));
  text += fmt::format("    detectability: {{experts: {}, not_sensed: {{{}}}}}\n",
                      FormatDouble(fmea.experts.detectability[c]), Counts(of.not_sensed));
  WriteShares("    ", "all", of.all, text);
  for (std::size_t side = 0; side < kLeadingSides.size(); ++side)
    for (std::size_t fast = 0; fast < 2; ++fast)
      WriteShares("    ", fmt::format("{}_{}", kLeadingSides[side], fast ? "fast" : "slow"),
                  of.by_way[side][fast], text);
  text += "    given_failure:\n";
  for (std::size_t m = 0; m < of.given_failure.size(); ++m)
    text += fmt::format("      F{}: {}\n", m + 1, Compared(of.given_failure[m]));
}

void WriteExcluded(const std::string& what, const ComparedShare& share, int& count,
                   std::string& text) {
  if (!share.excluded()) return;
  text +=
      fmt::format("\n  - \"{}: experts {}, measured {} [{}], {} of {}\"", what,
                  FormatDouble(share.experts), FormatDouble(RoundedTo6(share.measured.value())),
                  Ends(share.measured.interval, ", "), share.measured.events, share.measured.of);
  ++count;
}

// What stands as none everywhere.
void WriteMissing(const MeasuredFmea& fmea, std::string& text) {
  int detections = 0, effects = 0;
  for (const MeasuredClass& of : fmea.classes) detections += of.not_sensed.of;
  for (const auto& of_mode : fmea.effect_of_mode) effects += of_mode[0].measured.of;
  std::string missing;
  if (effects == 0)
    missing += "\n  - \"effects: what became of the robot after a failure was not recorded\"";
  if (detections == 0)
    missing +=
        "\n  - \"detectability: the robot carries no sensors that tell of hazards, or what they "
        "told "
        "was not recorded\"";
  text += "missing:" + (missing.empty() ? " []" : missing) + "\n";
}

}  // namespace

std::string MeasuredFmeaYaml(const MeasuredFmea& fmea, const std::string& robot,
                             const std::vector<std::string>& sensors) {
  std::string text =
      "# What an encounter with a hazard of each class comes to, counted in physics; the figures "
      "of\n"
      "# the experts' tables beside. p: the share, with its exact 95 % interval; none: nothing "
      "was\n"
      "# counted. The shares are of the sizes, ways and floors that were driven, and of no "
      "others.\n";
  // WriteYaml ends the line.
  text += fmt::format("fmea_measured: 1\nrobot: {}sensors: [{}]\nslow_below_mps: {}\n",
                      WriteYaml(ConfigNode::Scalar(robot, true)), fmt::join(sensors, ", "),
                      FormatDouble(fmea.slow_below_mps));
  text += fmt::format(
      "# Of effects: damage by the drop of one edge that has as much energy a kilogram. Assumed, "
      "not "
      "measured.\n"
      "damage: {{recoverable_drop_mm: {}, lasting_drop_mm: {}}}\nclasses:\n",
      FormatDouble(RoundedTo6(1000 * fmea.limits.recoverable_drop_m)),
      FormatDouble(RoundedTo6(1000 * fmea.limits.lasting_drop_m)));
  for (std::size_t c = 0; c < kNumHazardClasses; ++c) WriteClass(fmea, c, text);
  text += "modes:\n";
  for (std::size_t m = 0; m < kNumFailureModes; ++m) {
    text += fmt::format("  F{}:\n    name: {}\n    effects:\n", m + 1, kModeNames[m]);
    for (std::size_t k = 0; k < kNumEffects; ++k)
      text += fmt::format("      E{}: {}\n", k + 1, Compared(fmea.effect_of_mode[m][k]));
  }
  // One in twenty figures that are right would stand here by chance.
  text += "excluded:";
  int count = 0;
  for (std::size_t c = 0; c < kNumHazardClasses; ++c)
    for (std::size_t m = 0; m < kNumFailureModes; ++m)
      WriteExcluded(fmt::format("P(C{} -> F{}) given a failure", c + 1, m + 1),
                    fmea.classes[c].given_failure[m], count, text);
  for (std::size_t m = 0; m < kNumFailureModes; ++m)
    for (std::size_t k = 0; k < kNumEffects; ++k)
      WriteExcluded(fmt::format("P(F{} -> E{})", m + 1, k + 1), fmea.effect_of_mode[m][k], count,
                    text);
  text += count == 0 ? " []\n" : "\n";
  WriteMissing(fmea, text);
  return text;
}

}  // namespace floorproof

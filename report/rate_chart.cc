// SPDX-License-Identifier: Apache-2.0
#include "report/rate_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "env/geometry/geometry.h"
#include "planners/risk/rate_model.h"
#include "report/html.h"

namespace floorproof {
namespace {

// What keys alone do not say.
constexpr std::pair<std::string_view, std::string_view> kTitles[] = {
    {"heading_rad", "way, off square on"},
    {"lead_rad", "side that leads, from forward"},
    {"gap_m", "gap"},
    {"width_share", "share of its width"},
    {"turn_rad", "turn on the way"},
    {"turn_gap_m", "from its centre to the edge, turning"},
    {"over_m", "way there"},
    {"wall_m", "distance of the wall beside"},
    {"estimate_error_m", "error of its place"},
    {"estimate_error_rad", "error of its heading"},
    {kSureGap, "gap, less the error of its place"},
    {kAskew, "body, off square on"}};

struct Plot {
  static constexpr double kLeft = 44, kTop = 10, kWidth = 240, kHeight = 110;
  double low, high, reach;
  double X(double value) const { return kLeft + kWidth * (value - low) / (high - low); }
  double Y(double rate) const { return kTop + kHeight * (1 - std::clamp(rate / reach, 0.0, 1.0)); }
};

// 1, 2 or 5 times a power of ten; three to six of them fit.
double TickStep(double range) {
  const double least = range / 6, decade = std::pow(10, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (least <= step * decade * (1 + 1e-9)) return step * decade;
  return 10 * decade;
}

std::string Axes(const Plot& plot, const KeyScale& scale) {
  std::string svg;
  for (const double share : {0.0, 0.5, 1.0})
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/><text x=\"{3}\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
        Plot::kLeft, Plot::kLeft + Plot::kWidth, plot.Y(share * plot.reach), Plot::kLeft - 6,
        plot.Y(share * plot.reach) + 4, PercentText(share * plot.reach));
  const double step = TickStep(scale.per * (plot.high - plot.low));
  const double first = std::ceil(scale.per * plot.low / step - 1e-9),
               last = std::floor(scale.per * plot.high / step + 1e-9);
  for (int i = 0; i <= static_cast<int>(last - first); ++i) {
    const double at = (first + i) * step;
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                       plot.X(at / scale.per), Plot::kTop + Plot::kHeight + 16,
                       NumberText(first + i == 0 ? 0 : at, 3));
  }
  return svg;
}

}  // namespace

std::string AxisTitle(std::string_view type, const AxisFinding& axis) {
  if (axis.of_hazard) {
    if (axis.name == kRise) return "height or depth";
    return NameOfKey(fmt::format("{}.{}", type, axis.name)).name;
  }
  for (const auto& [name, title] : kTitles)
    if (axis.name == name) return std::string(title);
  return NameOfKey(axis.name).name;
}

KeyScale AxisScale(const AxisFinding& axis) {
  if (axis.name.ends_with("_rad")) return {180 / kPi, "°"};
  const double most =
      std::max(std::abs(axis.groups.front().low), std::abs(axis.groups.back().high));
  return ScaleOf(NameOfKey(axis.name), most);
}

std::string RateChart(std::string_view type, const AxisFinding& axis, double reach,
                      const std::string& name) {
  const std::string title = AxisTitle(type, axis);
  // From the first group to the last, with room for their marks: single far values would press the
  // groups together.
  const double low = axis.groups.front().mean, high = axis.groups.back().mean,
               room = 0.04 * (high - low);
  const Plot plot{low - room, high + room, reach};
  std::string svg = fmt::format(
      "<figure><svg class=\"chart\" viewBox=\"0 0 300 144\" role=\"img\" aria-label=\"{}\">\n",
      MarkupText("Share of " + name + " that fails, by " + title +
                 "; the numbers stand in the "
                 "table below"));
  svg += Axes(plot, AxisScale(axis));
  const std::string unit = AxisScale(axis).unit;
  std::string line;
  for (const AxisGroup& group : axis.groups) {
    const double x = plot.X(group.mean);
    svg += fmt::format(
        "<line class=\"bar\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\"/>", x,
        plot.Y(group.counted.lower), plot.Y(group.counted.upper));
    svg += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"/>\n",
                       group.counted.k > 0 ? "point" : "none", x, plot.Y(group.counted.rate));
    line += fmt::format("{}{:.1f},{:.1f}", line.empty() ? "" : " ", x, plot.Y(group.expected));
  }
  svg += fmt::format(
      "<polyline class=\"rates-line\" points=\"{}\"/></svg><figcaption>{}"
      "</figcaption></figure>\n",
      line, MarkupText(unit.empty() ? title : title + ", " + unit));
  return svg;
}

}  // namespace floorproof

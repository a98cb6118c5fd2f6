// SPDX-License-Identifier: Apache-2.0
#include "report/rates_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "report/html.h"

namespace floorproof {
namespace {

struct Plot : RatesPlot {
  double At(double rate) const { return std::clamp(100 * rate / reach, 0.0, 100.0); }

  std::string Axis() const {
    std::string svg = "<svg class=\"axis\" aria-hidden=\"true\">";
    for (const auto& [share, anchor] :
         {std::pair(0.0, "start"), std::pair(0.5, "middle"), std::pair(1.0, "end")})
      svg += fmt::format("<text x=\"{:.0f}%\" y=\"12\" text-anchor=\"{}\">{}</text>", 100 * share,
                         anchor, PercentText(share * reach));
    return svg + "</svg>";
  }

  std::string Row(const FailureRate& rate) const {
    std::string svg = fmt::format("<svg class=\"plot\" role=\"img\" aria-label=\"{}\">",
                                  PercentText(Interval{rate.lower, rate.upper}));
    for (const int x : {0, 50, 100})
      svg += fmt::format("<line class=\"grid\" x1=\"{0}%\" x2=\"{0}%\" y1=\"0\" y2=\"100%\"/>", x);
    if (limit && (limit_of.empty() || limit_of == rate.name))
      svg += fmt::format(
          "<line class=\"limit\" x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"0\" y2=\"100%\"/>",
          At(*limit));
    svg += fmt::format("<line class=\"bar\" x1=\"{:.2f}%\" x2=\"{:.2f}%\" y1=\"50%\" y2=\"50%\"/>",
                       At(rate.lower), At(rate.upper));
    for (const double end : {rate.lower, rate.upper})
      svg += fmt::format(
          "<line class=\"bar\" x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"30%\" y2=\"70%\"/>", At(end));
    if (rate.n > 0)
      svg += fmt::format("<circle class=\"{}\" cx=\"{:.2f}%\" cy=\"50%\" r=\"4\"/>",
                         rate.k > 0 ? "point" : "none", At(rate.rate));
    return svg + "</svg>";
  }
};

}  // namespace

double AxisEnd(double most) {
  for (double decade = 1e-9; decade < 1; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (most <= step * decade * (1 + 1e-9)) return step * decade;
  return 1;
}

std::string RatesTable(const RatesPlot& drawn, const std::string& heading,
                       const std::vector<std::string>& names, const std::vector<FailureRate>& rates,
                       bool total) {
  const Plot plot{drawn};
  std::string html = fmt::format(
      "<table class=\"rates\"><thead><tr><th scope=\"col\">{}</th><th scope=\"col\" "
      "class=\"num\">{}</th><th scope=\"col\" class=\"num\">Rate</th><th scope=\"col\" "
      "class=\"num\">{} interval</th><th scope=\"col\" "
      "class=\"plotted\"><span class=\"off\">Rate and interval, drawn</span>{}</th></tr></thead>"
      "<tbody>\n",
      heading, drawn.counted, PercentText(kReportedConfidence), plot.Axis());
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const FailureRate& rate = rates[i];
    html += fmt::format(
        "<tr{}><th scope=\"row\">{}</th><td class=\"num\">{} of {}</td><td class=\"num\">{}</td>"
        "<td class=\"num\">{}</td><td class=\"plotted\">{}</td></tr>\n",
        total && i == 0 ? " class=\"total\"" : "", MarkupText(names[i]), rate.k, rate.n,
        rate.n > 0 ? PercentText(rate.rate) : "–", PercentText(Interval{rate.lower, rate.upper}),
        plot.Row(rate));
  }
  return html + "</tbody></table>\n";
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/dirt_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantity.h"
#include "render/contact_sheet.h"
#include "render/heatmap.h"
#include "report/pictures.h"
#include "report/sample_marks.h"
#include "run/scenario/world.h"

namespace floorproof {
namespace {

// Onto white, `right` to the right of `left`, their upper edges level.
Image Beside(const Image& left, const Image& right) {
  Image both = GreyImage(left.width + right.width, std::max(left.height, right.height), 255);
  const auto stride = [](const Image& image) { return 3 * static_cast<std::size_t>(image.width); };
  std::size_t first = 0;
  for (const Image* part : {&left, &right}) {
    for (std::size_t y = 0; y < static_cast<std::size_t>(part->height); ++y)
      std::copy_n(part->data.data() + y * stride(*part), stride(*part),
                  both.data.data() + y * stride(both) + first);
    first += stride(*part);
  }
  return both;
}

// Half the median distance of a tape from the next one: so wide each one's score is shown.
double ReachOf(const std::vector<AuditedSample>& samples) {
  constexpr double kLeast_m = 0.1, kMost_m = 0.5;
  std::vector<double> nearest_m;
  for (const AuditedSample& a : samples) {
    double m = std::numeric_limits<double>::infinity();
    for (const AuditedSample& b : samples)
      if (&a != &b) m = std::min(m, (a.X_WT.p() - b.X_WT.p()).norm());
    nearest_m.push_back(m);
  }
  if (nearest_m.empty()) return kLeast_m;
  const auto middle = nearest_m.begin() + static_cast<std::ptrdiff_t>(nearest_m.size() / 2);
  std::ranges::nth_element(nearest_m, middle);
  return std::clamp(*middle / 2, kLeast_m, kMost_m);
}

// On cells of floor within reach of a tape, the score of the nearest one.
HeatValues ScoresAround(const FloorAudit& audit) {
  HeatValues heat;
  heat.frame = audit.dirt_frame;
  constexpr int kFiner = 2;
  heat.frame.cell_m /= kFiner;
  heat.frame.width *= kFiner, heat.frame.height *= kFiner;
  heat.values = Grid<float>(heat.frame.width, heat.frame.height, HeatValues::kNone);
  Grid<float> away(heat.frame.width, heat.frame.height, std::numeric_limits<float>::infinity());
  const double reach_m = ReachOf(audit.samples);
  const int around = static_cast<int>(std::ceil(reach_m / heat.frame.cell_m));
  for (const AuditedSample& taken : audit.samples) {
    if (!taken.sample.read()) continue;
    const Cell middle = heat.frame.ToCell(taken.X_WT.p());
    for (int iy = middle.iy - around; iy <= middle.iy + around; ++iy)
      for (int ix = middle.ix - around; ix <= middle.ix + around; ++ix) {
        if (!heat.values.Inside(ix, iy)) continue;
        const double m = (heat.frame.Center(ix, iy) - taken.X_WT.p()).norm();
        const bool floor = std::isfinite(audit.dirt_per_m2(ix / kFiner, iy / kFiner));
        if (!floor || m > reach_m || m >= static_cast<double>(away(ix, iy))) continue;
        away(ix, iy) = static_cast<float>(m);
        heat.values(ix, iy) = static_cast<float>(taken.sample.score.score);
      }
  }
  return heat;
}

// Most of the values: a few cells beside them, as a strip along a wall, do not pale all others.
double HighEnd(const Grid<float>& values) {
  std::vector<float> all;
  std::ranges::copy_if(values.cells, std::back_inserter(all),
                       [](float v) { return std::isfinite(v); });
  if (all.empty()) return 1;
  const auto nth =
      all.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(all.size() - 1));
  std::ranges::nth_element(all, nth);
  return std::max(1.0, static_cast<double>(*nth));
}

std::string ScoreText(const RegionScore& region) {
  if (!region.score.mean) return "none";
  const std::string mean = fmt::format("{:.3f}", *region.score.mean);
  if (region.interval)
    return mean +
           fmt::format(" ({:.3f} to {:.3f})", region.interval->lower, region.interval->upper);
  return mean + (region.score.standard_error ? " (no interval: a lattice; see samples.jitter)"
                                             : " (too few samples for an interval)");
}

}  // namespace

std::string AuditText(const World& world, const PlanResult& plan, const FloorAudit& audit) {
  std::string text =
      fmt::format("{} of {} taken, {} dirty (more than {} particles); score {}",
                  audit.samples.size(), CountText(plan.samples.size(), "sample"),
                  audit.gathering.dirty, world.dirt->params.dirty_above, ScoreText(audit.region));
  constexpr double kWhole = 0.995;
  if (const SpaceScore& region = audit.region.score; region.mean && region.represented < kWhole)
    text += fmt::format(", of {:.0f} % of the room", 100 * region.represented);
  if (audit.unreadable > 0) text += fmt::format(", {} could not be read", audit.unreadable);
  if (audit.near_walls && audit.elsewhere)
    text += fmt::format(", near walls {}, elsewhere {}", ScoreText(*audit.near_walls),
                        ScoreText(*audit.elsewhere));
  return text;
}

void WriteDirt(const World& world, const PlanResult& plan, const FloorAudit& audit,
               const std::filesystem::path& png) {
  HeatMapOptions dirt, scores;
  dirt.title = fmt::format("{}: true dirt", PictureTitle(world));
  dirt.quantity = "particles a square metre";
  dirt.unit = "1000 / m2; 2 % of it lies above";
  dirt.low = 0;
  dirt.colour_map = scores.colour_map = ColourMap::kCividis;
  HeatValues thousands{audit.dirt_frame, audit.dirt_per_m2};
  for (float& value : thousands.values.cells) value /= 1000;
  dirt.high = HighEnd(thousands.values);
  scores.title = fmt::format("audit: score {}", ScoreText(audit.region));
  scores.quantity = "score of the sample";
  scores.unit = "1: clean";
  scores.reversed = true;
  scores.high = 1;
  scores.series = SampleSeries();
  scores.low = 0.8;  // a floor that is clean all over looks so
  for (const AuditedSample& taken : audit.samples) {
    const SamplePlace& place = plan.samples[static_cast<std::size_t>(taken.stop.place)];
    scores.points.push_back(
        {taken.X_WT.p(), taken.sample.read() ? SampleSeriesOf(place) : "tape, not readable"});
    if (taken.sample.read()) scores.low = std::min(*scores.low, taken.sample.score.score);
  }
  for (std::size_t i = 0; i < plan.samples.size(); ++i) {
    const SamplePlace& place = plan.samples[i];
    const bool taken = std::ranges::any_of(audit.samples, [i](const AuditedSample& a) {
      return static_cast<std::size_t>(a.stop.place) == i;
    });
    if (!taken)
      scores.points.push_back(
          {place.p_W, place.reachable ? "sample not taken" : SampleSeriesOf(place)});
  }
  const HeatValues around = ScoresAround(audit);
  WritePng(png, Beside(DrawHeatMap(world.site.map, &thousands, dirt),
                       DrawHeatMap(world.site.map, &around, scores)));
}

void WriteTapes(const World& world, const PlanResult& plan, const FloorAudit& audit,
                const std::filesystem::path& png) {
  constexpr std::size_t kMost = 30;
  const std::size_t n = audit.samples.size(), shown = std::min(kMost, n);
  const SamplingParams& params = world.dirt->params.sampling;
  std::vector<SheetImage> tapes;
  for (std::size_t i = 0; i < shown; ++i) {
    const AuditedSample& taken = audit.samples[i * n / shown];
    const AuditSample& sample = taken.sample;
    const int visit = plan.samples[static_cast<std::size_t>(taken.stop.place)].visit;
    SheetImage& tape = tapes.emplace_back();
    tape.grey =
        PhotographTape(sample.lifted, params.tape, params.microscope, sample.tape_seed).after;
    for (const Vec2& p_mm : sample.counted.centroids_mm)
      tape.ringed.push_back(p_mm * params.microscope.pixels_per_mm +
                            Vec2(tape.grey.width, tape.grey.height) / 2);
    tape.caption = sample.read()
                       ? fmt::format("{}. {} counted of {}, {:.2f}", visit, sample.counted.count,
                                     sample.lifted.size(), sample.score.score)
                       : fmt::format("{}. {}", visit, Name(sample.status()));
  }
  WritePng(png,
           DrawContactSheet(
               fmt::format("{}: the tapes of {}{}; particles counted, of those lifted; score",
                           PictureTitle(world), shown < n ? std::to_string(shown) + " of " : "",
                           CountText(n, "sample")),
               tapes));
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// A campaign's page: what was found, as one HTML text that needs nothing beside it.
//
// Pictures and small films stand in the page as data; there is no script and no address of any
// network, and a policy in its head lets the browser load none. All texts given here are escaped.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "env/geometry/geometry.h"

namespace floorproof {

// k of n episodes; two-sided bounds. `rate` is NaN at n = 0.
struct ReportRate {
  std::string name{};
  int k = 0, n = 0;
  double rate = 0, lower = 0, upper = 1;
};

// k events over an exposure; NaN or infinite where the exposure says nothing.
struct ReportRatePer {
  std::string name{};
  int k = 0;
  double exposure = 0, rate = 0, lower = 0, upper = 0;
};

struct ReportMetric {
  std::string name{};  // with its unit
  double mean = 0, median = 0, min = 0, max = 0;
};

struct ReportGate {
  enum class Verdict { kPassed, kFailed, kUndecided };
  std::string metric{};  // as in ReportVariant::failures, or another
  double max_rate = 0, confidence = 0;
  std::string mode{};
  Verdict verdict = Verdict::kUndecided;                     // of all variants
  std::vector<std::pair<std::string, std::string>> texts{};  // variant: its sentence
};

struct ReportPlace {
  Vec2 p_W{};  // the square's centre
  ReportRate rate{};
};

// Squares of the floor in which an episode failed; in all others none did.
struct ReportPlaces {
  double cell_m = 0;
  std::vector<ReportPlace> rates{};  // the worst first
};

struct ReportVariant {
  std::string name{};
  int n = 0, errors = 0, not_planned = 0, success = 0, failure = 0, timeout = 0;
  std::vector<ReportRate> failures{};  // the first: any failure
  std::vector<ReportRate> kinds{}, hazards{};
  std::vector<ReportRatePer> per_km{}, per_1000_h{};  // as many as failures, in their order
  std::vector<ReportMetric> metrics{};
  ReportPlaces places{};
  std::string places_png{};   // where failures happened; empty: `places_note` says why
  std::string places_note{};  // also said below a picture
};

// A difference of a metric, b - a, over so many pairs; ends may be infinite or NaN.
struct ReportDifference {
  std::string name{}, pairs{};  // with its unit; which pairs
  int n = 0;
  double mean = 0, mean_lower = 0, mean_upper = 0;
  double median = 0, median_lower = 0, median_upper = 0;
};

// Two variants over the episodes that count in both.
struct ReportPair {
  std::string a{}, b{};
  int both = 0, only_a = 0, only_b = 0, neither = 0;   // failed
  double difference = 0, lower = 0, upper = 0, p = 1;  // of the failure rates, b - a
  std::vector<ReportDifference> metrics{};
  int n() const { return both + only_a + only_b + neither; }
};

struct ReportPicture {
  std::string caption{}, png{};
};

struct ReportFilm {
  std::string variant{}, what{};
  std::uint64_t episode = 0;
  std::string mp4{};   // the film; empty: it is linked
  std::string path{};  // of the film, from the page
  double megabytes = 0;
  std::vector<ReportPicture> frames{}, maps{};
};

struct ReportEpisode {
  std::string variant{};
  std::uint64_t episode = 0;
  std::string what{};    // mode and kind, or the outcome
  std::string detail{};  // hazard, or the message
  std::optional<double> t_s{}, x_m{}, y_m{};
  int further = 0;        // events beyond this one
  std::string command{};  // that films it
};

struct Report {
  std::string title{}, campaign{};
  std::string unfinished{};  // why not all episodes asked for were driven; empty: they were
  std::vector<std::pair<std::string, std::string>> versions{};
  double confidence = 0.95;  // of all intervals
  std::optional<ReportGate> gate{};
  std::vector<ReportVariant> variants{};
  std::vector<ReportPair> pairs{};  // each with the first variant
  std::vector<ReportFilm> films{};
  int films_left_out = 0;
  std::vector<ReportEpisode> episodes{};  // failing ones; as many as the page should show
  std::uint64_t episodes_left_out = 0;
  std::string settings{};  // the scenario, resolved
};

// The verdict in a sentence.
std::string VerdictText(const Report& report);

std::string ReportHtml(const Report& report);

}  // namespace floorproof

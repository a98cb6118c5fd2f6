// SPDX-License-Identifier: Apache-2.0
// A campaign's page: what was found, as one HTML text that needs nothing beside it.
//
// All texts given here are escaped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/html_page.h"
#include "report/page_data.h"
#include "run/campaign/campaign_summary.h"
#include "run/campaign/dependence.h"

namespace floorproof {

// Where a variant's episodes failed.
struct ReportMap {
  std::string png{};      // empty: `note` says why
  PageJson data{};        // MapData of the floor; null: there is none
  std::string note{};     // also said below a picture
  bool left_out = false;  // of so many variants not all have one
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
  int repeats = 0;  // pairs that came out the same and count as one; 0: they differ
  int both = 0, only_a = 0, only_b = 0, neither = 0;   // failed
  double difference = 0, lower = 0, upper = 0, p = 1;  // of the failure rates, b - a
  std::vector<ReportDifference> metrics{};
  int n() const { return both + only_a + only_b + neither; }
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
  std::string title{};
  std::string subject{};  // SubjectOf; empty: it is not known
  CampaignSummary summary{};
  std::vector<VariantDependence> dependence{};  // one a variant of the summary
  std::vector<ReportMap> maps{};                // the same
  std::vector<ReportPair> pairs{};              // each with the first variant
  std::vector<ReportFilm> films{};
  int films_left_out = 0;
  std::vector<ReportEpisode> episodes{};  // failing ones; as many as the page should show
  std::uint64_t episodes_left_out = 0;
  std::string settings{};                                      // the scenario, resolved
  std::string data{};                                          // for the page's scripts, as JSON
  std::vector<std::pair<std::string, std::string>> replays{};  // id and bytes
};

std::string ReportHtml(const Report& report);

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "report/films.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "base/input_file.h"
#include "run/campaign/replay_shelf.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFilms = 24;            // on the page
constexpr std::uintmax_t kAllFilms = 48u << 20;  // in the page, together
constexpr std::uintmax_t kLargestPicture = 8u << 20;

// Episodes whose folder holds a film, ascending.
std::vector<std::uint64_t> Filmed(const fs::path& folder) {
  std::vector<std::uint64_t> ids;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    std::uint64_t id = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), id);
    if (error != std::errc() || end != name.data() + name.size()) continue;
    if (IsPlainFile(entry.path() / "video.mp4")) ids.push_back(id);
  }
  std::ranges::sort(ids);
  return ids;
}

// frame_failure_2 -> "failure 2"
std::string Caption(const std::string& stem) {
  std::string caption = stem.substr(stem.find('_') + 1);
  std::ranges::replace(caption, '_', ' ');
  return caption;
}

}  // namespace

std::vector<ReportPicture> PicturesIn(const fs::path& folder, const std::string& prefix) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().filename().string().starts_with(prefix) &&
        entry.path().extension() == ".png" && !entry.is_symlink(ignored) &&
        WhyUnreadable(entry.path(), kLargestPicture).empty())
      files.push_back(entry.path());
  // In the order of a film: start first, end last.
  const auto rank = [](const fs::path& file) {
    const std::string stem = file.stem().string();
    return std::pair(stem == "frame_start" ? 0 : stem == "frame_end" ? 2 : 1, stem);
  };
  std::ranges::sort(files, {}, rank);
  std::vector<ReportPicture> pictures;
  for (const fs::path& file : files) {
    std::string png = ReadInputFile(file, kLargestPicture);
    if (std::ranges::none_of(pictures, [&](const auto& other) { return other.png == png; }))
      pictures.push_back({Caption(file.stem().string()), std::move(png)});
  }
  return pictures;
}

void AddFilms(const fs::path& folder,
              const std::function<std::string(const std::string&, std::uint64_t)>& what,
              Report& report) {
  std::uintmax_t embedded = 0;
  for (const VariantSummary& variant : report.summary.variants)
    for (const std::uint64_t id : Filmed(VariantFolder(folder, variant.name))) {
      if (report.films.size() == kMaxFilms) {
        ++report.films_left_out;
        continue;
      }
      const fs::path from = EpisodeFolder(folder, variant.name, id), file = from / "video.mp4";
      ReportFilm film{.variant = variant.name, .what = what(variant.name, id), .episode = id};
      film.path = file.lexically_relative(folder).generic_string();
      std::error_code ignored;
      const std::uintmax_t size = fs::file_size(file, ignored);
      film.megabytes = static_cast<double>(size) / 1e6;
      if (WhyUnreadable(file, kLargestFilm).empty() && embedded + size <= kAllFilms) {
        film.mp4 = ReadInputFile(file, kLargestFilm);
        embedded += size;
      }
      film.frames = PicturesIn(from, "frame_");
      film.maps = PicturesIn(from, "heatmap_");
      report.films.push_back(std::move(film));
    }
}

}  // namespace floorproof

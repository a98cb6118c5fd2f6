// SPDX-License-Identifier: Apache-2.0
// What a drive over a dirty floor leaves: pictures, and plan.json written anew.
#include "report/dirt_pictures.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "media/media.h"
#include "report/drive_and_film.h"
#include "report/sample_marks.h"
#include "run/scenario/scenario_file.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class DirtPictures : public OwnFolderTest {
 protected:
  DirtPictures() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "points.csv") << "x_m,y_m\n1,2\n2,1\n2.5,2\n";
  }

  EpisodeRecord Drive(const std::string& dirt) {
    std::ofstream(folder_ / "s.yaml")
        << "scenario: 1\nname: room\nsite: {site: 1, grid: {cell_m: 0.5, rows: \""
           "#######\\n#.....#\\n#.....#\\n#.....#\\n#.....#\\n#######\\n\"}, "
           "start: {x_m: 1, y_m: 1, yaw_deg: 0}}\nrobot: beluga\n"
           "plan: {planner: audit, samples: {file: points.csv}, dwell_s: 1, speed_mps: 0.2}\n" +
               dirt;
    Scenario s = ReadScenario(folder_ / "s.yaml");
    const DriveResult result = DriveAndFilm(s, folder_ / "out", {}, {.quiet = true});
    EXPECT_FALSE(result.not_written);
    if (result.record.audit) said_ = AuditText(s.world, result.plan, *result.record.audit);
    return result.record;
  }
  bool Left(const char* name) const { return fs::exists(folder_ / "out" / name); }
  nlohmann::json Plan() const {
    std::ifstream in(folder_ / "out" / "plan.json");
    return nlohmann::json::parse(in);
  }

  std::string said_;
};

TEST_F(DirtPictures, ADriveOverDirtLeavesMapsTapesAndCounts) {
  const EpisodeRecord record = Drive("dirt: {}\n");
  const Image maps = ReadImage(folder_ / "out" / "heatmap_dirt.png");
  EXPECT_GT(maps.width, 2 * 600);  // two, side by side
  const Image tapes = ReadImage(folder_ / "out" / "plot_tapes.png");
  std::size_t rings = 0;  // red ink, which nothing else on the sheet is drawn in
  for (std::size_t i = 0; i + 2 < tapes.data.size(); i += 3)
    rings += tapes.data[i] > 180 && tapes.data[i + 1] < 90;
  EXPECT_GT(rings, 20u * static_cast<std::size_t>(record.audit->samples[0].sample.counted.count));
  EXPECT_THAT(said_, HasSubstr("3 of 3 samples taken, 3 dirty (more than 10 particles)"));
  const nlohmann::json plan = Plan();
  for (const auto& place : plan["sample_places"]) EXPECT_GT(place["dirt_count"], 10);
}

// Both pictures list the same series, so a place has the same mark in both.
TEST(SampleMarks, EachKindHasOneOfItsOwn) {
  std::vector<SamplePlace> places(5);
  places[0].kinds.boundary = places[0].kinds.corner = true;
  places[1].kinds.boundary = true;
  places[2].kinds.random = true;
  places[3].kinds.given = true;
  for (SamplePlace& place : places) place.reachable = true;
  places[4].kinds.corner = true;
  places[4].reachable = false;
  std::vector<std::string> series;
  for (const SamplePlace& place : places) series.push_back(SampleSeriesOf(place));
  EXPECT_EQ(series, SampleSeries());
}

TEST_F(DirtPictures, WithoutDirtThereAreNone) {
  Drive("");
  EXPECT_FALSE(Left("heatmap_dirt.png") || Left("plot_tapes.png"));
  EXPECT_EQ(Plan()["sample_places"][0]["status"], "taken");
}

// What an earlier drive left would be taken for this one's.
TEST_F(DirtPictures, ThoseOfAnEarlierDriveGo) {
  Drive("dirt: {}\n");
  ASSERT_TRUE(Left("heatmap_dirt.png") && Left("plot_tapes.png"));
  Drive("");
  EXPECT_FALSE(Left("heatmap_dirt.png") || Left("plot_tapes.png"));
}

}  // namespace
}  // namespace floorproof

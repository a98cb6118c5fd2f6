// SPDX-License-Identifier: Apache-2.0
// Real maps: free cells agree to a cell with a count made another way, in whole numbers, from
// pixels that OpenCV read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <ostream>

#include "env/map/ros_map.h"
#include "tests/places.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

struct RealMap {
  const char* name;
  const char* image;
  double cell_m;
  std::int64_t free_per_mille, occupied_per_mille;  // its thresholds, times 1000
};

// ctest prints it behind each test's name.
void PrintTo(const RealMap& map, std::ostream* out) { *out << map.name; }

class SharedMapsTest : public ::testing::TestWithParam<RealMap> {
 protected:
  fs::path Folder() const { return SharedFile("maps") / GetParam().name; }
  void SetUp() override {
    if (!fs::exists(Folder())) GTEST_SKIP() << "no " << Folder() << ": real maps are not shipped";
  }
};

TEST_P(SharedMapsTest, FreeCellsAgreeWithAnIndependentCount) {
  const RealMap& expected = GetParam();
  const RosMap dut = ReadRosMap(Folder() / "map.yaml");
  // None of these maps has alpha, so that a plain BGR picture is what map_server averages.
  const cv::Mat image = cv::imread((Folder() / expected.image).string(), cv::IMREAD_COLOR);
  ASSERT_FALSE(image.empty());
  EXPECT_EQ(dut.frame.width, image.cols);
  EXPECT_EQ(dut.frame.height, image.rows);
  EXPECT_DOUBLE_EQ(dut.frame.cell_m, expected.cell_m);

  std::int64_t free = 0, occupied = 0, wrong = 0;
  for (int row = 0; row < image.rows; ++row)
    for (int x = 0; x < image.cols; ++x) {
      const auto& bgr = image.at<cv::Vec3b>(row, x);
      const std::int64_t dark = 765 - bgr[0] - bgr[1] - bgr[2];  // p = dark / 765
      const bool is_occupied = 1000 * dark > expected.occupied_per_mille * 765;
      const bool is_free = !is_occupied && 1000 * dark < expected.free_per_mille * 765;
      free += is_free;
      occupied += is_occupied;
      const CellState state = dut.occupancy(x, image.rows - 1 - row);
      wrong +=
          (state == CellState::kFree) != is_free || (state == CellState::kOccupied) != is_occupied;
    }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(std::ranges::count(dut.occupancy.cells, CellState::kFree), free);
  EXPECT_EQ(std::ranges::count(dut.occupancy.cells, CellState::kOccupied), occupied);
  EXPECT_GT(free, 1000);
  RecordProperty("free_cells", static_cast<int>(free));
  std::printf("%s: %d x %d, free %ld, occupied %ld\n", expected.name, image.cols, image.rows, free,
              occupied);
}

INSTANTIATE_TEST_SUITE_P(Maps, SharedMapsTest,
                         ::testing::Values(RealMap{"apartment", "map.pgm", 0.05, 196, 650},
                                           RealMap{"depot", "map.pgm", 0.05, 250, 650},
                                           RealMap{"fetch_hq_2015", "map.png", 0.05, 196, 650},
                                           RealMap{"lab_small", "map.pgm", 0.05, 196, 650},
                                           RealMap{"office_plan", "map.pgm", 0.068, 196, 650},
                                           RealMap{"office_scan", "map.png", 0.0506424, 196, 650},
                                           RealMap{"small_house", "map.pgm", 0.05, 196, 650},
                                           RealMap{"willow_2010", "map.pgm", 0.1, 196, 650}),
                         [](const auto& param) { return std::string(param.param.name); });

}  // namespace
}  // namespace floorproof

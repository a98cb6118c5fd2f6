// SPDX-License-Identifier: Apache-2.0
// What is no number, put in turn in place of every number of a scenario and its site.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>

#include "apps/run_floorproof.h"
#include "tests/bad_input/bad_input.h"
#include "tests/bad_input/child.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

using NoNumbers = OwnFolderTest;

TEST_F(NoNumbers, AreRefusedWhereverANumberIs) {
  // In maps, lists, polygons, distributions and variants; not in names or the grid's rows.
  const std::string site =
      "site: 1\nname: s\ngrid:\n  cell_m: 0.5\n  rows: |\n    ########\n    #......#\n    "
      "#......#\n"
      "    #......#\n    ########\nstart: {x_m: 1.0, y_m: 1.0, yaw_deg: 5}\nfloor: {friction: "
      "0.8}\n"
      "hazards:\n  - {type: glass, id: g, line_m: [[2.5, 1.2], [2.5, 1.9]], height_m: 1.5, "
      "thickness_m: 0.010}\n  - {type: step, id: p, polygon_m: [[1.5, 1.5], [1.6, 1.5], [1.6, "
      "2.0]], "
      "height_m: 0.006}\n";
  const std::string scenario =
      "scenario: 1\nsite: site.yaml\nrobot: {name: beluga, mass_kg: 12.5}\nplan: {overlap: 0.1}\n"
      "time_limit_s: 60.5\nrandomise:\n  site.floor.friction: {uniform: [0.6, 0.9]}\n  "
      "robot.clearance_m: {normal: [0.025, 0.001]}\n  site.hazards.p.height_m: {choice: [0.004, "
      "0.005]}\nmatrix:\n  plan.overlap: [0.11, 0.12]\n";
  const auto write = [&](const std::string& file, const std::string& text) {
    std::ofstream(folder_ / file) << text;
  };
  const auto run = [&] {
    return RunForked(RunFloorproof,
                     {"campaign", "scenario.yaml", "-n", "1", "--jobs", "1", "--set", "drive=none",
                      "--out", "o"},
                     folder_);
  };
  write("site.yaml", site), write("scenario.yaml", scenario);
  const ChildResult good = run();
  ASSERT_NE(good.status, 2) << good.err;
  std::filesystem::remove_all(folder_ / "o");
  int tried = 0;
  for (const auto& [file, text] :
       {std::pair("site.yaml", site), std::pair("scenario.yaml", scenario)}) {
    const std::regex number("[-0-9]+\\.?[0-9]*(?=[,}\\]\\n])");
    for (std::sregex_iterator at(text.begin(), text.end(), number); at != std::sregex_iterator();
         ++at)
      for (const char* written : {"nan", ".inf", "1e999"}) {
        std::string bad = text;
        bad.replace(static_cast<std::size_t>(at->position()),
                    static_cast<std::size_t>(at->length()), written);
        write(file, bad);
        const ChildResult dut = run();
        EXPECT_EQ(dut.status, 2) << file << " at " << at->position() << ": " << written << dut.out;
        EXPECT_EQ(std::ranges::count(dut.err, '\n'), 1) << dut.err;
        EXPECT_NE(dut.err.find(written), std::string::npos) << dut.err;
        ++tried;
      }
    write(file, text);
  }
  EXPECT_GT(tried, 80);
}

}  // namespace
}  // namespace floorproof

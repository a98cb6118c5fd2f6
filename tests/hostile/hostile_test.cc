// SPDX-License-Identifier: Apache-2.0
// With hostile files every command ends by itself within bounds of time and memory, prints the
// reason in one printable line, shows no secret, and writes only into its output folder.
//
// FLOORPROOF_HOSTILE_SECONDS: for so long, with seeds from FLOORPROOF_HOSTILE_SEED on (default: the
// time), instead of the few of the quick test. A failure names the kind and the seed;
// FLOORPROOF_HOSTILE_SEED with a tenth of a second tries that one again.
#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>

#include "apps/run_floorproof.h"
#include "base/printable.h"
#include "base/sanitizer.h"
#include "tests/bad_input/child.h"
#include "tests/hostile/hostile_input.h"
#include "tests/hostile/secret_files.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

#ifdef FP_ADDRESS_SANITIZER
constexpr double kMaxCpu_s = 120, kMaxMb = 8000;
#else
constexpr double kMaxCpu_s = 20, kMaxMb = 1500;
#endif
constexpr std::size_t kMaxLine = 1200;

class Hostile : public OwnFolderTest, public ::testing::WithParamInterface<std::string> {
 protected:
  Hostile() {
    for (const char* name : {"good", "outside"}) fs::create_directories(folder_ / name);
    for (const auto& [name, content] : SecretFiles())
      std::ofstream(folder_ / "outside" / name, std::ios::binary) << content;
    setenv("FLOORPROOF_TEST_TOKEN", kSecret.c_str(), 1);  // what /proc/self/environ would show
    MakeGoodFiles(GetParam(), folder_ / "good");
  }
  // Everything outside the folder in which the command runs, with its size.
  std::set<std::string> Outside() const {
    std::set<std::string> entries;
    for (const char* name : {"good", "outside"})
      for (const auto& entry : fs::recursive_directory_iterator(folder_ / name))
        entries.insert(entry.path().string() +
                       (entry.is_regular_file() ? std::to_string(entry.file_size()) : ""));
    return entries;
  }
  void Try(std::uint64_t seed) {
    const fs::path here = folder_ / "here";
    fs::remove_all(here);
    fs::copy(folder_ / "good", here, fs::copy_options::recursive);
    const HostileInput input = Spoil(GetParam(), seed, here, folder_ / "outside");
    const auto before = Outside();
    const ChildResult dut = RunForked(RunFloorproof, input.arguments, here,
                                      {.cpu_s = 2 * static_cast<int>(kMaxCpu_s), .wall_s = 600});
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + Printable(input.what));
    EXPECT_EQ(dut.signal, 0) << "killed after " << dut.cpu_s << " s, " << dut.most_mb << " MB";
    EXPECT_THAT(dut.status, AnyOf(0, 1, 2, 3, 4)) << dut.err;
    // Physics may break, and a drive need not be the one that was recorded.
    if (dut.status == 3) {
      EXPECT_THAT(dut.err, AnyOf(HasSubstr("diverged"), HasSubstr("differs from the record")));
    }
    EXPECT_TRUE(dut.status != 2 || std::ranges::count(dut.err, '\n') == 1) << dut.err;
    EXPECT_LE(dut.cpu_s, kMaxCpu_s);
    EXPECT_LE(dut.most_mb, kMaxMb);
    for (const std::string& said : {dut.out, dut.err}) {
      EXPECT_THAT(said, Not(HasSubstr(kSecret)));
      std::istringstream lines(said);
      for (std::string line; std::getline(lines, line);) {
        EXPECT_EQ(WhyUnprintable(line), "") << Printable(line);
        EXPECT_LE(line.size(), kMaxLine);
      }
    }
    EXPECT_THAT(dut.err, Not(HasSubstr("exception")));
    EXPECT_EQ(Outside(), before) << "it wrote outside its folder";
  }
};

TEST_P(Hostile, InputIsRefusedOrTaken) {
  const char* seconds = std::getenv("FLOORPROOF_HOSTILE_SECONDS");
  const char* first = std::getenv("FLOORPROOF_HOSTILE_SEED");
  if (seconds == nullptr) {
    constexpr std::uint64_t kFew = 12;
    for (std::uint64_t seed = 0; seed < kFew && !HasFailure(); ++seed) Try(seed);
    return;
  }
  const auto end = Clock::now() + std::chrono::duration<double>(std::atof(seconds));
  std::uint64_t seed = first != nullptr ? std::strtoull(first, nullptr, 10)
                                        : static_cast<std::uint64_t>(std::time(nullptr)) << 20;
  const std::uint64_t from = seed;
  do Try(seed++);
  while (Clock::now() < end && !HasFailure());
  std::printf("%s: %llu inputs\n", GetParam().c_str(),
              static_cast<unsigned long long>(seed - from));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Hostile, ::testing::ValuesIn(HostileKinds()),
                         [](const auto& kind) { return kind.param; });

}  // namespace
}  // namespace floorproof

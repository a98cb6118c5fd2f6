// SPDX-License-Identifier: Apache-2.0
// `floorproof merge`: shards give what the whole campaign would have given, or say why not.
#include <nlohmann/json.hpp>
#include <set>

#include "tests/apps/campaign_program.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

class MergeTest : public CampaignProgram {
 protected:
  // Shards of one campaign, each by its ids and its folder.
  void Shards(int n, std::initializer_list<std::pair<std::string, std::string>> shards) const {
    for (const auto& [ids, out] : shards)
      ASSERT_EQ(Campaign("-n " + std::to_string(n) + " --episodes " + ids + " --out " + out).status,
                0)
          << "a shard is not judged";
  }
  Json Summary(const std::string& out) const {
    return Json::parse(Slurp(folder_ / out / "summary.json"));
  }
};

TEST_F(MergeTest, ShardsGiveTheWholeCampaign) {
  Write(
      "gate: {metric: not_success, max_rate: 0.9, confidence: 0.6}\n"
      "matrix: {start.yaw_deg: [0, 10]}\n");
  const int status = Campaign("-n 9 --out whole").status;
  ASSERT_NE(status, 2);
  Shards(9, {{"0:4", "a"}, {"3:9", "b"}});
  EXPECT_EQ(Run("merge b a --out joined").status, status);
  ExpectSameResults("whole", "joined");
}

TEST_F(MergeTest, ReplaysOfFailingEpisodesComeAlong) {
  Write("success: {min_coverage: 1}\n");  // which none reaches
  Shards(5, {{"0:3", "a"}, {"3:5", "b"}});
  ASSERT_EQ(Campaign("-n 5 --out whole").status, 0);
  fs::remove(folder_ / "a/episodes/default/1/replay.bin");
  std::ofstream(folder_ / "secret") << "mine";
  fs::remove(folder_ / "b/episodes/default/4/replay.bin");
  fs::create_symlink(folder_ / "secret", folder_ / "b/episodes/default/4/replay.bin");
  const Ended linked = Run("merge b a --out joined");
  EXPECT_EQ(linked.status, 2);
  EXPECT_THAT(linked.said, HasSubstr("replay.bin: is a link"));
  fs::remove(folder_ / "b/episodes/default/4/replay.bin");
  ASSERT_EQ(Run("merge b a --out joined").status, 0);
  for (const char* episode : {"0", "2", "3"}) {
    const std::string file = std::string("episodes/default/") + episode + "/replay.bin";
    EXPECT_GT(fs::file_size(folder_ / "joined" / file), 100u);
    EXPECT_TRUE(Slurp(folder_ / "joined" / file) == Slurp(folder_ / "whole" / file)) << episode;
  }
  for (const char* episode : {"1", "4"})  // lost
    EXPECT_FALSE(fs::exists(folder_ / "joined/episodes/default" / episode / "replay.bin"));
}

TEST_F(MergeTest, ShardsMayHaveBeenMoved) {
  Shards(6, {{"0:3", "a"}, {"3:6", "b"}});
  ASSERT_EQ(Campaign("-n 6 --out whole").status, 0);
  fs::create_directories(folder_ / "far/away");
  fs::rename(folder_ / "a", folder_ / "far/away/a");
  fs::rename(folder_ / "b", folder_ / "far/b");
  fs::remove(folder_ / "p.csv");  // as on a machine that has only the shards
  const Ended merged = Run("merge far/away/a far/b --out joined");
  EXPECT_EQ(merged.status, 0) << merged.said;
  ExpectSameResults("whole", "joined");
}

// Each time it is asked it plans another way; what was driven can be driven again, and without it.
TEST_F(MergeTest, PlansThatAProgramMadeAreKeptWithTheirEpisodes) {
  Write("drive: none\n");
  PlanBy("printf 'x_m,y_m\\n1.0,1.0\\n1.6,1.0%s\\n' \"$(date +%N)\" > \"$1\"/plan.csv\n");
  const Ended first = Campaign("--trust -n 4 --episodes 0:2 --jobs 2 --out a");
  ASSERT_EQ(first.status, 0) << first.said;
  EXPECT_THAT(first.out, HasSubstr("runs a program that s.yaml:15 names: ./p.sh\n"));
  ASSERT_EQ(Campaign("--trust -n 4 --episodes 2:4 --jobs 2 --out b").status, 0);
  ASSERT_EQ(Run("merge a b --out joined").status, 0);
  fs::remove(folder_ / "p.sh");
  fs::remove_all(folder_ / "a");
  fs::rename(folder_ / "joined", folder_ / "moved");
  std::set<std::string> plans;
  for (const char* episode : {"0", "3"}) {
    const Ended again = Run(std::string("replay moved --episode ") + episode);
    EXPECT_EQ(again.status, 0) << again.said;
    EXPECT_THAT(again.out, Not(HasSubstr("runs a program")));
    plans.insert(Slurp(folder_ / "moved/episodes/default" / episode / "plan.csv"));
  }
  EXPECT_EQ(plans.size(), 2u) << "they differ";
}

TEST_F(MergeTest, AReplayRunsNoProgramWhereThereIsNoPlan) {
  Write("drive: none\n");
  PlanBy("echo asked >> log; exit 1\n");
  ASSERT_EQ(Campaign("--trust -n 1 --out a").status, 0);
  EXPECT_EQ(Slurp(folder_ / "log"), "asked\n");
  const Ended again = Run("replay a --episode 0");
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.said, HasSubstr("made no plan"));
  EXPECT_EQ(Slurp(folder_ / "log"), "asked\n");
}

TEST_F(MergeTest, AnotherProgramIsAnotherCampaign) {
  Write("drive: none\n");
  const std::string script = "cp p.csv \"$1\"/plan.csv\n";
  PlanBy(script);
  ASSERT_EQ(Campaign("--trust -n 1 --out a").status, 0);
  EXPECT_EQ(Campaign("--trust -n 2 --resume --out a").status, 0);
  std::ofstream(folder_ / "p.sh") << "#!/bin/sh\nsleep 0; " + script;
  const Ended other = Campaign("--trust -n 3 --resume --out a");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.said, HasSubstr("holds another campaign: files.p.sh was "));
}

TEST_F(MergeTest, ALostShardIsNamedAndDoesNotPass) {
  Write("gate: {metric: roll_over, max_rate: 0.5, confidence: 0.9}\n");
  Shards(12, {{"0:3", "a"}, {"5:9", "b"}});
  const Ended merged = Run("merge a b --out joined");
  EXPECT_EQ(merged.status, 4);
  EXPECT_THAT(merged.out, HasSubstr("no shard holds the episodes 3:5, 9:12"));
  EXPECT_THAT(merged.out, Not(HasSubstr("all episodes are done")));
  EXPECT_EQ(Summary("joined")["variants"]["default"]["n"], 3) << "the prefix alone counts";
  EXPECT_FALSE(Summary("joined")["unfinished"].is_null());
  EXPECT_EQ(Count("joined", "SELECT count(*) FROM extra"), 4);
}

// What is kept and not counted is a shard's, too.
TEST_F(MergeTest, AMergedFolderIsAShard) {
  Shards(9, {{"0:3", "a"}, {"6:9", "c"}, {"3:6", "b"}});
  ASSERT_EQ(Run("merge a c --out ac").status, 0);
  ASSERT_EQ(Count("ac", "SELECT count(*) FROM extra"), 3);
  ASSERT_EQ(Run("merge ac b --out joined").status, 0);
  ASSERT_EQ(Campaign("-n 9 --out whole").status, 0);
  ExpectSameResults("whole", "joined");
}

TEST_F(MergeTest, AFixedGateHasOneN) {
  Write("gate: {metric: not_success, max_rate: 0.6, confidence: 0.9}\n");
  Shards(6, {{"0:6", "a"}});
  Shards(9, {{"6:9", "b"}});
  const Ended merged = Run("merge a b --out joined");
  EXPECT_EQ(merged.status, 2);
  EXPECT_THAT(merged.said, HasSubstr("a was driven with -n 6: a fixed gate is judged at one n"));
}

TEST_F(MergeTest, OverlapsThatDisagreeAreRefused) {
  Shards(6, {{"0:4", "a"}, {"2:6", "b"}});
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open((folder_ / "b/campaign.sqlite").c_str(), &db), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(db, "UPDATE episode SET energy_j = energy_j + 1e-9 WHERE episode = 3",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  sqlite3_close(db);
  const Ended merged = Run("merge a b --out joined");
  EXPECT_EQ(merged.status, 2);
  EXPECT_THAT(merged.said, HasSubstr("episode 3 of default is not that of a: they differ in "
                                     "energy_j"));
  EXPECT_FALSE(fs::exists(folder_ / "joined"));
}

TEST_F(MergeTest, ShardsOfAnotherCampaignAreRefused) {
  Shards(4, {{"0:2", "a"}});
  ASSERT_EQ(Campaign("-n 4 --episodes 2:4 --seed 1 --out b").status, 0);
  const Ended merged = Run("merge a b --out joined");
  EXPECT_EQ(merged.status, 2);
  EXPECT_THAT(merged.said, HasSubstr("holds another campaign: seed was 0, is 1"));
  const Ended none = Run("merge a nowhere --out joined");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.said, HasSubstr("nowhere/campaign.sqlite: cannot be opened"));
}

}  // namespace
}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
#include "run/episode/replay_track.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "env/scene/robot_model.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

HazardMap Room(double width_m, double depth_m) {
  HazardMap map;
  map.frame = {static_cast<int>(width_m / 0.5), static_cast<int>(depth_m / 0.5), 0.5, {}};
  map.occupancy = Grid<CellState>(map.frame.width, map.frame.height, CellState::kFree);
  for (int ix = 0; ix < map.frame.width; ++ix) map.occupancy(ix, 0) = CellState::kOccupied;
  return map;
}

// The file, read as docs/results.md states it.
struct ReplayFile {
  explicit ReplayFile(const std::string& bytes) : bytes_(bytes) {
    EXPECT_EQ(bytes.substr(0, 8), "FPREPLAY");
    EXPECT_EQ(Word(8), 1u);
    at_ = 16 + Word(12);
    head = Json::parse(bytes.substr(16, Word(12)));
    const std::size_t floats = head.at("shapes").get<std::size_t>() * 18;
    for (std::size_t i = 0; i < floats; ++i) shapes.push_back(Float());
    for (const Json& mesh : head.at("meshes"))
      at_ += 12 * (mesh.at("vertices").get<std::size_t>() + mesh.at("faces").get<std::size_t>());
    const auto per = head.at("per").get<std::vector<double>>();
    std::vector<std::int64_t> last(per.size()), step(per.size());
    std::int64_t t = 0;
    for (std::size_t i = 0; i < head.at("states"); ++i) {
      t += Varint();
      t_s.push_back(static_cast<double>(t) / 1000);
      std::vector<double>& state = states.emplace_back();
      for (std::size_t k = 0; k < per.size(); ++k) {
        step[k] += Varint();
        last[k] += step[k];
        state.push_back(static_cast<double>(last[k]) / per[k]);
      }
    }
    EXPECT_EQ(at_, bytes.size()) << "nothing is left";
  }

  // Where a link is, by its joints.
  Eigen::Isometry3d Pose(int link, const std::vector<double>& state) const {
    const Json& json = head.at("links").at(static_cast<std::size_t>(link));
    if (json.at("parent") == -1) return Eigen::Isometry3d::Identity();
    Eigen::Isometry3d X = Pose(json.at("parent"), state) * Frame(json.at("pos"), json.at("quat"));
    for (const Json& joint : json.at("joints")) {
      const std::size_t first = joint.at("first");
      const double* q = state.data() + first;
      if (joint.at("type") == "free") {
        X.setIdentity();
        X.translation() = Vec3(q[0], q[1], q[2]);
        X.linear() = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized().toRotationMatrix();
        continue;
      }
      const Vec3 anchor = Vector(joint.at("anchor"));
      Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
      if (joint.at("type") == "ball")
        turn.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
      else if (joint.at("type") == "hinge")
        turn.linear() = Eigen::AngleAxisd(q[0] - joint.at("zero").get<double>(),
                                          Vector(joint.at("axis")).normalized())
                            .toRotationMatrix();
      else
        turn.translation() = (q[0] - joint.at("zero").get<double>()) * Vector(joint.at("axis"));
      X = X * Eigen::Translation3d(anchor) * turn * Eigen::Translation3d(-anchor);
    }
    return X;
  }

  Json head;
  std::vector<float> shapes;
  std::vector<double> t_s;
  std::vector<std::vector<double>> states;

 private:
  static Vec3 Vector(const Json& json) {
    return Vec3(json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>());
  }
  static Eigen::Isometry3d Frame(const Json& pos, const Json& quat) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = Vector(pos);
    X.linear() = Eigen::Quaterniond(quat.at(0).get<double>(), quat.at(1).get<double>(),
                                    quat.at(2).get<double>(), quat.at(3).get<double>())
                     .normalized()
                     .toRotationMatrix();
    return X;
  }
  std::uint32_t Word(std::size_t at) const {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes_.data() + at, 4);
    return word;
  }
  float Float() {
    float value = 0;
    std::memcpy(&value, bytes_.data() + at_, 4);
    at_ += 4;
    return value;
  }
  std::int64_t Varint() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if ((byte & 0x80) == 0) break;
    }
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

class ReplayOf : public ::testing::TestWithParam<const char*> {};

// Every shape of the robot stands where MuJoCo has it, wheels turned and blocks folded.
TEST_P(ReplayOf, TheRobotStandsAsItStood) {
  const HazardMap map = Room(6, 4);
  const Scene scene = BuildScene(map, ReadRobot(FindRobotFile(GetParam(), {})), {}, {2, 2, 0.3});
  const mjModel* m = scene.model.get();
  const DataPtr data = MakeData(m);
  ReplayTrack dut(m);
  std::vector<std::vector<double>> bodies;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < m->njnt; ++j) {
      double* q = data->qpos + m->jnt_qposadr[j];
      if (m->jnt_type[j] == mjJNT_HINGE || m->jnt_type[j] == mjJNT_SLIDE) q[0] += 0.013 * (j + i);
      if (m->jnt_type[j] == mjJNT_FREE) q[0] += 0.1 * i;
    }
    mj_kinematics(m, data.get());
    dut.Add(0.04 * i, data->qpos);
    bodies.emplace_back(data->geom_xpos, data->geom_xpos + 3 * m->ngeom);
  }
  const std::string bytes = dut.Bytes(scene, {});
  const ReplayFile file(bytes);
  ASSERT_EQ(file.states.size(), 3u);
  // The shapes of the robot, in the order of its geoms.
  std::size_t shape = 0;
  int compared = 0;
  for (int g = 0; g < m->ngeom; ++g) {
    const bool robot = m->body_rootid[m->geom_bodyid[g]] == m->body_rootid[scene.base_body];
    if (!robot || m->geom_group[g] == 3) continue;
    if (m->geom_matid[g] < 0 && m->geom_rgba[4 * g + 3] <= 0) continue;
    for (; file.shapes[18 * shape + 1] == 0; ++shape) ASSERT_LT(18 * shape, file.shapes.size());
    const float* s = file.shapes.data() + 18 * shape++;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = file.Pose(static_cast<int>(s[1]), file.states[i]) * Vec3(s[11], s[12], s[13]);
      const Vec3 there(bodies[i].data() + 3 * g);
      ASSERT_LT((p - there).norm(), 0.0015) << "geom " << g << ", state " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 10);
}
INSTANTIATE_TEST_SUITE_P(Robots, ReplayOf,
                         ::testing::Values("beluga", "htetro", "rover", "scrubber"));

TEST(ReplayTrack, TenMinutesOfHtetroAreLessThanAMegabyte) {
  const HazardMap map = Room(6, 4);
  const Scene scene = BuildScene(map, ReadRobot(FindRobotFile("htetro", {})), {}, {2, 2, 0});
  const mjModel* m = scene.model.get();
  std::vector<double> q(m->qpos0, m->qpos0 + m->nq);
  ReplayTrack dut(m);
  // Uneven all the time: every joint shakes, by more than it is rounded to.
  for (int i = 0; i < 600 * 25; ++i) {
    for (int k = 0; k < m->nq; ++k)
      q[static_cast<std::size_t>(k)] = m->qpos0[k] +
                                       (k < 3 ? 0.012 : 0.08) * i * (k != 2) * (k < 3 || k > 6) +
                                       0.001 * std::sin(1.0 * i * (k + 1));
    dut.Add(0.04 * i, q.data());
  }
  EXPECT_LT(dut.Bytes(scene, {}).size(), 1000000u);
  EXPECT_LT(ReplayFile(dut.Bytes(scene, {})).head.at("per").size(), 40u)
      << "144 rollers are left out";
}

TEST(ReplayTrack, OfALongDriveTheSecondsAroundAFailureAreKept) {
  const HazardMap map = Room(6, 4);
  const Scene scene = BuildScene(map, ReadRobot(FindRobotFile("beluga", {})), {}, {2, 2, 0});
  const mjModel* m = scene.model.get();
  ReplayTrack dut(m);
  for (int i = 0; i < 3600 * 25; ++i) dut.Add(0.04 * i, m->qpos0);
  const std::string bytes = dut.Bytes(scene, std::vector<double>{2000});
  const ReplayFile file(bytes);
  EXPECT_LT(file.t_s.size(), 16000u);
  const auto within = [&](double low_s, double high_s) {
    return std::ranges::count_if(file.t_s, [&](double t) { return t >= low_s && t < high_s; });
  };
  EXPECT_EQ(within(1995, 2000), 125);
  EXPECT_LT(within(1000, 1005), 25);
  EXPECT_EQ(file.t_s.back(), 0.04 * (3600 * 25 - 1));
}

TEST(ReplayTrack, ATimeThatDoesNotAscendIsLeftOut) {
  const HazardMap map = Room(6, 4);
  const Scene scene = BuildScene(map, ReadRobot(FindRobotFile("beluga", {})), {}, {2, 2, 0});
  ReplayTrack dut(scene.model.get());
  for (const double t_s : {0.0, 0.04, 0.04, 0.02, 0.08}) dut.Add(t_s, scene.model->qpos0);
  EXPECT_EQ(ReplayFile(dut.Bytes(scene, {})).t_s, (std::vector<double>{0, 0.04, 0.08}));
}

TEST(ReplayTrack, OfALargeFloorWhatLiesNearTheWayIsKept) {
  HazardMap map = Room(60, 40);
  for (int ix = 4; ix < 120; ix += 4)
    for (int iy = 4; iy < 80; iy += 4) map.occupancy(ix, iy) = CellState::kOccupied;
  const Scene scene = BuildScene(map, ReadRobot(FindRobotFile("beluga", {})), {}, {3, 3, 0});
  ReplayTrack dut(scene.model.get());
  dut.Add(0, scene.model->qpos0);
  const std::string bytes = dut.Bytes(scene, {});
  const ReplayFile file(bytes);
  int near = 0;
  for (std::size_t i = 0; i < file.shapes.size(); i += 18) {
    const bool pillar = file.shapes[i + 8] < 1 && file.shapes[i + 9] < 1;
    if (file.shapes[i + 1] != 0 || !pillar) continue;
    const double off_m = std::hypot(file.shapes[i + 11] - 3, file.shapes[i + 12] - 3);
    near += off_m < 6;
    EXPECT_LT(off_m, 12);
  }
  EXPECT_GT(near, 5);
}

}  // namespace
}  // namespace floorproof

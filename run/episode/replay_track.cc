// SPDX-License-Identifier: Apache-2.0
#include "run/episode/replay_track.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "run/episode/replay_scene.h"

namespace floorproof {
namespace {

constexpr int kRecordHz = 25;
constexpr std::size_t kMostStates = 600 * kRecordHz;  // some half a megabyte
constexpr double kKeepBefore_s = 8, kKeepAfter_s = 4;
constexpr double kAround_m = 6;  // of the floor around the way
constexpr double kPerMetre = 1e4, kPerQuaternion = 1e4, kPerRadian = 1e3;

static_assert(std::endian::native == std::endian::little, "replay.bin is little-endian");

void AddVarint(std::int64_t value, std::string& out) {
  auto rest = static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
  for (; rest >= 0x80; rest >>= 7) out += static_cast<char>(rest | 0x80);
  out += static_cast<char>(rest);
}

template <class T>
void AddRaw(const std::vector<T>& values, std::string& out) {
  const std::size_t at = out.size();
  out.resize(at + values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(out.data() + at, values.data(), values.size() * sizeof(T));
}

void AddWord(std::size_t value, std::string& out) {
  AddRaw(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)}, out);
}

}  // namespace

ReplayTrack::ReplayTrack(const mjModel* m) {
  first_of_.assign(static_cast<std::size_t>(m->njnt), -1);
  for (int j = 0; j < m->njnt; ++j) {
    if (IsRoller(m, m->jnt_bodyid[j])) continue;
    first_of_[static_cast<std::size_t>(j)] = static_cast<int>(from_.size());
    const auto add = [&](int values, double per) {
      per_.insert(per_.end(), static_cast<std::size_t>(values), per);
    };
    switch (m->jnt_type[j]) {
      case mjJNT_FREE:
        add(3, kPerMetre);
        add(4, kPerQuaternion);
        break;
      case mjJNT_BALL:
        add(4, kPerQuaternion);
        break;
      case mjJNT_SLIDE:
        add(1, kPerMetre);
        break;
      default:
        add(1, kPerRadian);
    }
    for (int from = m->jnt_qposadr[j]; from_.size() < per_.size(); ++from) from_.push_back(from);
  }
}

void ReplayTrack::Add(double t_s, const double* qpos) {
  const auto t_ms = static_cast<std::int64_t>(std::llround(1000 * t_s));
  if (!t_ms_.empty() && t_ms <= t_ms_.back()) return;
  t_ms_.push_back(t_ms);
  for (std::size_t k = 0; k < from_.size(); ++k) {
    // A wheel that turns for hours stays in range.
    const double value = std::clamp(per_[k] * qpos[from_[k]], -2e9, 2e9);
    rounded_.push_back(std::isfinite(value) ? static_cast<std::int32_t>(std::lround(value)) : 0);
  }
}

std::string ReplayTrack::Bytes(const Scene& scene, std::span<const double> keep_s,
                               std::span<const Waypoint> plan) const {
  const std::size_t width = from_.size();
  std::vector<std::size_t> kept;
  const std::size_t every =
      (t_ms_.size() + kMostStates - 1) / std::max<std::size_t>(1, kMostStates);
  const auto is_near = [&](std::size_t i) {
    const double t_s = static_cast<double>(t_ms_[i]) / 1000;
    return std::ranges::any_of(keep_s, [&](double keep) {
      return t_s > keep - kKeepBefore_s && t_s < keep + kKeepAfter_s;
    });
  };
  for (std::size_t i = 0; i < t_ms_.size(); ++i)
    if (every <= 1 || i % every == 0 || i + 1 == t_ms_.size() || is_near(i)) kept.push_back(i);

  // The way, by the joint that the robot's base stands on.
  const int base_joint = scene.model->body_jntadr[scene.base_body];
  const auto at = static_cast<std::size_t>(first_of_[static_cast<std::size_t>(base_joint)]);
  Polygon way;
  for (const std::size_t i : kept)
    way.emplace_back(rounded_[i * width + at] / kPerMetre,
                     rounded_[i * width + at + 1] / kPerMetre);
  Box2 around = BoxAround(way);
  around.low.array() -= kAround_m;
  around.high.array() += kAround_m;
  const ReplayScene shapes = ReplaySceneOf(scene, around, first_of_);

  nlohmann::ordered_json meshes = nlohmann::ordered_json::array();
  for (const ReplayScene::Mesh& mesh : shapes.meshes)
    meshes.push_back({{"vertices", mesh.vertices.size() / 3}, {"faces", mesh.faces.size() / 3}});
  nlohmann::ordered_json way_planned = nlohmann::ordered_json::array();
  const auto millimetres = [](double m) { return std::round(1000 * m) / 1000; };
  for (const Waypoint& waypoint : plan)
    way_planned.push_back({millimetres(waypoint.p_W.x()), millimetres(waypoint.p_W.y())});
  std::string head = nlohmann::ordered_json({{"links", *shapes.links},
                                             {"base", shapes.base_link},
                                             {"shapes", shapes.shapes.size() / kShapeFloats},
                                             {"meshes", std::move(meshes)},
                                             {"states", kept.size()},
                                             {"per", per_},
                                             {"plan", std::move(way_planned)}})
                         .dump();
  head.append((4 - head.size() % 4) % 4, ' ');  // what follows is aligned

  std::string out = "FPREPLAY";
  AddWord(1, out);
  AddWord(head.size(), out);
  out += head;
  AddRaw(shapes.shapes, out);
  for (const ReplayScene::Mesh& mesh : shapes.meshes) {
    AddRaw(mesh.vertices, out);
    AddRaw(mesh.faces, out);
  }
  // What differs from going on as before: mostly a byte each.
  std::int64_t t = 0;
  std::vector<std::int64_t> last(width), step(width);
  for (const std::size_t i : kept) {
    AddVarint(t_ms_[i] - t, out);
    t = t_ms_[i];
    for (std::size_t k = 0; k < width; ++k) {
      const std::int64_t now = rounded_[i * width + k] - last[k];
      AddVarint(now - step[k], out);
      step[k] = now;
      last[k] = rounded_[i * width + k];
    }
  }
  return out;
}

ReplayObserver::ReplayObserver(int control_hz, EpisodeObserver* next)
    : next_(next), every_(std::max(1, control_hz / kRecordHz)) {}

void ReplayObserver::OnPlan(const PlanResult& plan) {
  plan_ = plan.path;
  if (next_) next_->OnPlan(plan);
}

void ReplayObserver::OnScene(const Scene& scene) {
  track_.emplace(scene.model.get());
  if (next_) next_->OnScene(scene);
}

bool ReplayObserver::OnControl(const EpisodeView& now) {
  if (track_ && now.simulation && count_++ % every_ == 0)
    track_->Add(now.sample.t_s, now.simulation->data()->qpos);
  return next_ == nullptr || next_->OnControl(now);
}

std::string ReplayObserver::Bytes(const std::optional<Scene>& scene,
                                  const EpisodeRecord& record) const {
  if (!track_ || track_->empty() || !scene) return "";
  std::vector<double> keep_s;
  for (const Event& event : record.events) keep_s.push_back(event.t_s);
  return track_->Bytes(*scene, keep_s, plan_);
}

}  // namespace floorproof

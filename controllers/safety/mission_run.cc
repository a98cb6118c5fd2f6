// SPDX-License-Identifier: Apache-2.0
#include "controllers/safety/mission_run.h"

#include <algorithm>

namespace floorproof {
namespace {

bool Over(NodeStatus status) {
  return status == NodeStatus::kDone || status == NodeStatus::kFailed;
}

}  // namespace

std::string_view Name(NodeStatus status) {
  constexpr std::string_view kNames[] = {"waiting", "running", "done", "failed"};
  return kNames[static_cast<int>(status)];
}

MissionRun::MissionRun(const Mission& mission, const Make& make)
    : mission_(mission),
      primitives_(mission.nodes.size()),
      status_(mission.nodes.size(), NodeStatus::kWaiting),
      begun_s_(mission.nodes.size(), 0),
      risk_(mission.nodes.size()) {
  for (std::size_t i = 0; i < mission.nodes.size(); ++i) {
    const MissionNode& node = mission.nodes[i];
    if (node.kind == MissionNode::Kind::kPrimitive) primitives_[i] = make(node);
    if (node.kind == MissionNode::Kind::kSkill) skills_.push_back(i);
  }
  states_.assign(skills_.size(), 0);
}

NodeStatus MissionRun::Update(double t_s) {
  const NodeStatus status = Run(0, t_s);
  Assess();
  return status;
}

NodeStatus MissionRun::Run(std::size_t node, double t_s) {
  NodeStatus& status = status_[node];
  if (Over(status)) return status;
  const bool begins = status == NodeStatus::kWaiting;
  status = NodeStatus::kRunning;
  if (begins) begun_s_[node] = t_s;
  if (mission_.nodes[node].kind != MissionNode::Kind::kPrimitive)
    return status = RunChildren(node, t_s);
  if (begins) primitives_[node]->Start(t_s);
  return status = primitives_[node]->Update(t_s);
}

NodeStatus MissionRun::RunChildren(std::size_t node, double t_s) {
  const std::vector<std::size_t>& children = mission_.nodes[node].children;
  for (const std::size_t child : children)
    if (mission_.nodes[child].parallel && Run(child, t_s) == NodeStatus::kFailed)
      return NodeStatus::kFailed;
  bool ends = false;
  for (const std::size_t child : children) {
    if (mission_.nodes[child].parallel) continue;
    const NodeStatus status = Run(child, t_s);
    if (status != NodeStatus::kDone) return status;
    ends = true;
  }
  if (!ends) return NodeStatus::kRunning;
  for (const std::size_t child : children)  // they have nothing left to run beside
    if (mission_.nodes[child].parallel) End(child);
  return NodeStatus::kDone;
}

void MissionRun::End(std::size_t node) {
  status_[node] = NodeStatus::kDone;
  for (const std::size_t child : mission_.nodes[node].children) End(child);
}

std::optional<Failure> MissionRun::failure(std::size_t node) const {
  if (status_[node] == NodeStatus::kWaiting || status_[node] == NodeStatus::kDone) return {};
  return primitives_[node]->failure();
}

// Children stand behind their parents, so backwards each node is whole before it is added.
void MissionRun::Assess() {
  risk_.assign(risk_.size(), {});
  for (std::size_t i = mission_.nodes.size(); i-- > 0;) {
    const MissionNode& node = mission_.nodes[i];
    if (node.kind == MissionNode::Kind::kPrimitive) {
      if (const std::optional<Failure> failed = failure(i))
        risk_[i].greatest = risk_[i].sum =
            SafetyStateOf(mission_.primitives[node.primitive].rating, *failed, mission_.weights);
      continue;
    }
    const bool skill = node.kind == MissionNode::Kind::kSkill;
    if (skill && status_[i] == NodeStatus::kDone) continue;
    for (const std::size_t child : node.children) {
      risk_[i].greatest = std::max(risk_[i].greatest, risk_[child].greatest);
      risk_[i].sum += risk_[child].sum;
    }
    if (skill) risk_[i].sum = risk_[i].greatest;
  }
  for (std::size_t k = 0; k < skills_.size(); ++k) states_[k] = risk_[skills_[k]].greatest;
}

}  // namespace floorproof

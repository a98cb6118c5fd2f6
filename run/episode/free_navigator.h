// SPDX-License-Identifier: Apache-2.0
// Leads a robot nowhere: whoever commands it goes where they like.
#pragma once

#include "controllers/navigator.h"

namespace floorproof {

// Its path is the place where the robot is; it never ends.
class FreeNavigator final : public Navigator {
 public:
  explicit FreeNavigator(const Pose2& start) : path_(1) { path_.front().p_W = start.p(); }

  const Path& path() const override { return path_; }
  PathChange Update(const NavigatorInput& input) override {
    path_.front().p_W = input.estimate.X_WB.p();
    return PathChange::kNone;
  }
  Leads leads() const override { return Leads::kOn; }
  bool free() const override { return true; }
  const Path& plan() const override { return path_; }
  void GoOnFrom(std::size_t) override {}

 private:
  Path path_;
};

}  // namespace floorproof

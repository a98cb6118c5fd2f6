// SPDX-License-Identifier: Apache-2.0
// The C border to MuJoCo: owners of its objects, and calls whose errors become exceptions.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace floorproof {

struct MjDeleter {
  void operator()(mjSpec* spec) const { mj_deleteSpec(spec); }
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using SpecPtr = std::unique_ptr<mjSpec, MjDeleter>;
using ModelPtr = std::unique_ptr<mjModel, MjDeleter>;
using DataPtr = std::unique_ptr<mjData, MjDeleter>;

// Calls that may fail inside the engine. By default MuJoCo ends the process then; these throw
// InternalError with its message instead. The message comes back by a long jump from C, so nothing
// with a destructor lives on the frames in between.
void StepEngine(const mjModel* model, mjData* data);
void ForwardEngine(const mjModel* model, mjData* data);
DataPtr MakeData(const mjModel* model);
ModelPtr CopyModel(const mjModel* model);
void SetConstEngine(mjModel* model, mjData* data);
// Throws InternalError with the compiler's message. Files that the spec names are read through
// `assets`; nullptr: from the disk.
ModelPtr CompileSpec(mjSpec* spec, const mjVFS* assets = nullptr);

// The joint that the motor of this name drives.
mjsJoint* DrivenJoint(mjSpec* spec, const std::string& motor);

}  // namespace floorproof

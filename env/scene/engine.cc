// SPDX-License-Identifier: Apache-2.0
#include "env/scene/engine.h"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/error.h"

namespace floorproof {
namespace {

thread_local std::jmp_buf* t_return_point = nullptr;
thread_local char t_message[1024];

// Errors return to Caught by a long jump. Warnings are counted in mjData.warning, where the
// simulation reads them; the default handler would also write a log file into the working
// directory.
void OnEngineMessage(const mjLogMessage* message) {
  if (message->level < mjLOG_ERROR) return;
  std::snprintf(t_message, sizeof t_message, "%s", message->subject);
  if (t_return_point != nullptr) std::longjmp(*t_return_point, 1);
  // From a call that none of the below guards: the engine's handler may not return.
  std::fprintf(stderr, "floorproof: MuJoCo: %s\n", ErrorLine(t_message).c_str());
  std::exit(3);
}

const mjfLogHandler g_previous_handler = mju_setLogHandler(OnEngineMessage);

// Runs call(context) with engine errors caught; returns false with the text in t_message.
bool Caught(void (*call)(void*), void* context) {
  std::jmp_buf here;
  std::jmp_buf* const outer = t_return_point;
  t_return_point = &here;
  const bool ok = setjmp(here) == 0;
  if (ok) call(context);
  t_return_point = outer;
  return ok;
}

[[noreturn]] void Throw() { throw InternalError(std::string("MuJoCo: ") + t_message); }

struct ModelAndData {
  const mjModel* model;
  mjData* data;
};

}  // namespace

void StepEngine(const mjModel* model, mjData* data) {
  ModelAndData md{model, data};
  if (!Caught(
          [](void* p) {
            auto* c = static_cast<ModelAndData*>(p);
            mj_step(c->model, c->data);
          },
          &md))
    Throw();
}

void ForwardEngine(const mjModel* model, mjData* data) {
  ModelAndData md{model, data};
  if (!Caught(
          [](void* p) {
            auto* c = static_cast<ModelAndData*>(p);
            mj_forward(c->model, c->data);
          },
          &md))
    Throw();
}

DataPtr MakeData(const mjModel* model) {
  ModelAndData md{model, nullptr};
  if (!Caught(
          [](void* p) {
            auto* c = static_cast<ModelAndData*>(p);
            c->data = mj_makeData(c->model);
          },
          &md))
    Throw();
  return DataPtr(md.data);
}

ModelPtr CopyModel(const mjModel* model) {
  struct Models {
    const mjModel* from;
    mjModel* to;
  } models{model, nullptr};
  if (!Caught(
          [](void* p) {
            auto* m = static_cast<Models*>(p);
            m->to = mj_copyModel(nullptr, m->from);
          },
          &models))
    Throw();
  return ModelPtr(models.to);
}

void SetConstEngine(mjModel* model, mjData* data) {
  struct Both {
    mjModel* model;
    mjData* data;
  } both{model, data};
  if (!Caught(
          [](void* p) {
            auto* b = static_cast<Both*>(p);
            mj_setConst(b->model, b->data);
          },
          &both))
    Throw();
}

ModelPtr CompileSpec(mjSpec* spec, const mjVFS* assets) {
  mjModel* model = mj_compile(spec, assets);
  if (model == nullptr) throw InternalError(std::string("MuJoCo: ") + mjs_getError(spec));
  return ModelPtr(model);
}

mjsJoint* DrivenJoint(mjSpec* spec, const std::string& motor) {
  const mjsActuator* actuator =
      mjs_asActuator(mjs_findElement(spec, mjOBJ_ACTUATOR, motor.c_str()));
  return mjs_asJoint(mjs_findElement(spec, mjOBJ_JOINT, mjs_getString(actuator->target)));
}

}  // namespace floorproof

// SPDX-License-Identifier: Apache-2.0
// An OpenGL context without a window, from whatever this machine offers. The one place that knows
// OSMesa and EGL; both are opened at run time, so that simulation needs neither.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace floorproof {

class GlContext {
 public:
  virtual ~GlContext() = default;
  // Makes this context current on the calling thread. Throws InternalError; InputError in a process
  // that was forked from the one that made it.
  virtual void MakeCurrent() = 0;
  // Whether it is here by a fork: then nothing of it may be used, nor freed.
  bool inherited() const;
  int max_side_px() const { return max_side_px_; }  // of a picture drawn off screen

 protected:
  int max_side_px_ = 0;
};

// Makes a context and makes it current. OSMesa is tried first (software, the same pixels on every
// machine), then EGL on Mesa's surfaceless platform; the environment variable FLOORPROOF_GL=osmesa
// or =egl allows only that one. The first success binds the process: MuJoCo resolves its GL
// functions once, so later contexts come from the same backend. Not for concurrent calls.
// Throws InternalError that says, for each backend, why not; InputError in a process that was
// forked from one that had drawn: the library's threads are not in it, and drawing would wait for
// them.
std::unique_ptr<GlContext> MakeGlContext();

// Whether this process has made a context.
bool DrawsAlready();

// What `doctor` shows.
struct GlReport {
  std::string backend;                // "osmesa" or "egl"; empty: there is none
  std::string renderer;               // as GL_RENDERER says
  std::string version;                // as GL_VERSION says
  std::vector<std::string> failures;  // "osmesa: why it did not work", for each that was tried
};
// Makes a context and drops it again; throws nothing for want of GL.
GlReport ProbeGl();

}  // namespace floorproof

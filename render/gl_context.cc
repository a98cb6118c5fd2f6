// SPDX-License-Identifier: Apache-2.0
// MuJoCo looks up its GL functions through eglGetProcAddress, OSMesaGetProcAddress or
// glXGetProcAddressARB, whichever it finds first among the process's global symbols. The
// environment variable MUJOCO_GL says which to prefer. OpenCV brings libGLX along, so a loaded
// library alone does not decide it. We therefore publish the library that made the context
// (RTLD_GLOBAL) and set MUJOCO_GL to it. A library that was opened stays open, because drivers keep
// threads and exit handlers.
#include "render/gl_context.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <span>

#include "base/error.h"
#include "base/sanitizer.h"

#ifdef FP_ADDRESS_SANITIZER
// What libraries never free: OSMesa the frame buffer that OSMesaMakeCurrent makes for a context,
// Fontconfig, which finds fonts for the pictures' letters, some of what it matched.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa.so\nleak:libfontconfig.so\n";
}
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace floorproof {
namespace {

// What makes a context impossible, in words; caught where the next backend is tried.
class Unavailable : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Library {
 public:
  explicit Library(std::span<const char* const> names) {
    std::string why;
    for (const char* name : names) {
      handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      if (handle_ != nullptr) {
        name_ = name;
        return;
      }
      if (why.empty()) why = dlerror();
    }
    throw Unavailable(why);
  }

  template <class F>
  F* Get(const char* symbol) const {
    void* address = dlsym(handle_, symbol);
    if (address == nullptr) throw Unavailable(name_ + " lacks " + symbol);
    return reinterpret_cast<F*>(address);
  }

  void Publish(const char* mujoco_gl) const {
    dlopen(name_.c_str(), RTLD_NOW | RTLD_GLOBAL);
    setenv("MUJOCO_GL", mujoco_gl, /*overwrite=*/1);
  }

 private:
  std::string name_;
  void* handle_ = nullptr;
};

using ProcAddress = void (*)();

// The process that draws, once there is one. A context is its alone.
pid_t g_drawing = 0;

bool IsForked() { return g_drawing != 0 && g_drawing != getpid(); }

void RefuseInFork() {
  if (IsForked())
    throw InputError(
        "drawing: this process was forked from one that had drawn, and the drawing library's "
        "threads are not in it: start it by spawn or forkserver, or draw nothing before");
}

// The values of GL/gl.h, GL/osmesa.h and EGL/egl.h that are used here, so that building needs none.
constexpr unsigned kGlRgba = 0x1908, kGlUnsignedByte = 0x1401;
constexpr unsigned kGlMaxRenderbufferSize = 0x84E8;
constexpr unsigned kGlRenderer = 0x1F01, kGlVersion = 0x1F02, kGlExtensions = 0x1F03;

class OsmesaContext : public GlContext {
 public:
  static constexpr const char* kName = "osmesa";

  OsmesaContext() : lib_(kLibraries) {
    const auto create =
        lib_.Get<void*(unsigned format, int depth, int stencil, int accum, void* share)>(
            "OSMesaCreateContextExt");
    destroy_ = lib_.Get<void(void*)>("OSMesaDestroyContext");
    make_current_ = lib_.Get<unsigned char(void*, void*, unsigned type, int width, int height)>(
        "OSMesaMakeCurrent");
    get_proc_ = lib_.Get<ProcAddress(const char*)>("OSMesaGetProcAddress");
    context_ = create(kGlRgba, 24, 8, 0, nullptr);
    if (context_ == nullptr) throw Unavailable("OSMesaCreateContextExt failed");
  }
  ~OsmesaContext() override {
    if (!inherited()) destroy_(context_);
  }

  void MakeCurrent() override {
    RefuseInFork();
    if (!make_current_(context_, window_.data(), kGlUnsignedByte, kSide, kSide)) {
      throw InternalError("OSMesaMakeCurrent failed");
    }
  }
  ProcAddress Proc(const char* symbol) const { return get_proc_(symbol); }
  void Publish() const { lib_.Publish(kName); }
  void SetMaxSide(int side_px) { max_side_px_ = side_px; }

 private:
  static constexpr std::array kLibraries = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  static constexpr int kSide = 16;  // frames are drawn off screen, so the window may be tiny

  Library lib_;
  void (*destroy_)(void*);
  unsigned char (*make_current_)(void*, void*, unsigned, int, int);
  ProcAddress (*get_proc_)(const char*);
  void* context_ = nullptr;
  std::array<std::uint32_t, kSide * kSide> window_{};
};

class EglContext : public GlContext {
 public:
  static constexpr const char* kName = "egl";

  EglContext() : lib_(kLibraries) {
    const auto get_error = lib_.Get<int()>("eglGetError");
    const auto check = [&](bool ok, const char* what) {
      if (ok) return;
      throw Unavailable(fmt::format("{} failed with EGL error 0x{:04x}", what,
                                    static_cast<unsigned>(get_error())));
    };
    get_proc_ = lib_.Get<ProcAddress(const char*)>("eglGetProcAddress");
    make_current_ = lib_.Get<unsigned(void*, void*, void*, void*)>("eglMakeCurrent");
    destroy_ = lib_.Get<unsigned(void*, void*)>("eglDestroyContext");
    display_ = lib_.Get<void*(unsigned, void*, const std::intptr_t*)>("eglGetPlatformDisplay")(
        kPlatformSurfaceless, nullptr, nullptr);
    check(display_ != nullptr, "eglGetPlatformDisplay(surfaceless)");
    check(lib_.Get<unsigned(void*, int*, int*)>("eglInitialize")(display_, nullptr, nullptr),
          "eglInitialize");
    check(lib_.Get<unsigned(unsigned)>("eglBindAPI")(kOpenGlApi), "eglBindAPI(OpenGL)");
    const char* extensions = lib_.Get<const char*(void*, int)>("eglQueryString")(display_, 0x3055);
    if (extensions == nullptr || !std::strstr(extensions, "EGL_KHR_surfaceless_context")) {
      throw Unavailable("EGL_KHR_surfaceless_context is missing");
    }
    constexpr std::array kConfig = {0x3040, 0x0008,  // EGL_RENDERABLE_TYPE: EGL_OPENGL_BIT
                                    0x3033, 0x0001,  // EGL_SURFACE_TYPE: EGL_PBUFFER_BIT
                                    0x3038};         // EGL_NONE
    void* config = nullptr;
    int count = 0;
    check(lib_.Get<unsigned(void*, const int*, void**, int, int*)>("eglChooseConfig")(
              display_, kConfig.data(), &config, 1, &count) &&
              count > 0,
          "eglChooseConfig");
    context_ = lib_.Get<void*(void*, void*, void*, const int*)>("eglCreateContext")(
        display_, config, nullptr, nullptr);
    check(context_ != nullptr, "eglCreateContext");
  }
  ~EglContext() override {
    if (inherited()) return;
    make_current_(display_, nullptr, nullptr, nullptr);
    destroy_(display_, context_);
  }

  void MakeCurrent() override {
    RefuseInFork();
    if (!make_current_(display_, nullptr, nullptr, context_)) {
      throw InternalError("eglMakeCurrent failed");
    }
  }
  ProcAddress Proc(const char* symbol) const { return get_proc_(symbol); }
  void Publish() const { lib_.Publish(kName); }
  void SetMaxSide(int side_px) { max_side_px_ = side_px; }

 private:
  static constexpr std::array kLibraries = {"libEGL.so.1", "libEGL.so"};
  static constexpr unsigned kPlatformSurfaceless = 0x31DD, kOpenGlApi = 0x30A2;

  Library lib_;
  ProcAddress (*get_proc_)(const char*);
  unsigned (*make_current_)(void*, void*, void*, void*);
  unsigned (*destroy_)(void*, void*);
  void* display_ = nullptr;
  void* context_ = nullptr;
};

struct Made {
  std::unique_ptr<GlContext> context;
  std::string renderer, version;
};

// mjr_makeContext ends the process when it misses something, so the same questions are asked here.
template <class Context>
Made Make() {
  auto context = std::make_unique<Context>();
  context->MakeCurrent();
  const auto get_string =
      reinterpret_cast<const unsigned char* (*)(unsigned)>(context->Proc("glGetString"));
  if (get_string == nullptr) throw Unavailable("no glGetString");
  const auto text = [&](unsigned name) {
    const unsigned char* s = get_string(name);
    return std::string(s == nullptr ? "" : reinterpret_cast<const char*>(s));
  };
  Made made{nullptr, text(kGlRenderer), text(kGlVersion)};
  if (std::atof(made.version.c_str()) < 1.5) throw Unavailable("OpenGL is " + made.version);
  const std::string extensions = text(kGlExtensions);
  for (const char* needed : {"GL_ARB_framebuffer_object", "GL_ARB_vertex_buffer_object"}) {
    if (extensions.find(needed) == std::string::npos) {
      throw Unavailable(made.renderer + " lacks " + needed);
    }
  }
  const auto get_integer =
      reinterpret_cast<void (*)(unsigned, int*)>(context->Proc("glGetIntegerv"));
  int max_side_px = 0;
  get_integer(kGlMaxRenderbufferSize, &max_side_px);
  context->SetMaxSide(max_side_px);
  context->Publish();
  made.context = std::move(context);
  return made;
}

struct Backend {
  const char* name;
  Made (*make)();
};
constexpr std::array kBackends = {Backend{OsmesaContext::kName, Make<OsmesaContext>},
                                  Backend{EglContext::kName, Make<EglContext>}};

Made MakeFirst(GlReport& report) {
  RefuseInFork();
  static const char* bound = nullptr;  // the backend whose functions MuJoCo has
  const char* wanted = std::getenv("FLOORPROOF_GL");
  if (wanted != nullptr && *wanted == '\0') wanted = nullptr;
  bool known = wanted == nullptr;
  for (const Backend& backend : kBackends) {
    if (wanted != nullptr && std::strcmp(wanted, backend.name) != 0) continue;
    known = true;
    if (bound != nullptr && bound != backend.name) {
      report.failures.push_back(std::string(backend.name) + ": this process draws with " + bound);
      continue;
    }
    try {
      Made made = backend.make();
      bound = backend.name;
      g_drawing = getpid();
      report.backend = backend.name;
      report.renderer = made.renderer;
      report.version = made.version;
      return made;
    } catch (const std::runtime_error& error) {
      report.failures.push_back(std::string(backend.name) + ": " + error.what());
    }
  }
  if (!known) {
    report.failures.push_back(std::string("FLOORPROOF_GL = ") + wanted + ": must be osmesa or egl");
  }
  return {};
}

}  // namespace

bool GlContext::inherited() const { return IsForked(); }

bool DrawsAlready() { return g_drawing != 0; }

std::unique_ptr<GlContext> MakeGlContext() {
  GlReport report;
  Made made = MakeFirst(report);
  if (made.context != nullptr) return std::move(made.context);
  std::string message = "no OpenGL to draw with";
  for (const std::string& failure : report.failures) message += "; " + failure;
  throw InternalError(message +
                      " (on Debian and Ubuntu: apt-get install libosmesa6, or libegl1 and "
                      "libgl1-mesa-dri)");
}

GlReport ProbeGl() {
  GlReport report;
  MakeFirst(report);
  return report;
}

}  // namespace floorproof

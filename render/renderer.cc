// SPDX-License-Identifier: Apache-2.0
#include "render/renderer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "render/gl_context.h"

namespace floorproof {
namespace {

constexpr float kOpaque = 0.995f;  // MuJoCo's own limit
constexpr float kShellAlpha = 0.35f;

Eigen::Vector3f F(const Vec3& v) { return v.cast<float>(); }
Eigen::Map<Eigen::Vector3f> Pos(mjvGeom& geom) { return Eigen::Map<Eigen::Vector3f>(geom.pos); }

mjvGLCamera GlCamera(const CameraView& view, double near_m, double far_m) {
  mjvGLCamera camera{};
  const Vec3 forward = (view.target_W - view.eye_W).normalized();
  const Vec3 right = forward.cross(view.up_W).normalized();
  Eigen::Map<Eigen::Vector3f>(camera.pos) = F(view.eye_W);
  Eigen::Map<Eigen::Vector3f>(camera.forward) = F(forward);
  Eigen::Map<Eigen::Vector3f>(camera.up) = F(right.cross(forward));
  const double half =
      view.orthographic ? 0.5 * view.height_m : near_m * std::tan(0.5 * view.fovy_rad);
  camera.frustum_top = static_cast<float>(half);
  camera.frustum_bottom = static_cast<float>(-half);
  camera.frustum_near = static_cast<float>(near_m);
  camera.frustum_far = static_cast<float>(far_m);
  camera.orthographic = view.orthographic;
  return camera;
}

// What the camera sees, as a pyramid or, orthographic, a box without ends.
class Sight {
 public:
  Sight(const CameraView& view, double aspect) : eye_(F(view.eye_W)) {
    forward_ = F((view.target_W - view.eye_W).normalized());
    right_ = forward_.cross(F(view.up_W)).normalized();
    up_ = right_.cross(forward_);
    if (view.orthographic) {
      half_y_ = static_cast<float>(0.5 * view.height_m);
    } else {
      slope_y_ = static_cast<float>(std::tan(0.5 * view.fovy_rad));
    }
    half_x_ = half_y_ * static_cast<float>(aspect);
    slope_x_ = slope_y_ * static_cast<float>(aspect);
  }
  // False only if the ball lies wholly outside.
  bool Touches(const Eigen::Vector3f& centre, float radius) const {
    const Eigen::Vector3f p = centre - eye_;
    const float depth = p.dot(forward_);
    if (depth < -radius) return false;
    const auto beyond = [&](float lateral, float half, float slope) {
      return std::abs(lateral) - half - slope * std::max(depth, 0.0f) >
             radius * std::sqrt(1 + slope * slope);
    };
    return !beyond(p.dot(right_), half_x_, slope_x_) && !beyond(p.dot(up_), half_y_, slope_y_);
  }

 private:
  Eigen::Vector3f eye_, forward_, right_, up_;
  float half_x_ = 0, half_y_ = 0, slope_x_ = 0, slope_y_ = 0;
};

// Distance from the segment eye-target to a box, to some 2 % of the segment's length.
float DistanceToBox(const mjvGeom& box, const Eigen::Vector3f& eye, const Eigen::Vector3f& target) {
  const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> R_WG(box.mat);
  const Eigen::Map<const Eigen::Vector3f> p_WG(box.pos), size(box.size);
  const Eigen::Vector3f a = R_WG.transpose() * (eye - p_WG);
  const Eigen::Vector3f b = R_WG.transpose() * (target - p_WG);
  constexpr int kSteps = 24;
  float best = 1e9f;
  for (int i = 0; i <= kSteps; ++i) {
    const Eigen::Vector3f p = a + (b - a) * (static_cast<float>(i) / kSteps);
    best = std::min(best, (p.cwiseAbs() - size).cwiseMax(0.0f).norm());
  }
  return best;
}

// The highest point of a geom of the model; none for planes.
float TopOf(const mjModel* model, const mjvGeom& geom) {
  if (geom.objtype != mjOBJ_GEOM || geom.type == mjGEOM_PLANE) {
    return -std::numeric_limits<float>::infinity();
  }
  const mjtNum* box = model->geom_aabb + 6 * geom.objid;  // centre and half sides, geom's own frame
  double top = geom.pos[2];
  for (int k = 0; k < 3; ++k)
    top += geom.mat[6 + k] * box[k] + std::abs(geom.mat[6 + k]) * box[3 + k];
  return static_cast<float>(top);
}

bool IsGlass(const mjModel* model, const mjvGeom& geom) {
  if (geom.objtype != mjOBJ_GEOM) return false;
  const int material = model->geom_matid[geom.objid];
  return (material < 0 ? model->geom_rgba[4 * geom.objid + 3] : model->mat_rgba[4 * material + 3]) <
         kOpaque;
}

// Makes transparent what stands between the camera and its target: the nearer to the line of sight,
// the more transparent, so that nothing pops up when the camera moves on.
void ThinOut(mjvGeom& geom, float top, const Eigen::Vector3f& eye, const Eigen::Vector3f& target) {
  if (geom.category != mjCAT_STATIC || geom.type != mjGEOM_BOX || geom.rgba[3] < kOpaque) return;
  if (top < target.z() + 0.1f) return;
  constexpr float kThin_m = 0.10f, kFull_m = 0.30f, kAlpha = 0.07f;  // blended twice by MuJoCo
  const float d = DistanceToBox(geom, eye, target);
  const float t = std::clamp((d - kThin_m) / (kFull_m - kThin_m), 0.0f, 1.0f);
  geom.rgba[3] = kAlpha + (1 - kAlpha) * t * t * (3 - 2 * t);
}

}  // namespace

// The C structs and their frees.
struct OffscreenRenderer::Gl {
  Gl(const mjModel* model, int width, int height, int max_marks, RenderQuality quality)
      : context(MakeGlContext()) {
    if (std::min(width, height) < 1 || std::max(width, height) > context->max_side_px()) {
      throw InternalError("cannot draw " + std::to_string(width) + " x " + std::to_string(height) +
                          " pixels: at most " + std::to_string(context->max_side_px()) + " a side");
    }
    mjv_defaultOption(&option);
    option.flags[mjVIS_RANGEFINDER] = 0;
    // Where env/scene puts floors, walls and hazards; the engine's own viewer would leave them out.
    std::fill(option.geomgroup + 4, option.geomgroup + mjNGROUP, mjtByte{1});
    std::fill(std::begin(option.sitegroup), std::end(option.sitegroup), mjtByte{0});
    mjv_defaultPerturb(&perturb);
    mjv_defaultCamera(&camera);
    camera.type = mjCAMERA_USER;
    mjv_defaultScene(&scene);
    mjv_makeScene(model, &scene, static_cast<int>(model->ngeom) + max_marks + 64);
    mjr_defaultContext(&draw);
    mjModel sized = *model;  // borrows the arrays; only the picture's size differs
    sized.vis.global.offwidth = width;
    sized.vis.global.offheight = height;
    if (quality == RenderQuality::kDraft) {
      sized.vis.quality.shadowsize = 0;
      sized.vis.quality.numslices = 14;  // of what is round: a Mecanum robot has 144 rollers
      sized.vis.quality.numstacks = 8;
      scene.flags[mjRND_SHADOW] = scene.flags[mjRND_REFLECTION] = 0;
    }
    mjr_makeContext(&sized, &draw, mjFONTSCALE_50);
    mjr_setBuffer(mjFB_OFFSCREEN, &draw);
    if (draw.currentBuffer != mjFB_OFFSCREEN) throw InternalError("no off-screen frame buffer");
  }
  ~Gl() {
    if (!context->inherited()) {
      context->MakeCurrent();
      mjr_freeContext(&draw);
    }
    mjv_freeScene(&scene);
  }

  std::unique_ptr<GlContext> context;
  mjvScene scene;
  mjrContext draw;
  mjvOption option;
  mjvPerturb perturb;
  mjvCamera camera;
};

OffscreenRenderer::OffscreenRenderer(const mjModel* model, int width, int height, int max_marks,
                                     RenderQuality quality)
    : model_(model),
      width_(width),
      height_(height),
      gl_(std::make_unique<Gl>(model, width, height, max_marks, quality)) {}

OffscreenRenderer::~OffscreenRenderer() = default;

void OffscreenRenderer::SeeThrough(std::vector<int> geoms) {
  see_through_.assign(geoms.empty() ? 0 : static_cast<std::size_t>(model_->ngeom), false);
  for (const int geom : geoms) see_through_[static_cast<std::size_t>(geom)] = true;
}

Image OffscreenRenderer::MakeImage() const { return GreyImage(width_, height_, 0); }

void OffscreenRenderer::Compose(mjData* data, const CameraView& view, const FloorPaint* paint) {
  mjvScene& scene = gl_->scene;
  const double distance = (view.target_W - view.eye_W).norm();
  const double extent = model_->stat.extent;
  const Vec3 middle(model_->stat.center[0], model_->stat.center[1], model_->stat.center[2]);
  scene.camera[0] = scene.camera[1] =
      GlCamera(view, 0.02 * distance, 2 * distance + 4 * extent + (middle - view.eye_W).norm());
  mjv_updateScene(model_, data, &gl_->option, &gl_->perturb, &gl_->camera, mjCAT_ALL, &scene);

  constexpr float kFloor_m = 0.001f;
  constexpr float kShadowReach_m = 1.0f;  // of things out of sight into sight
  const Sight sight(view, static_cast<double>(width_) / height_);
  const Eigen::Vector3f eye = F(view.eye_W), target = F(view.target_W);
  int kept = 0;
  for (int i = 0; i < scene.ngeom; ++i) {
    mjvGeom& geom = scene.geoms[i];
    const bool endless = geom.modelrbound <= 0;  // a plane
    if (!endless && !sight.Touches(Pos(geom), geom.modelrbound + kShadowReach_m)) continue;
    const float top = TopOf(model_, geom);
    ThinOut(geom, top, eye, target);
    if (geom.objtype == mjOBJ_GEOM && !see_through_.empty() &&
        see_through_[static_cast<std::size_t>(geom.objid)])
      geom.rgba[3] = std::min(geom.rgba[3], kShellAlpha);
    // Decorative geoms cast no shadow. Neither should glass, or what is made transparent. The
    // floor's own shadow, which nothing shows, would cost a whole map to draw, and speckles at its
    // border.
    const bool floor = geom.category == mjCAT_STATIC && top < kFloor_m;
    if (floor || geom.rgba[3] < 0.5f || IsGlass(model_, geom)) geom.category = mjCAT_DECOR;
    if (kept != i) scene.geoms[kept] = geom;
    ++kept;
  }
  scene.ngeom = kept;
  if (paint != nullptr) {
    for (const mjvGeom& geom : paint->geoms()) {
      if (scene.ngeom == scene.maxgeom) break;
      mjvGeom& slot = scene.geoms[scene.ngeom];
      slot = geom;
      if (sight.Touches(Pos(slot), slot.modelrbound)) ++scene.ngeom;
    }
  }

  // MuJoCo maps the shadows of a directional light in a square around the light's position, between
  // the camera's near and far distances.
  const double reach = view.orthographic ? view.height_m : 1.6 * distance;
  gl_->draw.shadowClip = static_cast<float>(std::min(reach, 2.0 * extent));
  for (int i = 0; i < scene.nlight; ++i) {
    mjvLight& light = scene.lights[i];
    if (light.type != mjLIGHT_DIRECTIONAL || !light.castshadow) continue;
    const Eigen::Vector3f dir = Eigen::Map<Eigen::Vector3f>(light.dir).normalized();
    Eigen::Map<Eigen::Vector3f>(light.pos) = target - 0.4f * scene.camera[0].frustum_far * dir;
  }
}

void OffscreenRenderer::Render(mjData* data, const CameraView& view, const FloorPaint* paint,
                               Image& out) {
  gl_->context->MakeCurrent();
  Compose(data, view, paint);
  const mjrRect whole = {0, 0, width_, height_};
  mjr_render(whole, &gl_->scene, &gl_->draw);
  mjr_readPixels(out.data.data(), nullptr, whole, &gl_->draw);
  if (const int error = mjr_getError(); error != 0) {
    throw InternalError("OpenGL error " + std::to_string(error) + " while drawing");
  }
  // GL gives the bottom row first.
  const std::size_t stride = static_cast<std::size_t>(width_) * 3;
  for (int top = 0, bottom = height_ - 1; top < bottom; ++top, --bottom) {
    std::swap_ranges(out.data.data() + top * stride, out.data.data() + (top + 1) * stride,
                     out.data.data() + bottom * stride);
  }
}

void PoseForPicture(const mjModel* model, mjData* data) {
  mj_kinematics(model, data);
  mj_comPos(model, data);  // lights and cameras may track centres of mass
  mj_camlight(model, data);
}

}  // namespace floorproof

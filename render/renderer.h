// SPDX-License-Identifier: Apache-2.0
// Pictures of a MuJoCo scene, off screen. The one place that knows MuJoCo's renderer.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <memory>
#include <vector>

#include "env/media/media.h"
#include "render/camera.h"

namespace floorproof {

// Stripes and discs painted on the floor: a planned path, a driven trace. They cast no shadow.
class FloorPaint {
 public:
  explicit FloorPaint(int max_marks = 4000) : max_marks_(max_marks) {}
  // A flat stripe from a to b, width_m wide, its top at z_m or up to 1 mm below; alpha below 1 lets
  // the floor through. Returns its number. Beyond max_marks the oldest give way.
  std::size_t AddStripe(const Vec2& a_W, const Vec2& b_W, double z_m, double width_m,
                        const std::array<float, 4>& rgba);
  void MoveStripe(std::size_t stripe, const Vec2& a_W, const Vec2& b_W);
  void AddDisc(const Vec2& p_W, double z_m, double radius_m, const std::array<float, 4>& rgba);
  const std::vector<mjvGeom>& geoms() const { return geoms_; }
  int max_marks() const { return max_marks_; }

 private:
  std::size_t Place(const mjvGeom& geom);
  double Layer(double z_m);

  int max_marks_;
  int layer_ = 0;
  std::size_t next_ = 0;
  std::vector<mjvGeom> geoms_;
};

// Draws with the lights, materials and quality that the model states (mjModel.vis), at a size of
// its own. Geoms that cannot be seen are left out; world geoms between the camera and its target
// are drawn as if of thin glass; shadows of directional lights are drawn around the target.
class OffscreenRenderer {
 public:
  // Throws InternalError when there is no GL to draw with or the picture is too large for it.
  // The model must outlive the renderer.
  OffscreenRenderer(const mjModel* model, int width, int height, int max_marks = 4000);
  ~OffscreenRenderer();
  OffscreenRenderer(const OffscreenRenderer&) = delete;
  OffscreenRenderer& operator=(const OffscreenRenderer&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  Image MakeImage() const;  // black, of the right size

  // `data` needs current kinematics and lights (PoseForPicture); `out` comes from MakeImage().
  void Render(mjData* data, const CameraView& view, const FloorPaint* paint, Image& out);

 private:
  struct Gl;
  void Compose(mjData* data, const CameraView& view, const FloorPaint* paint);

  const mjModel* model_;
  int width_, height_;
  std::unique_ptr<Gl> gl_;
};

// Brings everything that a picture shows up to date with data->qpos, without any dynamics.
void PoseForPicture(const mjModel* model, mjData* data);

}  // namespace floorproof

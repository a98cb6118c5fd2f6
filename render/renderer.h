// SPDX-License-Identifier: Apache-2.0
// Pictures of a MuJoCo scene, off screen. The one place that knows MuJoCo's renderer.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <vector>

#include "media/media.h"
#include "render/camera.h"
#include "render/floor_paint.h"

namespace floorproof {

// Of a picture: as the model states it; or quick, in half of the time: no shadows, and what is
// round has fewer sides. Lines stay smooth: without several samples a pixel the plan's would tear.
enum class RenderQuality { kGood, kDraft };

// Draws with the lights, materials and quality that the model states (mjModel.vis), at a size of
// its own. Geoms that cannot be seen are left out; world geoms between the camera and its target
// are drawn as if of thin glass; shadows of directional lights are drawn around the target.
class OffscreenRenderer {
 public:
  // Throws InternalError when there is no GL to draw with or the picture is too large for it.
  // The model must outlive the renderer.
  OffscreenRenderer(const mjModel* model, int width, int height, int max_marks = 4000,
                    RenderQuality quality = RenderQuality::kGood);
  ~OffscreenRenderer();
  OffscreenRenderer(const OffscreenRenderer&) = delete;
  OffscreenRenderer& operator=(const OffscreenRenderer&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  Image MakeImage() const;  // black, of the right size

  // These geoms of the model are drawn as if of thin glass from now on; none: as they are.
  void SeeThrough(std::vector<int> geoms);
  // `data` needs current kinematics and lights (PoseForPicture); `out` comes from MakeImage().
  void Render(mjData* data, const CameraView& view, const FloorPaint* paint, Image& out);

 private:
  struct Gl;
  void Compose(mjData* data, const CameraView& view, const FloorPaint* paint);

  const mjModel* model_;
  int width_, height_;
  std::vector<bool> see_through_;  // by geom; empty: none
  std::unique_ptr<Gl> gl_;
};

// Brings everything that a picture shows up to date with data->qpos, without any dynamics.
void PoseForPicture(const mjModel* model, mjData* data);

}  // namespace floorproof

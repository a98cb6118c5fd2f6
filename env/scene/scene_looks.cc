// SPDX-License-Identifier: Apache-2.0
#include "env/scene/scene_looks.h"

#include <algorithm>
#include <array>

#include "env/scene/free_names.h"

namespace floorproof {
namespace {

template <class T>
void Copy(std::array<T, 3> from, T* to) {
  std::copy(from.begin(), from.end(), to);
}

// Tiles of half a metre with a joint between them, on a plane and on slabs alike.
std::string AddFloorTiles(mjSpec* spec) {
  const std::string tiles = FreeNames(spec, mjOBJ_TEXTURE).For("floor");
  const std::string name = FreeNames(spec, mjOBJ_MATERIAL).For("floor");
  mjsTexture* texture = mjs_addTexture(spec, nullptr);
  mjs_setName(texture->element, tiles.c_str());
  texture->type = mjTEXTURE_2D;
  texture->builtin = mjBUILTIN_FLAT;
  texture->mark = mjMARK_EDGE;
  Copy<double>({0.90, 0.88, 0.84}, texture->rgb1);
  Copy<double>({0.74, 0.72, 0.68}, texture->markrgb);
  texture->width = texture->height = 256;
  mjsMaterial* material = mjs_addMaterial(spec, nullptr);
  mjs_setName(material->element, name.c_str());
  mjs_setInStringVec(material->textures, mjTEXROLE_RGB, tiles.c_str());
  material->texuniform = 1;
  material->texrepeat[0] = material->texrepeat[1] = 4;
  material->specular = 0;
  return name;
}

void AddSky(mjSpec* spec) {
  const std::string name = FreeNames(spec, mjOBJ_TEXTURE).For("sky");
  mjsTexture* texture = mjs_addTexture(spec, nullptr);
  mjs_setName(texture->element, name.c_str());
  texture->type = mjTEXTURE_SKYBOX;
  texture->builtin = mjBUILTIN_GRADIENT;
  Copy<double>({0.93, 0.95, 0.97}, texture->rgb1);
  Copy<double>({0.66, 0.73, 0.80}, texture->rgb2);
  texture->width = 64;
  texture->height = 384;
}

std::string AddMaterial(mjSpec* spec, const char* wanted, std::array<float, 4> rgba) {
  const std::string name = FreeNames(spec, mjOBJ_MATERIAL).For(wanted);
  mjsMaterial* material = mjs_addMaterial(spec, nullptr);
  mjs_setName(material->element, name.c_str());
  std::copy(rgba.begin(), rgba.end(), material->rgba);
  material->specular = 0.1f;
  material->shininess = 0.1f;
  return name;
}

}  // namespace

Vec2 MiddleOf(const GridFrame& frame) {
  return frame.X_WG * Vec2(frame.width * frame.cell_m / 2, frame.height * frame.cell_m / 2);
}

Looks AddLooks(const GridFrame& frame, mjSpec* spec) {
  Looks looks;
  looks.floor = AddFloorTiles(spec);
  AddSky(spec);
  looks.wall = AddMaterial(spec, "wall", {0.52f, 0.58f, 0.66f, 1.0f});
  looks.pit = AddMaterial(spec, "pit", {0.36f, 0.33f, 0.31f, 1.0f});
  // The lights add up to just below 1 on the floor, so that it does not burn out.
  mjsLight* sun = mjs_addLight(mjs_findBody(spec, "world"), nullptr);
  const Vec2 middle = MiddleOf(frame);
  sun->type = mjLIGHT_DIRECTIONAL;
  Copy<double>({middle.x(), middle.y(), 10}, sun->pos);
  Copy<double>({0.35, 0.25, -1}, sun->dir);
  sun->castshadow = 1;
  Copy<float>({0, 0, 0}, sun->ambient);
  Copy<float>({0.52f, 0.51f, 0.48f}, sun->diffuse);
  Copy<float>({0.15f, 0.15f, 0.15f}, sun->specular);
  mjVisual& visual = spec->visual;
  Copy<float>({0.40f, 0.40f, 0.42f}, visual.headlight.ambient);
  Copy<float>({0.15f, 0.15f, 0.15f}, visual.headlight.diffuse);
  Copy<float>({0, 0, 0}, visual.headlight.specular);
  visual.global.offwidth = 1920;
  visual.global.offheight = 1080;
  visual.quality.shadowsize = 2048;
  visual.quality.offsamples = 4;
  visual.quality.numquads = 1;
  visual.quality.numslices = 20;  // of what is round; the engine's 28 take twice as long to draw
  visual.quality.numstacks = 10;
  visual.map.znear = 0.02f;
  // Sizes of shadows, clipping planes and lights follow the extent.
  spec->stat.extent = std::max(frame.width, frame.height) * frame.cell_m;
  Copy<double>({middle.x(), middle.y(), 0}, spec->stat.center);
  return looks;
}

}  // namespace floorproof

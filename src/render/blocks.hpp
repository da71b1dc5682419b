// The C++ side of render/blocks.glsl: the same structs, with their layout checked.
#pragma once

#include <cstddef>

#include "core/math/math.hpp"

namespace lucerna::render::blocks {

using glm::mat4;
using glm::uvec4;
using glm::vec4;

#include "render/blocks.glsl"

static_assert(sizeof(ViewValues) == 4 * 64 + 5 * 16);
static_assert(offsetof(ViewValues, eyeW) == 256);
static_assert(sizeof(ShadowViewValues) == 4 * 64 + 7 * 16);
static_assert(sizeof(TextureUse) == 32);
static_assert(sizeof(MaterialValues) == 512);
static_assert(offsetof(MaterialValues, albedoUse) == 80);
static_assert(offsetof(MaterialValues, albedoGeneration) == 304);
static_assert(sizeof(ObjectValues) == 64 + 4 * 16);
static_assert(sizeof(LightValues) == 5 * 16);
static_assert(sizeof(ShadowMapValues) == 64 + 6 * 16);
static_assert(offsetof(ShadowMapValues, square) == 64 + 4 * 16);

// The fixed part of LightBlock, before its LightValues.
struct LightHeader {
  vec4 ambient;  // rgb: a white surface shows it
  uvec4 count;   // x: lights that follow
};
static_assert(sizeof(LightHeader) == 32);

}  // namespace lucerna::render::blocks

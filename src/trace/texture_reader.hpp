// Texels of a scene's textures between their centres, in the finest level.
#pragma once

#include "scene/scene.hpp"

namespace lucerna::trace {

// Linear colour; U8 and U16 are sRGB-encoded. uv (0, 0) is the top left corner of the picture.
vec4 colorAt(const scene::Texture& texture, vec2 uv);
// As stored: normal maps, roughness.
vec4 dataAt(const scene::Texture& texture, vec2 uv);
// The last component of either, for less; 1 where the picture has no alpha channel.
float alphaAt(const scene::Texture& texture, vec2 uv);
// Linear colour that a cube map has in a direction (scene::Texture::faces).
vec4 cubeColorAt(const scene::Texture& texture, vec3 directionW);

}  // namespace lucerna::trace

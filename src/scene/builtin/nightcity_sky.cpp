// The sky over the city: a cube map with the glow of the horizon, stars and a moon.
#include "scene/builtin/assembly.hpp"
#include "scene/builtin/nightcity.hpp"
#include "scene/builtin/procedural_texture.hpp"

namespace lucerna::scene::builtin::city {
namespace {

constexpr int kSize = 256;

// The direction of a place on a face: each is what a camera at the origin sees along its axis,
// upright; up and down are seen by tilting the head from -z.
vec3 faceDirection(int face, vec2 p) {
  const float s = 2 * p.x - 1, t = 2 * p.y - 1;
  switch (face) {
    case 0:
      return glm::normalize(vec3(1, -t, s));
    case 1:
      return glm::normalize(vec3(-1, -t, -s));
    case 2:
      return glm::normalize(vec3(s, 1, -t));
    case 3:
      return glm::normalize(vec3(s, -1, t));
    case 4:
      return glm::normalize(vec3(-s, -t, 1));
    default:
      return glm::normalize(vec3(s, -t, -1));
  }
}

// Stored (sRGB) colours; Background::intensity brings them to the scene's exposure.
vec3 nightSky(vec3 d) {
  if (d.y < 0) return vec3(0.10f, 0.09f, 0.10f);
  const float height = std::sqrt(d.y);
  vec3 color = glm::mix(vec3(0.42f, 0.30f, 0.27f), vec3(0.13f, 0.16f, 0.29f),
                        glm::smoothstep(0.f, 0.55f, height));
  color = glm::mix(color, vec3(0.05f, 0.07f, 0.15f), glm::smoothstep(0.45f, 1.f, height));
  // A haze bank that is nowhere quite even.
  const vec2 around(0.5f + std::atan2(d.x, d.z) / (2 * glm::pi<float>()), d.y);
  color *= 0.86f + 0.28f * fractalNoise(glm::clamp(around, 0.f, 0.999f), 8, 4, 3);
  const float moon = glm::dot(d, glm::normalize(vec3(-0.35f, 0.42f, -1)));
  color += 0.16f * std::pow(std::max(moon, 0.f), 60.f) * vec3(0.6f, 0.7f, 1);
  return moon > 0.99965f ? vec3(0.97f, 0.95f, 0.88f) : color;
}

vec3 daySky(vec3 d) {
  if (d.y < 0) return vec3(0.40f, 0.42f, 0.45f);
  return glm::mix(vec3(0.78f, 0.84f, 0.90f), vec3(0.30f, 0.50f, 0.82f), std::sqrt(d.y));
}

// A star in about one texel of a few hundred, more of them high up.
float star(int face, vec2 p, float height, std::uint32_t seed) {
  const auto x = static_cast<std::uint32_t>(p.x * kSize),
             y = static_cast<std::uint32_t>(p.y * kSize);
  const float chance = latticeValue(x, y, seed + static_cast<std::uint32_t>(face));
  if (chance > 0.0035f * glm::smoothstep(0.15f, 0.7f, height)) return 0;
  return 0.25f + 0.5f * latticeValue(y, x, seed + 77);
}

}  // namespace

void addSky(Scene& scene, bool day, std::uint32_t seed) {
  scene.background.kind = BackgroundKind::CubeMap;
  for (int face = 0; face < 6; ++face) {
    const auto picture = paint(kSize, kSize, [=](vec2 p) {
      const vec3 d = faceDirection(face, p);
      const float grain = (latticeValue(static_cast<std::uint32_t>(p.x * kSize),
                                        static_cast<std::uint32_t>(p.y * kSize), 5) -
                           0.5f) /
                          255;
      const vec3 color = day ? daySky(d) : nightSky(d) + star(face, p, d.y, seed);
      return vec4(color + grain, 1);
    });
    const std::uint32_t texture = addTexture(scene, fmt::format("sky {}", face), picture);
    scene.textures[texture].wrapS = scene.textures[texture].wrapT = Wrap::ClampToEdge;
    scene.background.faces[static_cast<std::size_t>(face)] = texture;
  }
}

}  // namespace lucerna::scene::builtin::city

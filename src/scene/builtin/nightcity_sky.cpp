// The sky over the city and the land around it: a cube map with the glow of the horizon, stars and
// a moon.
#include "scene/builtin/assembly.hpp"
#include "scene/builtin/nightcity.hpp"
#include "scene/builtin/procedural_texture.hpp"

namespace lucerna::scene::builtin::city {
namespace {

// Texels of a face's side. By night a star is two pixels wide at 720 rows; by day nothing is small.
constexpr int kNightSize = 768, kDaySize = 128;

constexpr float kMoonRadius = 0.0215f;      // rad, several times the real one, as painters have it
constexpr float kTexel = 2.f / kNightSize;  // of a face's middle, rad

float texelValue(vec2 p, std::uint32_t seed) {
  return latticeValue(static_cast<std::uint32_t>(p.x * kNightSize),
                      static_cast<std::uint32_t>(p.y * kNightSize), seed);
}

// Stars are one texel wide, more of them high up, few of them bright. They are laid out on each
// face by itself.
float star(int face, vec2 p, float height, std::uint32_t seed) {
  if (texelValue(p, seed + static_cast<std::uint32_t>(face)) >=
      0.0006f * glm::smoothstep(0.1f, 0.8f, height))
    return 0;
  const float magnitude = texelValue(p, seed + 77);
  return 0.15f + 0.7f * magnitude * magnitude * magnitude;
}

// Stored (sRGB) colours; Background::intensity brings them to the scene's exposure.
vec3 nightSky(vec3 d) {
  const float height = std::sqrt(std::max(d.y, 0.f));
  vec3 color = glm::mix(vec3(0.42f, 0.30f, 0.27f), vec3(0.13f, 0.16f, 0.29f),
                        glm::smoothstep(0.f, 0.55f, height));
  color = glm::mix(color, vec3(0.05f, 0.07f, 0.15f), glm::smoothstep(0.45f, 1.f, height));
  // A haze bank that is nowhere quite even.
  const vec2 around(0.5f + std::atan2(d.x, d.z) / (2 * kPi), d.y);
  return color * (0.86f + 0.28f * fractalNoise(glm::clamp(around, 0.f, 0.999f), 8, 3, 3));
}

vec3 withMoon(vec3 color, vec3 d) {
  const vec3 towardsMoon = glm::normalize(vec3(-0.35f, 0.42f, -1));
  const float near = glm::dot(d, towardsMoon);
  if (near < 0.8f) return color;  // the halo is below a 255th there
  color += 0.16f * std::pow(near, 60.f) * vec3(0.6f, 0.7f, 1);
  const float cover = 0.5f + (kMoonRadius - glm::length(d - towardsMoon)) / kTexel;
  return glm::mix(color, vec3(0.97f, 0.95f, 0.88f), glm::clamp(cover, 0.f, 1.f));
}

vec3 daySky(vec3 d) {
  return glm::mix(vec3(0.78f, 0.84f, 0.90f), vec3(0.30f, 0.50f, 0.82f),
                  std::sqrt(std::max(d.y, 0.f)));
}

// The land beyond the city, which haze takes into the sky's colour towards the horizon.
vec3 hazyLand(vec3 land, vec3 horizon, float sine, float visibility) {
  return glm::mix(land, horizon, std::exp(-sine / visibility));
}

vec3 nightColor(int face, vec2 p, vec3 d, std::uint32_t seed) {
  const float grain = (texelValue(p, 5) - 0.5f) / 255;
  constexpr vec3 kLand(0.075f, 0.08f, 0.085f);
  if (d.y < -0.25f) return kLand + grain;
  const vec3 sky = nightSky(d);
  if (d.y < 0) return hazyLand(kLand, sky, -d.y, 0.035f) + grain;
  return withMoon(sky + star(face, p, d.y, seed), d) + grain;
}

vec3 dayColor(vec3 d) {
  if (d.y < 0) return hazyLand(vec3(0.42f, 0.46f, 0.36f), daySky(d), -d.y, 0.1f);
  return daySky(d);
}

}  // namespace

void addSky(Scene& scene, bool day, std::uint32_t seed) {
  const int size = day ? kDaySize : kNightSize;
  std::vector<std::shared_ptr<const Image>> faces;
  for (int face = 0; face < 6; ++face)
    faces.push_back(paint(size, size, [=](vec2 p) {
      const vec3 d = faceDirection(face, p);
      return vec4(day ? dayColor(d) : nightColor(face, p, d, seed), 1);
    }));
  scene.background.kind = BackgroundKind::CubeMap;
  scene.background.texture = addCubeMap(scene, "sky", std::move(faces));
}

}  // namespace lucerna::scene::builtin::city

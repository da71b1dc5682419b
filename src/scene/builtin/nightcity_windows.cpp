// Lit windows and shops: emission textures, and how many windows are lit.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/builtin/assembly.hpp"
#include "scene/builtin/nightcity.hpp"
#include "scene/builtin/procedural_texture.hpp"

namespace lucerna::scene::builtin::city {
namespace {

constexpr vec3 kWindowRadiance(0.16f), kShopRadiance(0.22f);
constexpr int kCells = kColumns * kRows;
constexpr int kFacadeWidth = 512, kFacadeHeight = 1024;

// What shines through a window at `in` (0 to 1 within the glass); black is a bar.
vec3 windowLight(vec2 in, std::uint32_t hash) {
  const bool pane = std::abs(in.x - 0.5f) > 0.025f && std::abs(in.y - 0.33f) > 0.02f;
  if (!pane) return vec3(0);
  constexpr std::array<vec3, 5> kLights{vec3(1, 0.72f, 0.40f), vec3(1, 0.80f, 0.52f),
                                        vec3(1, 0.66f, 0.32f), vec3(0.86f, 0.93f, 1),
                                        vec3(1, 0.88f, 0.70f)};
  vec3 light = kLights[hash % 5] * (0.55f + 0.45f * static_cast<float>(hash >> 8 & 255) / 255.f);
  // Brighter towards the lamp at the ceiling; dark behind curtains, and behind a blind in some.
  light *= 1.f - 0.35f * in.y;
  const float curtain = 0.02f + 0.2f * static_cast<float>(hash >> 16 & 255) / 255.f;
  if (std::min(in.x, 1 - in.x) < curtain) return vec3(0);
  if ((hash >> 24 & 3) == 0 && in.y < 0.45f) return vec3(0);
  return light;
}

// The order in which the windows of a style are lit.
std::vector<int> lightingOrder(std::uint32_t seed) {
  std::vector<int> order(kCells);
  std::iota(order.begin(), order.end(), 0);
  Random random(seed, 60);
  for (std::uint32_t i = kCells; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

// Where p lies in a window of its cell: 0 to 1 within the glass.
vec2 inWindow(vec2 cell, const Facade& f) {
  return (glm::fract(cell) - f.low) / (f.high - f.low);
}
bool isGlass(vec2 in) {
  return in.x > 0 && in.y > 0 && in.x < 1 && in.y < 1;
}

std::uint32_t windowHash(int cell, std::uint32_t seed) {
  return latticeHash(static_cast<std::uint32_t>(cell % kColumns),
                     static_cast<std::uint32_t>(cell / kColumns), seed + 5);
}

// For each window, the share of the whole facade that shines when it is lit.
std::vector<double> windowShares(Style style, std::uint32_t seed) {
  constexpr int kWidth = kFacadeWidth / kColumns / 2, kHeight = kFacadeHeight / kRows / 2;
  std::vector<double> shares(kCells);
  for (int cell = 0; cell < kCells; ++cell) {
    int lit = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const vec2 in = inWindow((vec2(x, y) + 0.5f) / vec2(kWidth, kHeight), facade(style));
        lit += isGlass(in) && windowLight(in, windowHash(cell, seed)) != vec3(0);
      }
    shares[static_cast<std::size_t>(cell)] = static_cast<double>(lit) / (kWidth * kHeight * kCells);
  }
  return shares;
}

std::shared_ptr<const Image> paintWindows(Style style, const std::vector<bool>& lit,
                                          std::uint32_t seed) {
  const Facade& f = facade(style);
  return paint(kFacadeWidth, kFacadeHeight, [&](vec2 p) {
    const vec2 cell = p * vec2(kColumns, kRows);
    const int index = static_cast<int>(cell.y) * kColumns + static_cast<int>(cell.x);
    const vec2 in = inWindow(cell, f);
    if (!isGlass(in) || !lit[static_cast<std::size_t>(index)]) return vec4(0, 0, 0, 1);
    return vec4(windowLight(in, windowHash(index, seed)), 1);
  });
}

// The shop front at p: what it looks like, and what it sends out (alpha 0: nothing).
struct ShopPixel {
  vec3 albedo, light;
};
ShopPixel shopPixel(vec2 p, std::uint32_t seed) {
  constexpr int kShops = 8;
  const float at = p.x * kShops;
  const auto shop = static_cast<std::uint32_t>(at) % kShops;
  const std::uint32_t hash = latticeHash(shop, 0, seed);
  const vec2 in(glm::fract(at), p.y);
  const vec3 frame = glm::mix(vec3(0.16f, 0.12f, 0.10f), vec3(0.30f, 0.32f, 0.30f),
                              static_cast<float>(hash & 255) / 255.f);
  const bool open = shop % 8 != 2 && shop % 8 != 5 && shop % 8 != 7;
  if (in.x < 0.04f || in.x > 0.96f) return {vec3(0.42f, 0.40f, 0.37f), vec3(0)};
  constexpr std::array<vec3, 4> kBrands{vec3(0.95f, 0.25f, 0.2f), vec3(0.2f, 0.65f, 0.95f),
                                        vec3(0.98f, 0.78f, 0.3f), vec3(0.3f, 0.85f, 0.5f)};
  if (in.y > 0.08f && in.y < 0.22f) {  // the name over the window, in dashes
    const bool letters = open && in.y > 0.11f && in.y < 0.19f && in.x > 0.2f && in.x < 0.8f &&
                         latticeValue(static_cast<std::uint32_t>(in.x * 42), shop, seed) > 0.35f;
    return {frame * 0.6f, letters ? kBrands[hash >> 8 & 3] : vec3(0)};
  }
  const bool glass = in.y > 0.28f && in.y < 0.88f && in.x > 0.08f && in.x < 0.92f &&
                     std::abs(glm::fract(in.x * 3) - 0.5f) < 0.47f;
  if (!glass) return {frame, vec3(0)};
  if (!open) return {vec3(0.36f) * (0.75f + 0.25f * std::round(glm::fract(in.y * 24))), vec3(0)};
  // Goods on shelves before a bright back wall.
  const float x = in.x * 26 + static_cast<float>(shop) * 31, y = (in.y - 0.28f) * 9;
  const float goods =
      latticeValue(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed);
  const bool item = y > 1.4f && glm::fract(y) > 0.25f + 0.5f * goods && glm::fract(x) > 0.15f;
  const vec3 warm = (hash >> 12 & 1) ? vec3(1, 0.80f, 0.55f) : vec3(0.88f, 0.94f, 1);
  const vec3 tint = glm::mix(vec3(0.8f), kBrands[static_cast<std::size_t>(goods * 3.99f)], 0.5f);
  return {vec3(0.1f), warm * (item ? 0.35f * tint : vec3(0.95f - 0.4f * in.y))};
}

// The share of texels that shine.
float litShare(const Image& image) {
  const auto bytes = image.as<std::uint8_t>();
  std::size_t lit = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 4)
    lit += bytes[i] != 0 || bytes[i + 1] != 0 || bytes[i + 2] != 0;
  return static_cast<float>(lit) / (static_cast<float>(bytes.size()) / 4);
}

// Surface area (m^2) of each material, in the scene as drawn. Scales are uniform.
std::vector<double> areaByMaterial(const Scene& scene) {
  std::vector<double> meshArea;
  for (const Mesh& mesh : scene.meshes) {
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const vec3 p = mesh.positions[mesh.indices[i]];
      area += 0.5 * glm::length(glm::cross(mesh.positions[mesh.indices[i + 1]] - p,
                                           mesh.positions[mesh.indices[i + 2]] - p));
    }
    meshArea.push_back(area);
  }
  std::vector<double> areas(scene.materials.size(), 0.0);
  for (const Object& object : scene.objects) {
    const double scale = scene.nodes[object.node].scale.x;
    areas[object.material] += scale * scale * meshArea[object.mesh];
  }
  return areas;
}

void addShopTextures(Scene& scene, const Materials& m, std::uint32_t seed) {
  Material& shops = scene.materials[m.shops];
  shops.albedoTexture = slot(addTexture(scene, "shops", paint(1024, 128, [=](vec2 p) {
                                          return vec4(shopPixel(p, seed).albedo, 1);
                                        })));
  shops.emissiveTexture =
      slot(addTexture(scene, "shop lights",
                      paint(1024, 128, [=](vec2 p) { return vec4(shopPixel(p, seed).light, 1); })));
  shops.emissive = kShopRadiance;
}

}  // namespace

void lightWindows(Scene& scene, const Materials& m, std::uint32_t seed) {
  addShopTextures(scene, m, seed);
  const std::vector<double> areas = areaByMaterial(scene);
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  double wanted = kEmitterPoints * total / kLightmapTexels;  // m^2 that shine
  for (const std::uint32_t material : {m.shops, m.neon}) {
    const std::uint32_t texture = scene.materials[material].emissiveTexture.texture;
    wanted -= areas[material] * litShare(*scene.textures[texture].image);
  }
  // What the windows of each style would give if all were lit, m^2.
  std::array<std::vector<double>, kStyles> windows;
  std::array<double, kStyles> full{};
  double weighted = 0;
  for (std::size_t i = 0; i < kStyles; ++i) {
    windows[i] = windowShares(static_cast<Style>(i), seed + static_cast<std::uint32_t>(i));
    for (double& window : windows[i]) full[i] += window *= areas[m.facades[i]];
    weighted += full[i] * facade(static_cast<Style>(i)).weight;
  }
  const double share = std::max(0.0, wanted / std::max(weighted, 1.0));
  double lacking = 0;  // m^2, carried from style to style
  for (std::size_t i = 0; i < kStyles; ++i) {
    const auto style = static_cast<Style>(i);
    const std::uint32_t styleSeed = seed + static_cast<std::uint32_t>(i);
    lacking += full[i] * share * facade(style).weight;
    std::vector<bool> lit(kCells, false);
    for (const int window : lightingOrder(styleSeed)) {
      const double gain = windows[i][static_cast<std::size_t>(window)];
      if (gain > 2 * lacking) break;  // nearer without it
      lit[static_cast<std::size_t>(window)] = true;
      lacking -= gain;
    }
    Material& material = scene.materials[m.facades[i]];
    material.emissive = kWindowRadiance;
    material.emissiveTexture =
        slot(addTexture(scene, material.name + " lights", paintWindows(style, lit, styleSeed)));
  }
}

}  // namespace lucerna::scene::builtin::city

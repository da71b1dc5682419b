// Surfaces of the atrium.
#include "scene/builtin/assembly.hpp"
#include "scene/builtin/atrium.hpp"
#include "scene/builtin/procedural_texture.hpp"

namespace lucerna::scene::builtin {
namespace {

float smooth(float low, float high, float x) {
  return glm::smoothstep(low, high, x);
}

// Distance in tile units from p to the nearest joint of a grid of cells.
float jointDistance(vec2 cell) {
  const vec2 d = 0.5f - glm::abs(glm::fract(cell) - 0.5f);
  return glm::min(d.x, d.y);
}

vec4 marbleColor(vec2 p, std::uint32_t seed) {
  const float warp = fractalNoise(p, 4, 5, seed);
  const float wave = std::sin(2 * kPi * (2 * p.x + p.y) + 9 * warp);
  const float vein = std::pow(1 - std::abs(wave), 5.f);
  const vec3 base = glm::mix(vec3(0.93f, 0.90f, 0.85f), vec3(0.84f, 0.79f, 0.73f), warp);
  return vec4(glm::mix(base, vec3(0.48f, 0.43f, 0.42f), 0.55f * vein), 1);
}

vec4 stoneColor(vec2 p, std::uint32_t seed) {
  const float grain = noise(p, 128, seed + 7), stain = fractalNoise(p, 4, 3, seed);
  return vec4(vec3(0.82f, 0.76f, 0.66f) * (0.8f + 0.2f * stain + 0.08f * (grain - 0.5f)), 1);
}

// Eight courses of four bricks a tile, every other course shifted by half.
struct Brick {
  vec2 cell;
  std::uint32_t x, y;
};
Brick brickAt(vec2 p) {
  const float row = p.y * 8;
  const float shift = static_cast<std::uint32_t>(row) % 2 ? 0.5f : 0.f;
  const float column = p.x * 4 + shift;
  return {vec2(column, row), static_cast<std::uint32_t>(column) % 4,
          static_cast<std::uint32_t>(row)};
}

float brickHeight(vec2 p, std::uint32_t seed) {
  const Brick brick = brickAt(p);
  const vec2 d = 0.5f - glm::abs(glm::fract(brick.cell) - 0.5f);
  const float edge = glm::min(d.x * 2, d.y);
  return 0.012f * smooth(0.03f, 0.12f, edge) + 0.004f * latticeValue(brick.x, brick.y, seed) +
         0.002f * noise(p, 64, seed);
}

vec4 brickColor(vec2 p, std::uint32_t seed) {
  const Brick brick = brickAt(p);
  const vec2 d = 0.5f - glm::abs(glm::fract(brick.cell) - 0.5f);
  const float face = smooth(0.03f, 0.09f, glm::min(d.x * 2, d.y));
  const float tone = latticeValue(brick.x, brick.y, seed), grain = fractalNoise(p, 32, 2, seed + 3);
  const vec3 clay = glm::mix(vec3(0.60f, 0.42f, 0.32f), vec3(0.74f, 0.56f, 0.43f), tone);
  return vec4(glm::mix(vec3(0.62f, 0.58f, 0.52f), clay, face) * (0.82f + 0.3f * grain), 1);
}

// Two by two slabs, light and dark in turn, a diamond inlay where four meet.
vec4 floorColor(vec2 p, std::uint32_t seed) {
  const vec2 cell = p * 2.f;
  const vec2 corner = glm::abs(glm::fract(cell + 0.5f) - 0.5f);
  const bool dark = (static_cast<int>(cell.x) + static_cast<int>(cell.y)) % 2 != 0;
  const float veins = fractalNoise(p, 6, 4, seed);
  vec3 color = dark ? vec3(0.36f, 0.25f, 0.22f) : vec3(0.82f, 0.77f, 0.68f);
  if (corner.x + corner.y < 0.2f) color = vec3(0.22f, 0.27f, 0.27f);
  color *= 0.78f + 0.35f * veins;
  return vec4(color * (0.55f + 0.45f * smooth(0.004f, 0.012f, jointDistance(cell))), 1);
}

float floorHeight(vec2 p, std::uint32_t seed) {
  return 0.004f * smooth(0.f, 0.014f, jointDistance(p * 2.f)) + 0.0012f * noise(p, 24, seed);
}

// Woven cloth with a gold border and a row of lozenges.
vec4 fabricColor(vec2 p, vec3 ground, std::uint32_t seed) {
  const float weave = 0.9f + 0.1f * std::sin(2 * kPi * 64 * p.x) * std::sin(2 * kPi * 128 * p.y);
  const vec2 lozenge = glm::abs(glm::fract(p * vec2(2, 6)) - 0.5f);
  const float border = glm::min(p.x, 1 - p.x);
  const float gold = std::max(smooth(0.06f, 0.07f, border) * (1 - smooth(0.11f, 0.12f, border)),
                              1 - smooth(0.2f, 0.23f, lozenge.x + lozenge.y));
  const vec3 color = glm::mix(ground, vec3(0.85f, 0.66f, 0.30f), gold);
  return vec4(color * weave * (0.85f + 0.25f * noise(p, 16, seed)), 1);
}

// A fan of leaflets on a stem; alpha cuts them out.
vec4 leafColor(vec2 p) {
  const float along = 1 - p.y, across = p.x - 0.5f;
  const float leaflets = std::abs(std::sin(kPi * 9 * (along - 0.35f * std::abs(across))));
  const float width = 0.44f * std::sin(kPi * glm::clamp(along * 0.96f + 0.04f, 0.f, 1.f));
  const bool stem = std::abs(across) < 0.015f;
  const bool leaf = std::abs(across) < width * (0.35f + 0.65f * leaflets) && leaflets > 0.25f;
  const vec3 green = glm::mix(vec3(0.20f, 0.36f, 0.12f), vec3(0.42f, 0.58f, 0.22f), leaflets);
  return vec4(stem ? vec3(0.35f, 0.36f, 0.16f) : green, stem || leaf ? 1.f : 0.f);
}

// Eight-pointed stars cut out of a screen.
vec4 latticeColor(vec2 p) {
  const vec2 q = glm::abs(glm::fract(p * vec2(4, 6)) - 0.5f);
  const float square = std::max(q.x, q.y), diamond = (q.x + q.y) * 0.7071f;
  const bool hole = std::min(square, diamond) < 0.27f || (q.x > 0.4f && q.y > 0.4f);
  return vec4(0.45f, 0.32f, 0.2f, hole ? 0.f : 1.f);
}

// A round window of twelve petals in leaded coloured glass, which shines.
vec4 roseColor(vec2 p, std::uint32_t seed) {
  const vec2 d = 2.f * p - 1.f;
  const float r = glm::length(d), angle = std::atan2(d.y, d.x) / (2 * kPi) + 0.5f;
  const auto petal = static_cast<std::uint32_t>(angle * 12) % 12;
  const auto ring = static_cast<std::uint32_t>(r * 4);
  const float across = std::abs(glm::fract(angle * 12) - 0.5f) * 2;
  const float toRing = std::abs(glm::fract(r * 4) - 0.5f) * 2;
  const bool lead = (r > 0.22f && across > 1 - 0.05f / r) || toRing > 0.9f || r > 0.97f;
  const std::array<vec3, 5> glass{vec3(0.95f, 0.36f, 0.18f), vec3(0.98f, 0.75f, 0.25f),
                                  vec3(0.20f, 0.45f, 0.95f), vec3(0.55f, 0.25f, 0.85f),
                                  vec3(0.15f, 0.75f, 0.65f)};
  const std::uint32_t pick = ring == 0 ? 1 : (petal % 2 + 2 * ring) % 5;
  const float shade = 0.7f + 0.3f * latticeValue(petal, ring, seed) * noise(p, 32, seed);
  return vec4(lead ? vec3(0.02f) : glass[pick] * shade, 1);
}

Material phong(std::string name, vec3 albedo, vec3 specular, float shininess) {
  Material material = matte(std::move(name), albedo, 1.f);
  material.model = MaterialModel::Phong;
  material.specular = specular;
  material.shininess = shininess;
  return material;
}

Material fabric(std::string name, std::uint32_t texture) {
  Material material = phong(std::move(name), vec3(1), vec3(0.04f), 12);
  material.albedoTexture = slot(texture);
  material.doubleSided = true;
  return material;
}

Material cutout(std::string name, std::uint32_t texture) {
  Material material = textured(std::move(name), texture, 0.7f);
  material.alphaMode = AlphaMode::Mask;
  material.doubleSided = true;
  return material;
}

Material shining(std::string name, vec3 emissive) {
  Material material = matte(std::move(name), vec3(0.02f), 0.5f);
  material.emissive = emissive;
  return material;
}

void addPanes(Scene& scene, AtriumMaterials& materials) {
  for (const vec3 tint : {vec3(1, 0.35f, 0.2f), vec3(0.25f, 0.6f, 1), vec3(0.4f, 1, 0.5f)}) {
    Material pane = matte("glass", tint * 0.5f, 0.1f);
    pane.albedo.w = 0.35f;
    pane.alphaMode = AlphaMode::Blend;
    pane.transmission = tint;
    pane.doubleSided = true;
    materials.panes.push_back(addMaterial(scene, pane));
  }
}

}  // namespace

std::vector<vec3> atriumLightColors() {
  return {{1.f, 0.60f, 0.28f}, {0.30f, 0.55f, 1.f},   {1.f, 0.74f, 0.44f},
          {1.f, 0.26f, 0.30f}, {0.22f, 0.85f, 0.72f}, {0.68f, 0.36f, 1.f}};
}

AtriumMaterials addAtriumMaterials(Scene& scene, const AtriumOptions& options) {
  const std::uint32_t seed = options.seed;
  const auto picture = [&](std::string name, int size, const auto& color) {
    return addTexture(scene, std::move(name), paint(size, size, color));
  };
  const auto marble = picture("marble", 512, [=](vec2 p) { return marbleColor(p, seed); });
  const auto stone = picture("stone", 256, [=](vec2 p) { return stoneColor(p, seed + 20); });
  const auto brick = picture("brick", 512, [=](vec2 p) { return brickColor(p, seed + 40); });
  const auto tiles = picture("tiles", 512, [=](vec2 p) { return floorColor(p, seed + 60); });
  const auto red = picture("cloth red", 256, [=](vec2 p) {
    return fabricColor(p, vec3(0.58f, 0.10f, 0.10f), seed + 80);
  });
  const auto blue = picture("cloth blue", 256, [=](vec2 p) {
    return fabricColor(p, vec3(0.10f, 0.20f, 0.48f), seed + 90);
  });
  const auto leaves = picture("leaves", 256, [](vec2 p) { return leafColor(p); });
  const auto lattice = picture("lattice", 256, [](vec2 p) { return latticeColor(p); });
  const auto rose = picture("rose window", 512, [=](vec2 p) { return roseColor(p, seed + 100); });
  const auto brickNormals =
      addTexture(scene, "brick normals",
                 paintNormals(512, 2, [=](vec2 p) { return brickHeight(p, seed + 40); }));
  const auto tileNormals =
      addTexture(scene, "tile normals",
                 paintNormals(512, 2, [=](vec2 p) { return floorHeight(p, seed + 60); }));

  AtriumMaterials m{};
  m.marble = addMaterial(scene, textured("marble", marble, 0.35f));
  m.stone = addMaterial(scene, textured("stone", stone, 0.85f));
  Material wall = textured("brick", brick, 0.9f);
  wall.normalTexture = slot(brickNormals);
  m.brick = addMaterial(scene, wall);
  Material ground = textured("tiles", tiles, 0.3f);
  ground.normalTexture = slot(tileNormals);
  m.floor = addMaterial(scene, ground);
  m.plaster = addMaterial(scene, matte("plaster", vec3(0.55f, 0.49f, 0.42f), 0.95f));
  m.fabricRed = addMaterial(scene, fabric("cloth red", red));
  m.fabricBlue = addMaterial(scene, fabric("cloth blue", blue));
  Material bronze = matte("bronze", vec3(0.80f, 0.52f, 0.28f), 0.38f);
  bronze.metallic = 1;
  m.bronze = addMaterial(scene, bronze);
  m.glazeBlue = addMaterial(scene, phong("glaze blue", vec3(0.07f, 0.16f, 0.42f), vec3(0.5f), 90));
  m.glazeGreen =
      addMaterial(scene, phong("glaze green", vec3(0.08f, 0.32f, 0.22f), vec3(0.5f), 60));
  m.leaves = addMaterial(scene, cutout("leaves", leaves));
  m.lattice = addMaterial(scene, cutout("lattice", lattice));
  m.iron = addMaterial(scene, matte("iron", vec3(0.05f, 0.045f, 0.04f), 0.5f));
  Material window = shining("rose window", vec3(0.9f));
  window.emissiveTexture = slot(rose);
  m.rose = addMaterial(scene, window);
  m.terracotta = addMaterial(scene, matte("terracotta", vec3(0.50f, 0.22f, 0.12f), 0.9f));
  for (const vec3 color : atriumLightColors())
    m.bulbs.push_back(addMaterial(scene, shining("bulb", 3.f * color)));
  if (options.glass) addPanes(scene, m);
  return m;
}

}  // namespace lucerna::scene::builtin

// Materials and pictures of the night city, apart from lit windows and the sky.
#include <string_view>

#include "scene/builtin/assembly.hpp"
#include "scene/builtin/nightcity.hpp"
#include "scene/builtin/procedural_texture.hpp"

namespace lucerna::scene::builtin::city {
namespace {

float line(float x, float at, float halfWidth) {
  return 1 - glm::smoothstep(halfWidth * 0.8f, halfWidth * 1.2f, std::abs(x - at));
}

vec4 grey(float value) {
  return vec4(vec3(value), 1);
}

// Wall, frame and dark glass of one style; the glass itself lies within Facade::low and high.
vec4 facadeColor(vec2 p, Style style, std::uint32_t seed) {
  const Facade& f = facade(style);
  const vec2 cell = p * vec2(kColumns, kRows), in = glm::fract(cell);
  const std::uint32_t x = static_cast<std::uint32_t>(cell.x) % kColumns;
  const std::uint32_t y = static_cast<std::uint32_t>(cell.y) % kRows;
  if (glm::all(glm::greaterThan(in, f.low)) && glm::all(glm::lessThan(in, f.high))) {
    const float sheen = latticeValue(x, y, seed) * 0.08f;
    return vec4(0.10f + sheen, 0.13f + sheen, 0.18f + sheen, 1);
  }
  const bool frame = glm::all(glm::greaterThan(in, f.low - vec2(0.035f, 0.03f))) &&
                     glm::all(glm::lessThan(in, f.high + vec2(0.035f, 0.05f)));
  constexpr std::array<vec3, kStyles> kWall{vec3(0.50f, 0.30f, 0.24f), vec3(0.66f, 0.60f, 0.50f),
                                            vec3(0.70f, 0.62f, 0.50f), vec3(0.48f, 0.49f, 0.50f),
                                            vec3(0.55f, 0.54f, 0.52f), vec3(0.22f, 0.26f, 0.30f)};
  constexpr std::array<vec3, kStyles> kFrame{vec3(0.72f, 0.68f, 0.62f), vec3(0.78f, 0.74f, 0.66f),
                                             vec3(0.42f, 0.34f, 0.28f), vec3(0.24f, 0.25f, 0.27f),
                                             vec3(0.40f, 0.40f, 0.40f), vec3(0.30f, 0.33f, 0.36f)};
  if (frame) return vec4(kFrame[style], 1);
  vec3 color = kWall[style] * (0.84f + 0.3f * fractalNoise(p, 16, 3, seed));
  // A string course below every row of windows.
  color *= 1 - 0.3f * line(in.y, 0.97f, 0.02f);
  if (style == kBrick) {
    const vec2 bricks = cell * vec2(8, 22);
    const float shift = static_cast<int>(bricks.y) % 2 ? 0.5f : 0.f;
    const bool joint = glm::fract(bricks.y) < 0.16f || glm::fract(bricks.x + shift) < 0.06f;
    color *= joint ? 0.8f : 0.94f + 0.12f * noise(p, 128, seed);
  }
  if (style == kClassic) color *= 1 - 0.18f * line(glm::fract(in.y * 5), 0.06f, 0.05f);
  if (style == kConcrete) color *= 1 - 0.3f * line(in.x, 0.02f, 0.02f);
  return vec4(color, 1);
}

vec4 asphalt(vec2 p, std::uint32_t seed) {
  return grey(0.21f + 0.05f * fractalNoise(p, 8, 3, seed) + 0.04f * noise(p, 128, seed + 9));
}

// 20 m across, 12 m along: parking lines, lane dashes, a double line in the middle.
vec4 roadColor(vec2 p, std::uint32_t seed) {
  const float x = std::abs(p.x - 0.5f) * kRoad, z = p.y * 12;
  const float dash = x < 6 && z < 5 ? line(x, 3.8f, 0.08f) : 0.f;
  const float paint = std::max(dash, line(x, 7.5f, 0.08f));
  const vec4 base = glm::mix(asphalt(p, seed), vec4(0.80f, 0.80f, 0.78f, 1), 0.9f * paint);
  return glm::mix(base, vec4(0.82f, 0.66f, 0.25f, 1), 0.9f * line(x, 0.16f, 0.07f));
}

vec4 zebraColor(vec2 p, std::uint32_t seed) {
  const bool bar = glm::fract(p.x * kRoad / 1.f) < 0.5f && p.y > 0.1f && p.y < 0.9f;
  const float worn = 0.75f + 0.25f * noise(p, 32, seed);
  return glm::mix(asphalt(p, seed), vec4(0.80f, 0.80f, 0.78f, 1), bar ? worn : 0.f);
}

vec4 sidewalkColor(vec2 p, std::uint32_t seed) {
  const vec2 cell = p * 4.f, d = 0.5f - glm::abs(glm::fract(cell) - 0.5f);
  const float tone =
      latticeValue(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y), seed);
  const float joint = glm::smoothstep(0.02f, 0.05f, std::min(d.x, d.y));
  return grey((0.44f + 0.09f * tone + 0.05f * noise(p, 64, seed)) * (0.7f + 0.3f * joint));
}

vec4 grassColor(vec2 p, std::uint32_t seed) {
  const float n = fractalNoise(p, 8, 4, seed);
  return vec4(glm::mix(vec3(0.20f, 0.26f, 0.15f), vec3(0.40f, 0.42f, 0.28f), n), 1);
}

// The inside of a block from above, kYard across: lawn with a lane around it, footpaths that cross
// at a round place, car parks and shrubs.
vec4 yardColor(vec2 p, std::uint32_t seed) {
  const float lawn = 0.5f * fractalNoise(p, 9, 3, seed) + 0.5f * fractalNoise(p, 64, 4, seed + 1);
  vec3 color = glm::mix(vec3(0.20f, 0.26f, 0.15f), vec3(0.40f, 0.42f, 0.28f), lawn);
  const float shrubs = fractalNoise(p, 24, 2, seed + 2);
  color *= 1 - 0.35f * glm::smoothstep(0.60f, 0.72f, shrubs);
  const vec2 at = (p - 0.5f) * kYard;  // m
  const float grain = noise(p, 256, seed + 3), sway = 9 * (noise(p, 3, seed + 4) - 0.5f);
  const float path = std::min(std::abs(at.x + at.y + sway), std::abs(at.x - at.y - sway)) * 0.7f;
  const float place = glm::length(at);
  const vec3 gravel = vec3(0.50f, 0.46f, 0.39f) * (0.85f + 0.25f * grain);
  color = glm::mix(color, gravel,
                   1 - glm::smoothstep(1.2f, 1.7f, std::min(path, std::abs(place - 13.f))));
  const float ring = std::max(std::abs(at.x), std::abs(at.y));  // m from the middle
  const vec2 along(at.x * at.x > at.y * at.y ? at.y : at.x, ring);
  const bool park = std::abs(along.x) > 24 && std::abs(along.x) < 58 && ring > 76 && ring < 82;
  if (park || (ring > 82 && ring < 86)) {
    color = vec3(0.22f + 0.05f * grain);
    if (park) color = glm::mix(color, vec3(0.6f), line(glm::fract(along.x / 2.5f), 0.5f, 0.03f));
  }
  return vec4(color, 1);
}

vec4 concreteColor(vec2 p, std::uint32_t seed) {
  const float joint = std::max(line(p.x, 0.01f, 0.008f), line(p.y, 0.01f, 0.008f));
  return grey((0.46f + 0.16f * fractalNoise(p, 4, 4, seed)) * (1 - 0.3f * joint));
}

vec4 tunnelColor(vec2 p, std::uint32_t seed) {
  const vec2 d = 0.5f - glm::abs(glm::fract(p * 8.f) - 0.5f);
  const float tile = glm::smoothstep(0.02f, 0.06f, std::min(d.x, d.y));
  return grey((0.62f + 0.08f * fractalNoise(p, 4, 3, seed)) * (0.75f + 0.25f * tile));
}

// A crown of noise on a trunk; alpha cuts it out.
vec4 treeColor(vec2 p, std::uint32_t seed) {
  const vec2 d = (p - vec2(0.5f, 0.38f)) / vec2(0.46f, 0.36f);
  const float lumps = fractalNoise(p, 6, 4, seed);
  const bool crown = glm::dot(d, d) < 0.45f + 0.75f * lumps && lumps > 0.34f;
  const float fromTrunk = p.y > 0.4f ? std::abs(p.x - 0.5f) : 1.f;
  const vec3 green = glm::mix(vec3(0.17f, 0.26f, 0.10f), vec3(0.40f, 0.47f, 0.19f), lumps);
  // What is cut out has the colour of what is beside it, which filtering mixes in.
  const bool bark = !crown && fromTrunk < 0.05f;
  return vec4(bark ? vec3(0.25f, 0.19f, 0.14f) : green, crown || fromTrunk < 0.022f ? 1.f : 0.f);
}

// A 5 x 7 letter; bit 4 of a row is its left column.
std::array<std::uint8_t, 7> glyph(char letter) {
  switch (letter) {
    case 'A':
      return {14, 17, 17, 31, 17, 17, 17};
    case 'B':
      return {30, 17, 17, 30, 17, 17, 30};
    case 'C':
      return {15, 16, 16, 16, 16, 16, 15};
    case 'E':
      return {31, 16, 16, 30, 16, 16, 31};
    case 'H':
      return {17, 17, 17, 31, 17, 17, 17};
    case 'I':
      return {14, 4, 4, 4, 4, 4, 14};
    case 'J':
      return {7, 2, 2, 2, 2, 18, 12};
    case 'L':
      return {16, 16, 16, 16, 16, 16, 31};
    case 'M':
      return {17, 27, 21, 21, 17, 17, 17};
    case 'N':
      return {17, 25, 21, 19, 17, 17, 17};
    case 'O':
      return {14, 17, 17, 17, 17, 17, 14};
    case 'R':
      return {30, 17, 17, 30, 20, 18, 17};
    case 'T':
      return {31, 4, 4, 4, 4, 4, 4};
    case 'Z':
      return {31, 1, 2, 4, 8, 16, 31};
    default:
      return {};
  }
}

// Four signs side by side, each a word from top to bottom in a lit frame.
vec4 neonColor(vec2 p) {
  constexpr std::array<std::string_view, 4> kWords{"HOTEL", "JAZZ", "CINEMA", "BAR"};
  constexpr std::array<vec3, 4> kColors{vec3(1, 0.25f, 0.30f), vec3(0.30f, 0.75f, 1),
                                        vec3(1, 0.75f, 0.25f), vec3(0.85f, 0.35f, 1)};
  const auto sign = std::min(static_cast<std::size_t>(p.x * 4), std::size_t{3});
  const std::string_view word = kWords[sign];
  const vec2 in(glm::fract(p.x * 4), p.y);
  const vec2 edge(std::min(in.x, 1 - in.x), std::min(in.y, 1 - in.y) * 4);
  const float border = std::min(edge.x, edge.y);
  if (border > 0.05f && border < 0.1f) return vec4(kColors[sign], 1);
  const float row = (in.y - 0.06f) / 0.88f * static_cast<float>(word.size());
  if (row < 0 || row >= static_cast<float>(word.size())) return grey(0);
  const vec2 at((in.x - 0.2f) / 0.6f * 5, (glm::fract(row) - 0.1f) / 0.8f * 7);
  if (at.x < 0 || at.x >= 5 || at.y < 0 || at.y >= 7) return grey(0);
  const auto bits = glyph(word[static_cast<std::size_t>(row)]);
  const bool on = bits[static_cast<std::size_t>(at.y)] >> (4 - static_cast<int>(at.x)) & 1;
  return on ? vec4(glm::mix(kColors[sign], vec3(1), 0.35f), 1) : grey(0);
}

Material glowing(std::string name, vec3 radiance) {
  Material material = matte(std::move(name), vec3(0.02f), 0.5f);
  material.emissive = radiance;
  return material;
}

}  // namespace

const Facade& facade(Style style) {
  static const std::array<Facade, kStyles> all{
      {{3.0f, 3.3f, {0.28f, 0.22f}, {0.72f, 0.74f}, 0.9f},
       {3.4f, 3.8f, {0.30f, 0.16f}, {0.70f, 0.76f}, 1.8f},
       {3.6f, 3.0f, {0.25f, 0.25f}, {0.75f, 0.72f}, 0.6f},
       {3.0f, 3.5f, {0.07f, 0.22f}, {0.93f, 0.80f}, 1.8f},
       {3.2f, 2.9f, {0.20f, 0.22f}, {0.80f, 0.72f}, 0.5f},
       {2.4f, 3.6f, {0.06f, 0.10f}, {0.94f, 0.90f}, 1.6f}}};
  return all[style];
}

Materials addMaterials(Scene& scene) {
  const auto add = [&](Material material) { return addMaterial(scene, std::move(material)); };
  Materials m{};
  constexpr std::array<const char*, kStyles> kNames{"brick",  "classic",  "plaster",
                                                    "office", "concrete", "glass"};
  for (std::size_t i = 0; i < kStyles; ++i)
    m.facades[i] =
        add(matte(std::string("facade ") + kNames[i], vec3(1), i == kGlass ? 0.3f : 0.8f));
  m.shops = add(matte("shops", vec3(1), 0.5f));
  m.roof = add(matte("roof", vec3(0.16f, 0.155f, 0.15f), 0.9f));
  m.tiles = add(matte("roof tiles", vec3(0.20f, 0.09f, 0.06f), 0.8f));
  m.sidewalk = add(matte("sidewalk", vec3(1), 0.8f));
  m.yard = add(matte("yard", vec3(1), 0.9f));
  m.road = add(matte("road", vec3(1), 0.4f));
  m.zebra = add(matte("zebra", vec3(1), 0.45f));
  m.crossing = add(matte("crossing", vec3(1), 0.4f));
  m.concrete = add(matte("concrete", vec3(1), 0.85f));
  m.deck = add(matte("deck", vec3(1), 0.6f));
  m.tunnelWall = add(matte("tunnel wall", vec3(1), 0.35f));
  m.tunnelCeiling = add(matte("tunnel ceiling", vec3(0.35f), 0.9f));
  m.grass = add(matte("grass", vec3(1), 0.95f));
  Material tree = matte("tree", vec3(1), 0.9f);
  tree.alphaMode = AlphaMode::Mask;
  tree.doubleSided = true;
  m.tree = add(tree);
  m.metal = add(matte("metal", vec3(0.09f, 0.10f, 0.10f), 0.5f));
  m.dark = add(matte("glass and tyres", vec3(0.012f), 0.25f));
  Material neon = glowing("neon", vec3(0.45f));
  m.neon = add(neon);
  m.tail = add(glowing("tail light", vec3(0.5f, 0.012f, 0.008f)));
  m.beam = add(glowing("head light", vec3(0.9f, 0.85f, 0.7f)));
  constexpr std::array<vec3, 4> kPaints{vec3(0.30f, 0.03f, 0.03f), vec3(0.04f, 0.08f, 0.20f),
                                        vec3(0.32f, 0.32f, 0.33f), vec3(0.03f, 0.03f, 0.035f)};
  for (std::size_t i = 0; i < 4; ++i) {
    Material paint = matte("car paint", kPaints[i], 0.3f);
    paint.model = MaterialModel::Phong;
    paint.specular = vec3(0.25f);
    paint.shininess = 60;
    m.paints[i] = add(paint);
  }
  for (const Tint tint : {kWarm, kSodium, kCold})
    m.glows[tint] = add(glowing("lamp glass", 1.2f * tintColor(tint)));
  return m;
}

void addTextures(Scene& scene, const Materials& m, std::uint32_t seed) {
  const auto give = [&](std::uint32_t material, int width, int height, const auto& color) {
    Material& target = scene.materials[material];
    target.albedoTexture = slot(addTexture(scene, target.name, paint(width, height, color)));
  };
  for (std::size_t i = 0; i < kStyles; ++i) {
    const auto style = static_cast<Style>(i);
    give(m.facades[i], 512, 1024,
         [=](vec2 p) { return facadeColor(p, style, seed + static_cast<std::uint32_t>(i)); });
  }
  give(m.road, 512, 256, [=](vec2 p) { return roadColor(p, seed + 20); });
  scene.materials[m.deck].albedoTexture = scene.materials[m.road].albedoTexture;
  give(m.zebra, 512, 128, [=](vec2 p) { return zebraColor(p, seed + 20); });
  give(m.crossing, 256, 256, [=](vec2 p) { return asphalt(p, seed + 20); });
  give(m.sidewalk, 256, 256, [=](vec2 p) { return sidewalkColor(p, seed + 30); });
  give(m.yard, 1024, 1024, [=](vec2 p) { return yardColor(p, seed + 45); });
  give(m.grass, 256, 256, [=](vec2 p) { return grassColor(p, seed + 40); });
  give(m.concrete, 256, 256, [=](vec2 p) { return concreteColor(p, seed + 50); });
  scene.materials[m.tunnelCeiling].albedoTexture = scene.materials[m.concrete].albedoTexture;
  give(m.tunnelWall, 256, 256, [=](vec2 p) { return tunnelColor(p, seed + 60); });
  give(m.tree, 256, 256, [=](vec2 p) { return treeColor(p, seed + 70); });
  scene.materials[m.neon].emissiveTexture =
      slot(addTexture(scene, "neon", paint(512, 512, [](vec2 p) { return neonColor(p); })));
}

}  // namespace lucerna::scene::builtin::city

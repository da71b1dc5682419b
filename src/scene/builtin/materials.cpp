#include "scene/builtin/materials.hpp"

#include <cmath>

#include "scene/builtin/assembly.hpp"
#include "scene/builtin/procedural_texture.hpp"

namespace lucerna::scene::builtin {
namespace {

constexpr float kSide = 1.f;       // of the cubes, m
constexpr float kSpacing = 1.75f;  // between their centres, m
constexpr float kPlinth = 0.12f;   // height, m
constexpr float kGap = 0.004f;     // under the cubes: translucent undersides show, m
constexpr float kTile = 0.7f;      // of the floor, m
constexpr float kEyeHeight = kPlinth + 0.5f * kSide;  // of the surroundings' picture
constexpr int kSurroundingsSize = 512;                // pixels of a face
const vec3 kToSun = glm::normalize(vec3(-0.45f, 0.75f, 0.6f));

float smooth(float low, float high, float x) {
  return glm::smoothstep(low, high, x);
}

// Colours below are stored ones (sRGB).

// Which of the floor's two stones a place has, and how far it is from a joint, in tiles.
struct Tile {
  bool dark;
  float toJoint;
};
Tile tileAt(vec2 p) {
  const vec2 cell = glm::floor(p), edge = 0.5f - glm::abs(glm::fract(p) - 0.5f);
  const bool dark = static_cast<int>(std::abs(cell.x) + std::abs(cell.y)) % 2 != 0;
  return {dark, std::min(edge.x, edge.y)};
}

vec3 stoneColor(const Tile& tile) {
  const vec3 stone = tile.dark ? vec3(0.47f, 0.46f, 0.46f) : vec3(0.70f, 0.67f, 0.62f);
  return stone * (0.6f + 0.4f * smooth(0.006f, 0.018f, tile.toJoint));
}

// Two by two tiles; p in [0, 1).
vec4 floorColor(vec2 p) {
  const float veins = fractalNoise(p, 8, 4, 7), grain = noise(p, 128, 3);
  return vec4(stoneColor(tileAt(2.f * p)) * (0.86f + 0.22f * veins + 0.06f * grain), 1);
}

vec3 skyColor(vec3 d) {
  const float height = std::sqrt(std::max(d.y, 0.f));
  vec3 color = glm::mix(vec3(0.78f, 0.82f, 0.85f), vec3(0.27f, 0.47f, 0.74f), height);
  // Fair-weather clouds on a plane, thinning out towards the horizon.
  const vec2 plane = vec2(d.x, d.z) / (d.y + 0.12f) * 0.045f + 0.5f;
  const float cloud = smooth(0.47f, 0.72f, fractalNoise(glm::fract(plane), 6, 5, 21));
  color = glm::mix(color, vec3(0.97f, 0.96f, 0.94f), 0.85f * cloud * smooth(0.02f, 0.25f, d.y));
  const float sun = std::max(glm::dot(d, kToSun), 0.f);
  return color + vec3(1.f, 0.93f, 0.78f) * (0.35f * std::pow(sun, 40.f) + std::pow(sun, 1500.f));
}

// How high a chain of hills stands in a direction, 1 straight up; softly cut out of the sky.
float hills(vec3 d, float height, std::uint32_t seed) {
  constexpr float kSoft = 0.004f;
  if (d.y > height + kSoft) return 0;  // above the highest ridge
  const float around = std::atan2(d.x, d.z) / (2 * kPi) + 0.5f;
  const float ridge = height * fractalNoise(vec2(std::min(around, 0.9999f), 0.3f), 12, 5, seed);
  return 1 - smooth(-kSoft, kSoft, d.y - ridge);
}

// What is around the cubes: sky, two chains of hills in the haze, and the floor that runs out to
// them.
vec3 surroundings(vec3 d) {
  const vec3 haze(0.60f, 0.62f, 0.63f);
  if (d.y > 0) {
    vec3 color = glm::mix(skyColor(d), vec3(0.55f, 0.62f, 0.68f), hills(d, 0.10f, 5));
    color = glm::mix(color, vec3(0.42f, 0.50f, 0.46f), hills(d, 0.055f, 6));
    return glm::mix(haze, color, smooth(0.f, 0.02f, d.y));
  }
  const vec2 place = vec2(d.x, d.z) * (kEyeHeight / -d.y);
  const float hazy = smooth(2.f, 9.f, glm::length(place));
  return hazy < 1 ? glm::mix(stoneColor(tileAt(place / kTile)), haze, hazy) : haze;
}

// The mean over two texels each way: magnified, the tiles' edges show no steps.
vec3 smoothSurroundings(int face, vec2 p) {
  vec3 sum(0.f);
  constexpr float kStep = 0.667f / kSurroundingsSize;
  for (const float y : {-kStep, 0.f, kStep})
    for (const float x : {-kStep, 0.f, kStep})
      sum += surroundings(faceDirection(face, p + vec2(x, y)));
  return sum / 9.f;
}

// A gilded lattice of interlaced circles; between them panes of turquoise glass.
vec4 latticeColor(vec2 p) {
  const vec2 q = glm::fract(3.f * p) - 0.5f;
  float line = 1.f;  // distance to the nearest ring
  for (const vec2 center :
       {vec2(0.f), vec2(0.5f), vec2(-0.5f), vec2(0.5f, -0.5f), vec2(-0.5f, 0.5f)})
    line = std::min(line, std::abs(glm::length(q - center) - 0.42f));
  const vec2 border = 0.5f - glm::abs(p - 0.5f);
  line = std::min(line, std::min(border.x, border.y) * 3.f - 0.08f);
  const float metal = 1 - smooth(0.045f, 0.065f, line);
  const vec3 gold = vec3(0.92f, 0.72f, 0.34f) * (0.75f + 0.25f * smooth(0.05f, 0.f, line));
  return vec4(glm::mix(vec3(0.20f, 0.66f, 0.68f), gold, metal), glm::mix(0.22f, 1.f, metal));
}

// Overlapping waves: rows of discs of rings, each row shifted and over the one behind it.
vec4 wavesColor(vec2 p) {
  const float rows = 8, columns = 4, radius = 0.5f;  // of a disc, in columns
  for (int back = 0; back < 3; ++back) {
    const float row = std::floor(p.y * rows) + 1 - static_cast<float>(back) + 1;
    const float shift = std::fmod(row + 16, 2.f) < 0.5f ? 0.f : 0.5f;
    const float x = glm::fract(p.x * columns + shift) - 0.5f;
    const float y = (p.y * rows - row) * columns / rows;
    const float r = glm::length(vec2(x, y)) / radius;
    if (r > 1 || y > 0) continue;
    const float ring = std::abs(glm::fract(r * 3.5f + 0.25f) - 0.5f) * 2;
    const float ink = smooth(0.35f, 0.55f, ring);
    const vec3 blue = glm::mix(vec3(0.13f, 0.26f, 0.50f), vec3(0.22f, 0.46f, 0.66f), r);
    return vec4(glm::mix(vec3(0.95f, 0.92f, 0.84f), blue, ink), 1);
  }
  return vec4(0.13f, 0.26f, 0.50f, 1);
}

Material phong(std::string name, vec3 albedo, vec3 specular, float shininess) {
  Material material = matte(std::move(name), albedo, 1.f);
  material.model = MaterialModel::Phong;
  material.specular = specular;
  material.shininess = shininess;
  return material;
}

Material latticeMaterial(Scene& scene) {
  Material material = phong("lattice", vec3(1), vec3(0.35f), 60);
  material.albedoTexture = slot(addTexture(scene, "lattice", paint(512, 512, latticeColor)));
  material.alphaMode = AlphaMode::Blend;
  material.transmission = vec3(0.75f, 0.97f, 0.97f);
  material.doubleSided = true;
  return material;
}

// A reflection that lamps do not dim: emission, as materials-and-light.md says.
Material chromeMaterial(std::uint32_t surroundingsTexture) {
  Material material = phong("chrome", vec3(0.01f), vec3(0.5f), 220);
  material.emissive = vec3(0.80f, 0.82f, 0.84f);
  material.emissiveTexture = slot(surroundingsTexture);
  material.emissiveTexture.coordinates = Coordinates::Reflection;
  return material;
}

Material glassMaterial(std::uint32_t surroundingsTexture) {
  Material material = phong("glass", vec3(0.30f, 0.85f, 0.45f), vec3(0.6f), 120);
  material.albedo.w = 0.28f;
  material.alphaMode = AlphaMode::Blend;
  material.transmission = vec3(0.62f, 0.95f, 0.72f);
  material.emissive = vec3(0.45f);  // a faint reflection
  material.emissiveTexture = slot(surroundingsTexture);
  material.emissiveTexture.coordinates = Coordinates::Reflection;
  return material;
}

Material wavesMaterial(Scene& scene) {
  Material material = phong("waves", vec3(1), vec3(0.08f), 30);
  material.albedoTexture = slot(addTexture(scene, "waves", paint(512, 512, wavesColor)));
  material.albedoTexture.coordinates = Coordinates::EyeLinear;
  material.albedoTexture.planeS = vec4(1.1f, 0, 0, 0);
  material.albedoTexture.planeT = vec4(0, 1.1f, 0, 0);
  return material;
}

Material lavaMaterial(Scene& scene) {
  const auto grain = [](vec2 p) { return vec4(vec3(fractalNoise(p, 6, 5, 9)), 1); };
  Material material = matte("lava", vec3(0.1f), 0.8f);
  material.shader.file = "render/custom/lava.frag";
  material.shader.textures = {{.name = "grain",
                               .texture = addTexture(scene, "grain", paint(256, 256, grain)),
                               .data = true}};
  return material;
}

// Its six sides are objects of their own, so that the far ones are blended first.
void addPanes(Scene& scene, std::uint32_t parent, std::uint32_t material) {
  MeshBuilder builder;
  const float h = 0.5f * kSide;
  builder.quad({vec3(-h, -h, 0), vec3(h, -h, 0), vec3(h, h, 0), vec3(-h, h, 0)}, kSide);
  const std::uint32_t pane = addMesh(scene, builder.take("pane"));
  for (int side = 0; side < 6; ++side) {
    Node node;
    node.name = fmt::format("side {}", side + 1);
    node.parent = parent;
    const float angle = 0.5f * kPi * static_cast<float>(side);
    node.rotation = side < 4 ? glm::angleAxis(angle, vec3(0, 1, 0))
                             : glm::angleAxis(side == 4 ? -0.5f * kPi : 0.5f * kPi, vec3(1, 0, 0));
    node.translation = node.rotation * vec3(0, 0, h);
    Object object;
    object.node = addNode(scene, std::move(node));
    object.mesh = pane;
    object.material = material;
    scene.objects.push_back(object);
  }
}

// The far sides, seen from inside, and then the near ones: equally deep objects are blended in the
// scene's order.
void addGlass(Scene& scene, std::uint32_t parent, std::uint32_t mesh, std::uint32_t material) {
  Mesh inside = scene.meshes[mesh];
  inside.name += ", inside";
  for (vec3& normal : inside.normals) normal = -normal;
  for (std::size_t i = 0; i < inside.indices.size(); i += 3)
    std::swap(inside.indices[i + 1], inside.indices[i + 2]);
  addObject(scene, parent, addMesh(scene, std::move(inside)), material);
  addObject(scene, parent, mesh, material);
}

std::uint32_t addRoundedCube(Scene& scene) {
  MeshBuilder builder;
  builder.roundedBox(vec3(-0.5f * kSide), vec3(0.5f * kSide), 0.05f, 4);
  return addMesh(scene, builder.take("rounded cube"));
}

std::uint32_t addPlinth(Scene& scene) {
  MeshBuilder builder;
  const std::array<vec2, 5> profile = {vec2(0.76f, 0), vec2(0.76f, kPlinth - 0.025f),
                                       vec2(0.75f, kPlinth - 0.008f), vec2(0.73f, kPlinth),
                                       vec2(0, kPlinth)};
  builder.lathe(profile, {.segments = 72});
  return addMesh(scene, builder.take("plinth"));
}

void addFloor(Scene& scene, std::uint32_t root) {
  constexpr float kHalf = 160 * kTile;
  MeshBuilder builder;
  builder.quad({vec3(-kHalf, 0, kHalf), vec3(kHalf, 0, kHalf), vec3(kHalf, 0, -kHalf),
                vec3(-kHalf, 0, -kHalf)},
               2 * kTile);
  const auto picture = paint(512, 512, floorColor);
  Material stone = phong("floor", vec3(1), vec3(0.10f), 40);
  stone.albedoTexture = slot(addTexture(scene, "slabs", picture));
  addMeshObject(scene, root, builder, "floor", addMaterial(scene, stone));
}

void addLights(Scene& scene, std::uint32_t root) {
  Light sun;
  sun.name = "sun";
  sun.kind = LightKind::Directional;
  sun.color = {1.f, 0.94f, 0.84f};
  sun.intensity = 2.7f;
  sun.angle = glm::radians(0.53f);
  Light sky;  // the other side is not black
  sky.name = "sky";
  sky.kind = LightKind::Directional;
  sky.color = {0.62f, 0.78f, 1.f};
  sky.intensity = 0.55f;
  for (Light* light : {&sun, &sky}) {
    Node node;
    node.name = light->name;
    node.parent = root;
    node.rotation = lookAlong(light == &sun ? -kToSun : vec3(-0.8f, -0.5f, -0.3f));
    light->node = addNode(scene, std::move(node));
    scene.lights.push_back(*light);
  }
  scene.ambient = vec3(0.17f, 0.19f, 0.22f);
}

}  // namespace

Scene makeMaterials() {
  Scene scene;
  Node rootNode;
  rootNode.name = "materials";
  const std::uint32_t root = addNode(scene, std::move(rootNode));
  std::vector<std::shared_ptr<const Image>> faces;
  for (int face = 0; face < 6; ++face)
    faces.push_back(paint(kSurroundingsSize, kSurroundingsSize,
                          [=](vec2 p) { return vec4(smoothSurroundings(face, p), 1); }));
  scene.background.kind = BackgroundKind::CubeMap;
  scene.background.texture = addCubeMap(scene, "surroundings", std::move(faces));

  addFloor(scene, root);
  const std::uint32_t plinth = addPlinth(scene), roundedCube = addRoundedCube(scene);
  const std::uint32_t basalt =
      addMaterial(scene, phong("plinth", vec3(0.13f, 0.125f, 0.12f), vec3(0.2f), 60));
  const std::array<std::uint32_t, 5> materials = {
      addMaterial(scene, latticeMaterial(scene)),
      addMaterial(scene, chromeMaterial(scene.background.texture)),
      addMaterial(scene, glassMaterial(scene.background.texture)),
      addMaterial(scene, wavesMaterial(scene)), addMaterial(scene, lavaMaterial(scene))};
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const vec3 place(kSpacing * (static_cast<float>(i) - 2), 0, 0);
    addObject(scene, root, plinth, basalt, place);
    const Material& material = scene.materials[materials[i]];
    Node cube;
    cube.name = material.name;
    cube.parent = root;
    cube.translation = place + vec3(0, kPlinth + kGap + 0.5f * kSide, 0);
    cube.rotation = glm::angleAxis(glm::radians(28.f + 6 * static_cast<float>(i)), vec3(0, 1, 0));
    const bool panes = material.doubleSided;
    const bool glass = !panes && material.alphaMode == AlphaMode::Blend;
    const std::uint32_t node = addNode(scene, std::move(cube));
    if (panes)
      addPanes(scene, node, materials[i]);
    else if (glass)
      addGlass(scene, node, roundedCube, materials[i]);
    else
      addObject(scene, node, roundedCube, materials[i]);
  }
  addLights(scene, root);
  addCamera(scene, root, "main", {0, 2.45f, 9.0f}, {0, 0.45f, 0}, 30.5f);
  addCamera(scene, root, "left", {-2.9f, 1.7f, 4.2f}, {-1.75f, 0.6f, 0}, 38);
  addCamera(scene, root, "right", {2.9f, 1.7f, 4.2f}, {2.1f, 0.6f, 0}, 38);
  return scene;
}

}  // namespace lucerna::scene::builtin

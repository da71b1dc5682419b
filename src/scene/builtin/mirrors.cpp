#include "scene/builtin/mirrors.hpp"

#include <cmath>

#include "scene/builtin/assembly.hpp"
#include "scene/builtin/procedural_texture.hpp"

namespace lucerna::scene::builtin {
namespace {

constexpr float kHalfX = 4.f, kHalfZ = 3.f, kHeight = 3.2f;

// A rectangle on a wall, in the wall's own metres: x to the right, y up.
struct Opening {
  vec2 low, high;
};
constexpr float kMainLeft = -1.7f, kMainRight = 1.7f, kMainLow = 0.75f, kMainHigh = 2.65f;
constexpr float kPoolLeft = -1.f, kPoolRight = 1.f, kPoolBack = -1.1f, kPoolFront = 0.3f;

// What the steps below share.
struct Plan {
  Scene& scene;
  std::uint32_t root;
  const MirrorsOptions& options;
  std::uint32_t frame = kNone;

  std::uint32_t put(MeshBuilder& builder, const std::string& name, std::uint32_t material,
                    vec3 at = vec3(0), float angleY = 0.f) {
    return addObject(scene, root, addMesh(scene, builder.take(name)), material, at, angleY);
  }
  std::uint32_t add(Material material) { return addMaterial(scene, std::move(material)); }
};

Material glossy(std::string name, vec3 albedo, float specular, float shininess) {
  Material material = matte(std::move(name), albedo, 1.f);
  material.model = MaterialModel::Phong;
  material.specular = vec3(specular);
  material.shininess = shininess;
  return material;
}

// Silvered glass: where nothing reflects in it yet, a plain grey sheet.
std::uint32_t addMirrorMaterial(Plan& plan, const std::string& name, float reflectivity,
                                bool main) {
  Material material = glossy(name, vec3(0.50f, 0.53f, 0.55f), 0.4f, 160);
  material.reflectivity = !main && (plan.options.single || plan.options.twin) ? 0.f : reflectivity;
  return plan.add(std::move(material));
}

// A wall in its own space, z = 0 and facing +z, from -half to half in x, with an opening.
void addWall(Plan& plan, const std::string& name, std::uint32_t material, float half,
             const Opening* hole, vec3 at, float angleY) {
  MeshBuilder builder;
  const auto piece = [&](vec2 low, vec2 high) {
    if (high.x - low.x < 1e-3f || high.y - low.y < 1e-3f) return;
    const vec2 tile(1 / 1.6f);
    builder.quad({vec3(low, 0), vec3(high.x, low.y, 0), vec3(high, 0), vec3(low.x, high.y, 0)},
                 {vec2(low.x, -low.y) * tile, vec2(high.x, -low.y) * tile,
                  vec2(high.x, -high.y) * tile, vec2(low.x, -high.y) * tile});
  };
  if (!hole) {
    piece({-half, 0}, {half, kHeight});
  } else {
    piece({-half, 0}, {half, hole->low.y});
    piece({-half, hole->high.y}, {half, kHeight});
    piece({-half, hole->low.y}, {hole->low.x, hole->high.y});
    piece({hole->high.x, hole->low.y}, {half, hole->high.y});
  }
  plan.put(builder, name, material, at, angleY);
}

// Four bars around an opening, before the wall.
void addFrame(Plan& plan, const Opening& hole, vec3 at, float angleY) {
  constexpr float kWidth = 0.09f, kDepth = 0.05f;
  MeshBuilder builder;
  const vec2 low = hole.low - kWidth, high = hole.high + kWidth;
  builder.box(vec3(low, 0), vec3(high.x, hole.low.y, kDepth));
  builder.box(vec3(low.x, hole.high.y, 0), vec3(high, kDepth));
  builder.box(vec3(low.x, hole.low.y, 0), vec3(hole.low.x, hole.high.y, kDepth));
  builder.box(vec3(hole.high.x, hole.low.y, 0), vec3(high.x, hole.high.y, kDepth));
  plan.put(builder, "frame", plan.frame, at, angleY);
}

void addMirror(Plan& plan, const std::string& name, float reflectivity, const Opening& hole,
               vec3 at, float angleY) {
  MeshBuilder builder;
  builder.quad({vec3(hole.low, 0), vec3(hole.high.x, hole.low.y, 0), vec3(hole.high, 0),
                vec3(hole.low.x, hole.high.y, 0)});
  plan.put(builder, name, addMirrorMaterial(plan, name, reflectivity, name == "main mirror"), at,
           angleY);
}

vec4 plasterColor(vec2 p) {
  const vec2 q = glm::abs(glm::fract(4.f * p) - 0.5f);
  const float ornament = glm::smoothstep(0.03f, 0.06f, std::abs(q.x + q.y - 0.32f));
  const vec3 ground = glm::mix(vec3(0.45f, 0.34f, 0.30f), vec3(0.56f, 0.47f, 0.43f), ornament);
  return vec4(ground * (0.92f + 0.12f * fractalNoise(p, 8, 3, 31)), 1);
}

// Herringbone parquet.
vec4 parquetColor(vec2 p) {
  const vec2 q = p * 8.f;
  const int strip = static_cast<int>(std::floor(q.x)) + static_cast<int>(std::floor(q.y));
  const bool upright = (strip / 2) % 2 == 0;
  const vec2 board = upright ? vec2(q.x, q.y * 0.5f) : vec2(q.y, q.x * 0.5f);
  const vec2 edge = 0.5f - glm::abs(glm::fract(board) - 0.5f);
  const float joint = glm::smoothstep(0.f, 0.05f, std::min(edge.x, 2 * edge.y));
  const auto x = static_cast<std::uint32_t>(board.x), y = static_cast<std::uint32_t>(board.y);
  const float tone = latticeValue(x + (upright ? 64u : 0u), y, 77);
  const float fibre = noise(upright ? vec2(p.x, p.y * 0.25f) : vec2(p.y, p.x * 0.25f), 96, 5);
  const vec3 wood = glm::mix(vec3(0.58f, 0.40f, 0.25f), vec3(0.72f, 0.53f, 0.34f), tone);
  return vec4(wood * (0.85f + 0.2f * fibre) * (0.6f + 0.4f * joint), 1);
}

// A clock at twenty-five to five: a mirror shows it as twenty-five past seven.
vec4 clockColor(vec2 p) {
  const vec2 d(2 * p.x - 1, 1 - 2 * p.y);
  const float r = glm::length(d), angle = std::atan2(d.x, d.y);
  const auto hand = [&](float turns, float length, float width) {
    const vec2 along(std::sin(2 * kPi * turns), std::cos(2 * kPi * turns));
    const float t = glm::clamp(glm::dot(d, along), -0.1f, length);
    return glm::length(d - t * along) < width;
  };
  const float hour = angle / (2 * kPi) * 12, off = std::abs(hour - std::round(hour));
  const bool tick = r > 0.74f && r < 0.88f && off * r < 0.055f;
  const bool ink = tick || hand(35.f / 60, 0.68f, 0.03f) ||
                   hand((4 + 35.f / 60) / 12, 0.45f, 0.045f) || r < 0.06f;
  const vec3 face = r > 0.93f ? vec3(0.75f, 0.55f, 0.25f) : vec3(0.95f, 0.93f, 0.88f);
  return vec4(ink ? vec3(0.08f, 0.08f, 0.10f) : face, 1);
}

void addShell(Plan& plan) {
  Scene& scene = plan.scene;
  const auto picture = [&](const char* name, const auto& color) {
    return slot(addTexture(scene, name, paint(512, 512, color)));
  };
  Material paper = glossy("wallpaper", vec3(1), 0.03f, 10);
  paper.albedoTexture = picture("wallpaper", plasterColor);
  const std::uint32_t wall = plan.add(paper);
  Material wood = glossy("parquet", vec3(1), 0.12f, 50);
  wood.albedoTexture = picture("parquet", parquetColor);
  const std::uint32_t floor = plan.add(wood);
  const std::uint32_t ceiling = plan.add(matte("ceiling", vec3(0.72f, 0.70f, 0.66f), 1.f));
  plan.frame = plan.add(glossy("gilt", vec3(0.62f, 0.42f, 0.14f), 0.4f, 50));

  const Opening main{{kMainLeft, kMainLow}, {kMainRight, kMainHigh}};
  const Opening side{{-0.8f, 0.5f}, {0.8f, 2.5f}};
  addWall(plan, "back wall", wall, kHalfX, &main, {0, 0, kMirrorPlane}, 0);
  addFrame(plan, main, {0, 0, kMirrorPlane}, 0);
  if (!plan.options.twin) addMirror(plan, "main mirror", 1.f, main, {0, 0, kMirrorPlane}, 0);
  addWall(plan, "front wall", wall, kHalfX, nullptr, {0, 0, kHalfZ}, kPi);
  for (const float x : {-kHalfX, kHalfX}) {
    const float turn = x < 0 ? kPi / 2 : -kPi / 2;
    addWall(plan, x < 0 ? "left wall" : "right wall", wall, kHalfZ, &side, {x, 0, 0}, turn);
    addFrame(plan, side, {x, 0, 0}, turn);
    addMirror(plan, x < 0 ? "left mirror" : "right mirror", 0.9f, side, {x, 0, 0}, turn);
  }

  MeshBuilder builder;
  const auto level = [&](vec2 low, vec2 high) {
    builder.quad({vec3(low.x, 0, high.y), vec3(high.x, 0, high.y), vec3(high.x, 0, low.y),
                  vec3(low.x, 0, low.y)},
                 {vec2(low.x, high.y) * 0.5f, high * 0.5f, vec2(high.x, low.y) * 0.5f, low * 0.5f});
  };
  level({-kHalfX, -kHalfZ}, {kPoolLeft, kHalfZ});
  level({kPoolRight, -kHalfZ}, {kHalfX, kHalfZ});
  level({kPoolLeft, -kHalfZ}, {kPoolRight, kPoolBack});
  level({kPoolLeft, kPoolFront}, {kPoolRight, kHalfZ});
  plan.put(builder, "floor", floor);
  builder.quad({vec3(-kHalfX, kHeight, -kHalfZ), vec3(kHalfX, kHeight, -kHalfZ),
                vec3(kHalfX, kHeight, kHalfZ), vec3(-kHalfX, kHeight, kHalfZ)});
  plan.put(builder, "ceiling", ceiling);
}

// Still water in a low rim: it reflects a third and shows its own colour else.
void addPool(Plan& plan) {
  constexpr float kRim = 0.12f, kRimHeight = 0.08f;
  MeshBuilder builder;
  builder.box({kPoolLeft - kRim, 0, kPoolFront},
              {kPoolRight + kRim, kRimHeight, kPoolFront + kRim});
  builder.box({kPoolLeft - kRim, 0, kPoolBack - kRim}, {kPoolRight + kRim, kRimHeight, kPoolBack});
  builder.box({kPoolLeft - kRim, 0, kPoolBack}, {kPoolLeft, kRimHeight, kPoolFront});
  builder.box({kPoolRight, 0, kPoolBack}, {kPoolRight + kRim, kRimHeight, kPoolFront});
  plan.put(builder, "rim", plan.add(glossy("marble", vec3(0.66f, 0.65f, 0.62f), 0.2f, 60)));
  const float y = 0.04f;
  builder.quad({vec3(kPoolLeft, y, kPoolFront), vec3(kPoolRight, y, kPoolFront),
                vec3(kPoolRight, y, kPoolBack), vec3(kPoolLeft, y, kPoolBack)});
  const std::uint32_t water = addMirrorMaterial(plan, "water", 0.35f, false);
  Material& material = plan.scene.materials[water];
  material.albedo = vec4(0.015f, 0.06f, 0.07f, 1);
  material.specular = vec3(0.6f);
  plan.put(builder, "pool", water);
}

// A tall glass that leans back in the corner.
void addLeaningMirror(Plan& plan) {
  MeshBuilder builder;
  const mat4 place = translated({2.9f, 0.02f, -2.35f}) * turnedY(-0.7f) *
                     glm::rotate(mat4(1.f), -0.18f, vec3(1, 0, 0));
  builder.setTransform(place);
  const vec2 low(-0.45f, 0.f), high(0.45f, 1.9f);
  builder.box(vec3(low - 0.05f, -0.04f) + vec3(0, 0.05f, 0), vec3(high + 0.05f, -0.002f));
  plan.put(builder, "leaning frame", plan.frame);
  builder.setTransform(place);
  builder.quad(
      {vec3(low.x, 0.05f, 0), vec3(high.x, 0.05f, 0), vec3(high, 0), vec3(low.x, high.y, 0)});
  plan.put(builder, "leaning mirror", addMirrorMaterial(plan, "leaning mirror", 0.9f, false));
}

void addFurniture(Plan& plan) {
  MeshBuilder builder;
  const std::array<vec2, 8> vase = {vec2(0.10f, 0),     vec2(0.20f, 0.08f), vec2(0.27f, 0.30f),
                                    vec2(0.22f, 0.52f), vec2(0.11f, 0.66f), vec2(0.10f, 0.74f),
                                    vec2(0.15f, 0.80f), vec2(0.f, 0.80f)};
  builder.lathe(vase, {.segments = 48});
  const std::uint32_t vaseMesh = addMesh(plan.scene, builder.take("vase"));
  builder.box({-0.26f, 0, -0.26f}, {0.26f, 0.7f, 0.26f});
  const std::uint32_t pedestal = addMesh(plan.scene, builder.take("pedestal"));
  const std::uint32_t stone = plan.add(glossy("stone", vec3(0.55f, 0.53f, 0.50f), 0.1f, 30));
  const auto addVase = [&](vec3 at, const char* name, vec3 color) {
    addObject(plan.scene, plan.root, pedestal, stone, at, 0.3f);
    addObject(plan.scene, plan.root, vaseMesh, plan.add(glossy(name, color, 0.5f, 90)),
              at + vec3(0, 0.7f, 0));
  };
  addVase({-2.4f, 0, -1.6f}, "red glaze", {0.60f, 0.06f, 0.05f});
  addVase({3.2f, 0, 0.9f}, "blue glaze", {0.05f, 0.15f, 0.50f});
  addVase({-2.6f, 0, 2.1f}, "green glaze", {0.07f, 0.40f, 0.16f});

  const std::array<vec3, 3> toys = {vec3(0.75f, 0.50f, 0.08f), vec3(0.10f, 0.45f, 0.55f),
                                    vec3(0.55f, 0.12f, 0.40f)};
  for (std::size_t i = 0; i < toys.size(); ++i) {
    const float side = 0.52f - 0.12f * static_cast<float>(i);
    const float y = i == 0 ? 0.f : i == 1 ? 0.52f : 0.92f;
    builder.roundedBox({-side / 2, 0, -side / 2}, {side / 2, side, side / 2}, 0.04f, 3);
    plan.put(builder, fmt::format("block {}", i + 1),
             plan.add(glossy(fmt::format("paint {}", i + 1), toys[i], 0.25f, 40)),
             {1.75f, y, -0.9f}, 0.4f + 0.5f * static_cast<float>(i));
  }

  builder.quad(
      {vec3(-0.4f, -0.4f, 0), vec3(0.4f, -0.4f, 0), vec3(0.4f, 0.4f, 0), vec3(-0.4f, 0.4f, 0)},
      {vec2(0, 1), vec2(1, 1), vec2(1, 0), vec2(0, 0)});
  Material clock = glossy("clock", vec3(1), 0.1f, 30);
  clock.albedoTexture = slot(addTexture(plan.scene, "clock", paint(256, 256, clockColor)));
  clock.emissive = vec3(0.15f);
  clock.emissiveTexture = clock.albedoTexture;
  plan.put(builder, "clock", plan.add(clock), {-0.9f, 2.2f, kHalfZ - 0.01f}, kPi);
}

// Spots over the main mirror that shine away from it, and lamps in the other half of the room.
void addLights(Plan& plan) {
  MeshBuilder builder;
  std::array<vec2, 9> globe;
  for (std::size_t i = 0; i < globe.size(); ++i) {
    const float angle = kPi * (static_cast<float>(i) / 8 - 0.5f);
    globe[i] = 0.09f * vec2(i % 8 == 0 ? 0.f : std::cos(angle), std::sin(angle));
  }
  builder.lathe(globe, {.segments = 16});
  const std::uint32_t bulb = addMesh(plan.scene, builder.take("bulb"));
  Material shining = matte("bulb", vec3(0.02f), 0.5f);
  shining.emissive = vec3(3.f, 2.5f, 1.8f);
  const std::uint32_t glow = plan.add(shining);

  const auto add = [&](Light light, vec3 at, vec3 direction) {
    Node node;
    node.name = light.name;
    node.parent = plan.root;
    node.translation = at;
    node.rotation = lookAlong(direction);
    light.node = addNode(plan.scene, std::move(node));
    plan.scene.lights.push_back(std::move(light));
    addObject(plan.scene, plan.root, bulb, glow, at);
  };
  for (const float x : {-2.4f, 0.f, 2.4f}) {
    Light spot;
    spot.name = fmt::format("spot {:g}", x);
    spot.kind = LightKind::Spot;
    spot.color = {1.f, 0.88f, 0.70f};
    spot.intensity = kPi * 3.4f;
    spot.attenuation = {1, 0, 0.25f};
    spot.range = 14.f;
    spot.radius = 0.09f;
    spot.innerCone = glm::radians(25.f);
    spot.outerCone = glm::radians(52.f);
    add(spot, {x, 3.05f, kMirrorPlane + 0.12f},
        {0, -std::sin(glm::radians(37.f)), std::cos(glm::radians(37.f))});
  }
  for (const float x : {-2.f, 2.f}) {
    Light lamp;
    lamp.name = fmt::format("lamp {:g}", x);
    lamp.color = x < 0 ? vec3(1.f, 0.74f, 0.48f) : vec3(0.70f, 0.82f, 1.f);
    lamp.intensity = kPi * 1.7f;
    lamp.attenuation = {1, 0, 0.35f};
    lamp.range = 3.9f;
    lamp.radius = 0.09f;
    add(lamp, {x, 2.5f, 1.f}, {0, -1, 0});
  }
}

// All objects and lights again, as a mirror image beyond the plane.
void addTwin(Scene& scene) {
  updateTransforms(scene);
  mat4 reflected(1.f);
  reflected[2].z = -1.f;
  reflected[3].z = 2 * kMirrorPlane;
  const auto twinOf = [&](std::uint32_t node) {
    const mat4 worldFromTwin = reflected * scene.nodes[node].worldFromNode;
    return addNode(scene, "twin of " + scene.nodes[node].name, worldFromTwin);
  };
  const std::size_t objects = scene.objects.size(), lights = scene.lights.size();
  for (std::size_t i = 0; i < objects; ++i) {
    Object twin = scene.objects[i];
    twin.node = twinOf(twin.node);
    scene.objects.push_back(twin);
  }
  for (std::size_t i = 0; i < lights; ++i) {
    Light twin = scene.lights[i];
    twin.name = "twin of " + twin.name;
    twin.node = twinOf(twin.node);
    scene.lights.push_back(std::move(twin));
  }
}

}  // namespace

Scene makeMirrors(const MirrorsOptions& options) {
  Scene scene;
  Node rootNode;
  rootNode.name = "mirrors";
  const std::uint32_t root = addNode(scene, std::move(rootNode));
  Plan plan{scene, root, options};
  addShell(plan);
  addPool(plan);
  addLeaningMirror(plan);
  addFurniture(plan);
  addLights(plan);
  if (options.twin) addTwin(scene);
  scene.ambient = vec3(0.20f, 0.19f, 0.18f);
  scene.background.color = vec3(0.02f);
  addCamera(scene, root, "main", {2.3f, 1.75f, 2.6f}, {-0.55f, 1.15f, -2.4f}, 54);
  addCamera(scene, root, "between", {-2.9f, 1.5f, 0.35f}, {4.f, 1.4f, -0.2f}, 50);
  addCamera(scene, root, "pool", {-1.7f, 1.7f, 1.6f}, {0.2f, 0, -0.6f}, 50);
  return scene;
}

}  // namespace lucerna::scene::builtin

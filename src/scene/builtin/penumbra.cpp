#include "scene/builtin/penumbra.hpp"

#include <cmath>

#include "scene/builtin/assembly.hpp"

namespace lucerna::scene::builtin {
namespace {

// The scene and what is known about it, made together so that they cannot part.
struct Stage {
  Scene scene;
  std::vector<PenumbraEdge> edges;
  std::uint32_t root = kNone, sheet = kNone, card = kNone;  // sheet: the material of the receivers
};

struct Lamp {
  vec3 positionW, axis;
  float radius = 0.25f;
  vec3 color{1.f};
  float brightness = 0.8f;  // of a white surface that faces it at `distance`
  float distance = 4.f;     // m
};

std::uint32_t addLamp(Stage& stage, const Lamp& lamp) {
  Light light;
  light.name = fmt::format("lamp {}", stage.scene.lights.size() + 1);
  light.kind = LightKind::Spot;
  light.color = lamp.color;
  light.intensity = kPi * lamp.brightness * lamp.distance * lamp.distance;
  light.radius = lamp.radius;
  light.innerCone = glm::radians(60.f);
  light.outerCone = glm::radians(80.f);
  light.range = 40.f;
  Node node;
  node.name = light.name;
  node.parent = stage.root;
  node.translation = lamp.positionW;
  node.rotation = lookAlong(lamp.axis);
  light.node = addNode(stage.scene, std::move(node));
  stage.scene.lights.push_back(std::move(light));
  return static_cast<std::uint32_t>(stage.scene.lights.size() - 1);
}

// A flat rectangle: a corner and its two sides, front where their cross product points.
void addRectangle(Stage& stage, const std::string& name, std::uint32_t material, vec3 corner,
                  vec3 u, vec3 v) {
  MeshBuilder builder;
  builder.quad({corner, corner + u, corner + u + v, corner + v});
  addMeshObject(stage.scene, stage.root, builder, name, material);
}

// A level sheet at height y, from low to high in x and z.
void addLevel(Stage& stage, const std::string& name, std::uint32_t material, float y, vec2 low,
              vec2 high) {
  addRectangle(stage, name, material, vec3(low.x, y, high.y), vec3(high.x - low.x, 0, 0),
               vec3(0, 0, low.y - high.y));
}

void addFloor(Stage& stage, vec2 low, vec2 high) {
  addLevel(stage, "floor", stage.sheet, 0.f, low, high);
}

Stage newStage() {
  Stage stage;
  Node rootNode;
  rootNode.name = "penumbra";
  stage.root = addNode(stage.scene, std::move(rootNode));
  stage.sheet = addMaterial(stage.scene, matte("sheet", vec3(0.62f, 0.61f, 0.59f), 1.f));
  Material card = matte("card", vec3(0.36f, 0.14f, 0.10f), 0.9f);
  card.doubleSided = true;
  stage.card = addMaterial(stage.scene, card);
  stage.scene.ambient = vec3(0.06f, 0.065f, 0.075f);
  stage.scene.background.color = vec3(0.02f, 0.022f, 0.027f);
  return stage;
}

// Where the line from a light's point through an edge's point meets the plane of points p with
// p[axis] = value.
vec3 projected(vec3 fromW, vec3 edgeW, int axis, float value) {
  return fromW + (edgeW - fromW) * ((value - fromW[axis]) / (edgeW[axis] - fromW[axis]));
}

// The penumbra of an edge between the lines from two light points; whichever line ends nearer to
// `dark`, a point in the shadow, ends the shadow.
void addEdge(Stage& stage, PenumbraEdge edge, vec3 first, vec3 second, vec3 dark) {
  const bool swap = glm::distance(first, dark) < glm::distance(second, dark);
  edge.litW = swap ? second : first;
  edge.darkW = swap ? first : second;
  stage.edges.push_back(std::move(edge));
}

// An edge along z of a level card, over the floor, under a lamp that shines straight down. The walk
// is along x through the shadow of the edge's point at edgeW.
void addLevelEdge(Stage& stage, PenumbraEdge edge, const Lamp& lamp, vec3 edgeW, float darkX) {
  const vec3 center = projected(lamp.positionW, edgeW, 1, 0.f);
  const auto end = [&](float side) {
    const vec3 rim = lamp.positionW + vec3(side * lamp.radius, 0, 0);
    return vec3(projected(rim, edgeW, 1, 0.f).x, 0, center.z);
  };
  addEdge(stage, std::move(edge), end(-1), end(1), vec3(darkX, 0, center.z));
}

Stage halfPlane() {
  Stage stage = newStage();
  const Lamp lamp{.positionW = {0, 4, 0}, .axis = {0, -1, 0}, .radius = 0.3f};
  const std::uint32_t light = addLamp(stage, lamp);
  addFloor(stage, {-3, -2.5f}, {3, 2.5f});
  constexpr float kHeight = 1.f;
  addLevel(stage, "card", stage.card, kHeight, {-4, -4}, {0, 4});
  for (const float z : {-0.9f, 0.f, 0.9f})
    addLevelEdge(stage, {.name = fmt::format("edge at z = {:g} m", z), .light = light}, lamp,
                 {0, kHeight, z}, -2.f);
  addCamera(stage.scene, stage.root, "main", {3.2f, 2.6f, 4.6f}, {0.35f, 0.1f, 0}, 40);
  return stage;
}

Stage cards() {
  Stage stage = newStage();
  const Lamp lamp{.positionW = {0, 4.5f, 0}, .axis = {0, -1, 0}, .radius = 0.25f};
  const std::uint32_t light = addLamp(stage, lamp);
  addFloor(stage, {-3, -3.5f}, {3, 3.5f});
  const std::array<float, 3> heights = {0.3f, 1.f, 2.f};
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const float z = 1.25f * (static_cast<float>(i) - 1), h = heights[i];
    const std::string name = fmt::format("card {}", i + 1);
    addLevel(stage, name, stage.card, h, {-0.6f, z - 0.4f}, {0.6f, z + 0.4f});
    for (const float side : {-1.f, 1.f})
      addLevelEdge(stage, {.name = name + (side < 0 ? ", left" : ", right"), .light = light}, lamp,
                   {0.6f * side, h, z}, 0.f);
  }
  addCamera(stage.scene, stage.root, "main", {3.9f, 3.6f, 4.6f}, {0, 0.75f, 0}, 36);
  return stage;
}

// Pickets before a lamp whose disc is level: seen from above, along their edges, it is a circle,
// whose tangents through an edge at the distance D of its centre lie asin(r / D) to either side.
Stage fence() {
  Stage stage = newStage();
  const Lamp lamp{.positionW = {-3.5f, 3.f, 0}, .axis = {0, -1, 0}, .radius = 0.12f};
  const std::uint32_t light = addLamp(stage, lamp);
  addFloor(stage, {-4, -3.5f}, {4, 3.5f});
  constexpr float kHalfWidth = 0.07f, kHeight = 1.4f, kStep = 0.45f;
  for (int i = -5; i <= 5; ++i) {
    const float z = kStep * static_cast<float>(i);
    const std::string name = fmt::format("picket {}", i + 6);
    addRectangle(stage, name, stage.card, vec3(0, 0, z - kHalfWidth), vec3(0, kHeight, 0),
                 vec3(0, 0, 2 * kHalfWidth));
    if (i % 2 != 0) continue;
    for (const float side : {-1.f, 1.f})
      for (const float behind : {0.5f, 1.5f}) {
        const vec3 edgeW(0, 0, z + side * kHalfWidth);
        const vec3 toEdge = edgeW - vec3(lamp.positionW.x, 0, lamp.positionW.z);
        const float distance = glm::length(toEdge);
        const vec3 along = toEdge / distance, across(-along.z, 0, along.x);
        const float half = behind * std::tan(std::asin(lamp.radius / distance));
        const vec3 middle = edgeW + behind * along;
        addEdge(
            stage,
            {.name =
                 fmt::format("{}, {}, {:g} m behind", name, side < 0 ? "left" : "right", behind),
             .light = light},
            middle - half * across, middle + half * across, middle - side * 0.1f * vec3(0, 0, 1));
      }
  }
  addCamera(stage.scene, stage.root, "main", {4.2f, 2.6f, 3.4f}, {0.6f, 0.35f, 0}, 42);
  return stage;
}

// A round pole before a wall, under a board that shadows the wall's upper part: two shadows that
// cross. The lamp shines level along -z, so its rim seen from above is the segment from x = -r to
// r, and seen from the side the one from y - r to y + r.
Stage pole() {
  Stage stage = newStage();
  const Lamp lamp{.positionW = {0, 1.2f, 3}, .axis = {0, 0, -1}, .radius = 0.15f, .distance = 4};
  const std::uint32_t light = addLamp(stage, lamp);
  constexpr float kWall = -1.f, kRadius = 0.08f, kHeight = 2.2f;
  addFloor(stage, {-2.5f, kWall}, {2.5f, 3.5f});
  addRectangle(stage, "wall", stage.sheet, vec3(-2.5f, 0, kWall), vec3(5, 0, 0), vec3(0, 2.6f, 0));
  MeshBuilder builder;
  const std::array<vec2, 2> profile = {vec2(kRadius, 0), vec2(kRadius, kHeight)};
  builder.lathe(profile, {.segments = 256});
  addMeshObject(stage.scene, stage.root, builder, "pole", stage.card);

  // The tangent from a rim point to the pole's circle on the given side, followed to the wall.
  const auto touching = [&](float rim, float side) {
    const vec2 from(rim, lamp.positionW.z);  // x, z
    const float distance = glm::length(from);
    const float turn = std::atan2(-from.x, from.y) + side * std::asin(kRadius / distance);
    return vec3(from.x + std::tan(turn) * (from.y - kWall), 0.8f, kWall);
  };
  for (const float side : {-1.f, 1.f})
    addEdge(stage, {.name = side < 0 ? "pole, left" : "pole, right", .light = light},
            touching(-lamp.radius, side), touching(lamp.radius, side), vec3(0, 0.8f, kWall));

  constexpr float kBoard = 1.7f, kBoardZ = 0.6f;  // its lower edge; its distance from the pole
  addRectangle(stage, "board", stage.card, vec3(-1.6f, kBoard, kBoardZ), vec3(3.2f, 0, 0),
               vec3(0, 0.5f, 0));
  const auto under = [&](float rim) {
    const vec3 rimW = lamp.positionW + vec3(0, rim, 0);
    const vec3 end = projected(rimW, vec3(0, kBoard, kBoardZ), 2, kWall);
    return vec3(0.8f, end.y, kWall);
  };
  addEdge(stage, {.name = "board, lower edge", .light = light}, under(-lamp.radius),
          under(lamp.radius), vec3(0.8f, 2.2f, kWall));
  addCamera(stage.scene, stage.root, "main", {2.1f, 1.5f, 3.1f}, {0, 1.05f, -0.6f}, 44);
  return stage;
}

// A low lamp and a board on the floor: the shadow's end is stretched over metres.
Stage grazing() {
  Stage stage = newStage();
  const Lamp lamp{.positionW = {-3, 1.2f, 0},
                  .axis = glm::normalize(vec3(1, -0.2f, 0)),
                  .radius = 0.15f,
                  .brightness = 1.6f};
  const std::uint32_t light = addLamp(stage, lamp);
  addFloor(stage, {-3.5f, -3}, {7, 3});
  constexpr float kHeight = 0.6f;
  addRectangle(stage, "board", stage.card, vec3(0, 0, 2.f), vec3(0, 0, -4.f), vec3(0, kHeight, 0));
  const vec3 rim = lamp.radius * vec3(0.2f, 1, 0) / std::hypot(0.2f, 1.f);
  for (const float z : {-0.5f, 0.5f}) {
    const auto end = [&](float side) {
      const vec3 floorW = projected(lamp.positionW + side * rim, vec3(0, kHeight, 0), 1, 0.f);
      return vec3(floorW.x, 0, z);
    };
    addEdge(stage, {.name = fmt::format("upper edge at z = {:g} m", z), .light = light}, end(-1),
            end(1), vec3(0.5f, 0, z));
  }
  addCamera(stage.scene, stage.root, "main", {6.6f, 2.1f, 3.6f}, {1.6f, 0.2f, -0.2f}, 42);
  return stage;
}

struct Pane {
  const char* name;
  float height;
  vec2 low, high;
  vec3 tint;
};

// Two panes that overlap, and a third over both on one side: light is multiplied by what each lets
// through.
Stage panes() {
  constexpr float kOpacity = 0.4f;
  const Pane red{"red pane", 0.5f, {-1.5f, -1.4f}, {0.2f, 1.4f}, {1.f, 0.22f, 0.16f}};
  const Pane blue{"blue pane", 1.f, {-0.45f, -1.3f}, {1.2f, 1.3f}, {0.2f, 0.4f, 1.f}};
  const Pane green{"green pane", 1.5f, {-1.2f, 0.15f}, {1.2f, 1.1f}, {0.3f, 1.f, 0.35f}};
  const auto through = [](const Pane& pane) { return transmittance(kOpacity, pane.tint); };

  Stage stage = newStage();
  const Lamp lamp{.positionW = {0, 4, 0}, .axis = {0, -1, 0}, .radius = 0.2f, .brightness = 1.f};
  const std::uint32_t light = addLamp(stage, lamp);
  addFloor(stage, {-3, -2.5f}, {3, 2.5f});
  for (const Pane& pane : {red, blue, green}) {
    Material glass = matte(pane.name, 0.25f * pane.tint, 0.2f);
    glass.albedo.w = kOpacity;
    glass.alphaMode = AlphaMode::Blend;
    glass.transmission = pane.tint;
    glass.doubleSided = true;
    addLevel(stage, pane.name, addMaterial(stage.scene, glass), pane.height, pane.low, pane.high);
  }
  const auto cross = [&](const Pane& pane, float z, bool left, vec3 beside) {
    const float x = left ? pane.low.x : pane.high.x;
    PenumbraEdge edge{
        .name = fmt::format("{}, {}, z = {:g} m", pane.name, left ? "left" : "right", z),
        .light = light,
        .litTransmittance = beside,
        .darkTransmittance = beside * through(pane)};
    // z is meant on the floor: seen from the lamp at x = z = 0, the edge's point is nearer to it.
    const float share = (lamp.positionW.y - pane.height) / lamp.positionW.y;
    addLevelEdge(stage, std::move(edge), lamp, {x, pane.height, z * share}, left ? 3.f : -3.f);
  };
  for (const float z : {-0.7f, 0.9f}) {
    const vec3 over = z < 0 ? vec3(1) : through(green);
    if (z > 0) cross(green, z, true, vec3(1));
    cross(red, z, true, over);
    cross(blue, z, true, over * through(red));
    cross(red, z, false, over * through(blue));
    cross(blue, z, false, over);
    if (z > 0) cross(green, z, false, vec3(1));
  }
  addCamera(stage.scene, stage.root, "main", {3.0f, 3.3f, 4.2f}, {0, 0.5f, 0}, 38);
  return stage;
}

vec3 hue(float share) {
  const vec3 phase = 2 * kPi * (share + vec3(0.f, 1.f / 3, 2.f / 3));
  return 0.6f + 0.4f * vec3(std::cos(phase.x), std::cos(phase.y), std::cos(phase.z));
}

// A ring of lamps, all of whose shadows of one card overlap.
Stage overlap(std::uint32_t lights) {
  Stage stage = newStage();
  addFloor(stage, {-3, -3}, {3, 3});
  constexpr float kHeight = 1.2f, kHalf = 0.5f;
  addLevel(stage, "card", stage.card, kHeight, vec2(-kHalf), vec2(kHalf));
  for (std::uint32_t i = 0; i < lights; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(lights);
    const float angle = 2 * kPi * (share + 0.05f);
    const Lamp lamp{.positionW = {1.1f * std::cos(angle), 4, 1.1f * std::sin(angle)},
                    .axis = {0, -1, 0},
                    .radius = 0.15f,
                    .color = lights == 1 ? vec3(1) : hue(share),
                    .brightness = 1.3f / static_cast<float>(lights)};
    const std::uint32_t light = addLamp(stage, lamp);
    const float middle = projected(lamp.positionW, {0, kHeight, 0}, 1, 0.f).x;
    for (const float side : {-1.f, 1.f})
      addLevelEdge(
          stage,
          {.name = fmt::format("lamp {}, {}", i + 1, side < 0 ? "left" : "right"), .light = light},
          lamp, {side * kHalf, kHeight, 0}, middle);
  }
  addCamera(stage.scene, stage.root, "main", {2.9f, 3.1f, 3.9f}, {0, 0.5f, 0}, 36);
  return stage;
}

Stage stageOf(const PenumbraOptions& options) {
  using Case = PenumbraOptions::Case;
  switch (options.which) {
    case Case::HalfPlane:
      return halfPlane();
    case Case::Cards:
      return cards();
    case Case::Fence:
      return fence();
    case Case::Pole:
      return pole();
    case Case::Grazing:
      return grazing();
    case Case::Panes:
      return panes();
    case Case::Overlap:
      return overlap(options.lights);
  }
  return halfPlane();
}

}  // namespace

Scene makePenumbra(const PenumbraOptions& options) {
  return stageOf(options).scene;
}

std::vector<PenumbraEdge> expectedPenumbrae(const PenumbraOptions& options) {
  return stageOf(options).edges;
}

}  // namespace lucerna::scene::builtin

// Cars and neon signs of the night city.
#include <cmath>

#include "scene/builtin/assembly.hpp"
#include "scene/builtin/nightcity.hpp"

namespace lucerna::scene::builtin::city {
namespace {

// The side view of a car that drives towards +z: (z, y), clockwise seen from its left (+x).
constexpr std::array<vec2, 10> kOutline{
    vec2(-2.1f, 0.3f), vec2(-2.15f, 0.85f), vec2(-1.95f, 1.0f), vec2(-1.35f, 1.42f),
    vec2(0.2f, 1.45f), vec2(0.95f, 0.98f),  vec2(1.95f, 0.84f), vec2(2.15f, 0.62f),
    vec2(2.1f, 0.3f),  vec2(0.f, 0.28f)};
constexpr float kCarHalf = 0.86f;

// The roof is narrower than the doors.
vec3 bodyPoint(vec2 p, float side) {
  return {side * (p.y > 1.2f ? 0.66f : kCarHalf), p.y, p.x};
}

Mesh carBody() {
  MeshBuilder b;
  const std::size_t count = kOutline.size();
  for (std::size_t i = 0; i < count; ++i) {
    const vec2 p = kOutline[i], q = kOutline[(i + 1) % count];
    b.quad({bodyPoint(p, -1), bodyPoint(q, -1), bodyPoint(q, 1), bodyPoint(p, 1)});
  }
  const std::array<vec2, 3> uv{vec2(0), vec2(1, 0), vec2(0, 1)};
  // Sides as fans: the lower body about its floor, the cabin above the belt line.
  for (const float side : {-1.f, 1.f}) {
    const auto face = [&](vec2 p, vec2 q, vec2 r) {
      if (side > 0)
        b.triangle({bodyPoint(p, 1), bodyPoint(q, 1), bodyPoint(r, 1)}, uv);
      else
        b.triangle({bodyPoint(p, -1), bodyPoint(r, -1), bodyPoint(q, -1)}, uv);
    };
    const vec2 floor = kOutline[9];
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {5, 6}, {6, 7}, {7, 8}})
      face(floor, kOutline[i], kOutline[j]);
    face(floor, kOutline[2], kOutline[5]);
    face(kOutline[2], kOutline[3], kOutline[5]);
    face(kOutline[3], kOutline[4], kOutline[5]);
  }
  return b.take("car body");
}

// A pane between two heights of the cabin's side, from z0 to z1 at the bottom, narrower at the top.
void addSideWindow(MeshBuilder& b, float side, float z0, float z1, vec2 lean) {
  constexpr float kLow = 1.08f, kHigh = 1.36f;
  // The cabin leans inward from the belt line at y = 1 to the roof at 1.43.
  const auto point = [&](float y, float z) {
    return vec3(side * (glm::mix(kCarHalf, 0.66f, (y - 1.f) / 0.43f) + 0.015f), y, z);
  };
  const vec3 a = point(kLow, z0), c = point(kLow, z1);
  const vec3 d = point(kHigh, z1 + lean.y), e = point(kHigh, z0 + lean.x);
  if (side > 0)
    b.quad({c, a, e, d});
  else
    b.quad({a, c, d, e});
}

// Windows a finger's breadth above the body, and wheels.
Mesh carDark() {
  MeshBuilder b;
  const auto pane = [&](vec2 low, vec2 high, float inset, vec2 lift) {
    const vec2 p = glm::mix(low, high, 0.12f) + lift, q = glm::mix(low, high, 0.88f) + lift;
    b.quad({vec3(-0.72f, p.y, p.x), vec3(-0.72f + inset, q.y, q.x), vec3(0.72f - inset, q.y, q.x),
            vec3(0.72f, p.y, p.x)});
  };
  pane(kOutline[2], kOutline[3], 0.12f, {-0.02f, 0.02f});
  // The windscreen is seen from the other side: from the roof down.
  pane(kOutline[4], kOutline[5], -0.05f, {0.02f, 0.02f});
  for (const float side : {-1.f, 1.f}) {
    addSideWindow(b, side, -1.6f, -0.5f, {0.35f, 0.f});
    addSideWindow(b, side, -0.4f, 0.65f, {0.f, -0.5f});
    for (const float z : {-1.32f, 1.3f}) {
      // The tyre below the body, then the wheel's outside.
      const float in = side * 0.6f, out = side * 0.88f;
      b.setTransform(mat4(1.f));
      b.box({std::min(in, out), 0.04f, z - 0.15f}, {std::max(in, out), 0.3f, z + 0.15f}, 1,
            kFaceFront | kFaceBack);
      b.setTransform(translated({side * 0.74f, 0.32f, z}) *
                     glm::rotate(mat4(1.f), -side * kPi / 2, vec3(0, 0, 1)));
      b.lathe(std::vector<vec2>{{0.32f, 0.14f}, {0, 0.16f}}, {.segments = 8});
    }
    b.setTransform(mat4(1.f));
  }
  return b.take("car glass and wheels");
}

Mesh carLights(float z, float facing) {
  MeshBuilder b;
  for (const float x : {-0.6f, 0.6f}) {
    const vec3 right(facing * 0.2f, 0, 0), up(0, 0.14f, 0), center(x, 0.66f, z);
    b.quad({center - right - up * 0.5f, center + right - up * 0.5f, center + right + up * 0.5f,
            center - right + up * 0.5f});
  }
  return b.take(facing > 0 ? "head lights" : "tail lights");
}

struct CarMeshes {
  std::uint32_t body, dark, head, tail;
};

void addCar(City& city, const CarMeshes& mesh, vec3 at, float angle, bool driving, Random& random) {
  const Materials& m = city.materials;
  const std::uint32_t node =
      addObject(city.scene, city.root, mesh.body, m.paints[random.below(4)], at, angle);
  addObject(city.scene, node, mesh.dark, m.dark);
  if (!driving) return;
  addObject(city.scene, node, mesh.head, m.beam);
  addObject(city.scene, node, mesh.tail, m.tail);
}

}  // namespace

void addCars(City& city) {
  Random random(city.options.seed, 40);
  const CarMeshes mesh{addMesh(city.scene, carBody()), addMesh(city.scene, carDark()),
                       addMesh(city.scene, carLights(2.17f, 1)),
                       addMesh(city.scene, carLights(-2.18f, -1))};
  // Parked along the boulevard, the right way round, not on the crossings.
  for (const int row : {-2, -1, 0}) {
    for (const float side : {-1.f, 1.f}) {
      for (int slot = 0; slot < 9; ++slot) {
        const float z = kPitch * (static_cast<float>(row) + 0.5f) +
                        11.f * static_cast<float>(slot) * (slot % 2 ? 1.f : -1.f) +
                        random.uniform(-2, 2);
        if (random.below(3) != 0)
          addCar(city, mesh, {side * 8.7f, 0, z}, side > 0 ? kPi : 0, false, random);
      }
    }
  }
  // Driving: right lanes go north (-z), left lanes south.
  for (int i = 0; i < 10; ++i) {
    const float lane = (i % 4 < 2 ? 2.4f : 5.6f) * (i % 2 ? 1.f : -1.f);
    const float z = -205.f - 31.f * static_cast<float>(i) + random.uniform(-6, 6);
    addCar(city, mesh, {lane, 0, z}, lane > 0 ? kPi : 0, true, random);
  }
  for (int i = 0; i < 6; ++i) {
    const float lane = i % 2 ? 4.f : -4.f;
    const float x = -150.f + 62.f * static_cast<float>(i) + random.uniform(-6, 6);
    addCar(city, mesh, {x, kHighwayTop, kHighwayZ + lane}, lane > 0 ? kPi / 2 : -kPi / 2, true,
           random);
  }
}

// Upright boxes that stick out of the facades along the boulevard.
void addSigns(City& city) {
  constexpr int kPictures = 4;
  std::array<std::uint32_t, kPictures> meshes{};
  for (int i = 0; i < kPictures; ++i) {
    MeshBuilder b;
    const float u0 = static_cast<float>(i) / kPictures, u1 = static_cast<float>(i + 1) / kPictures;
    for (const float side : {-1.f, 1.f}) {
      b.quad({vec3(-side * 0.8f, 0, side * 0.12f), vec3(side * 0.8f, 0, side * 0.12f),
              vec3(side * 0.8f, 6.4f, side * 0.12f), vec3(-side * 0.8f, 6.4f, side * 0.12f)},
             {vec2(u0, 1), vec2(u1, 1), vec2(u1, 0), vec2(u0, 0)});
    }
    meshes[static_cast<std::size_t>(i)] = addMesh(city.scene, b.take("sign"));
  }
  Random random(city.options.seed, 41);
  for (int i = 0; i < 22; ++i) {
    const float side = i % 2 ? 1.f : -1.f;
    const float z = -30.f - 20.f * static_cast<float>(i) + random.uniform(-5, 5);
    if (std::abs(std::remainder(z, kPitch)) < kRoad / 2 + kSidewalk + 3) continue;
    addObject(city.scene, city.root, meshes[random.below(kPictures)], city.materials.neon,
              {side * (kRoad / 2 + kSidewalk - 0.9f), 5.2f + random.uniform(0, 3), z});
  }
}

}  // namespace lucerna::scene::builtin::city

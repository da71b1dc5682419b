// Streets, the raised highway and the tunnel of the night city.
#include <cmath>

#include "scene/builtin/assembly.hpp"
#include "scene/builtin/nightcity.hpp"

namespace lucerna::scene::builtin::city {
namespace {

constexpr float kHalf = kRoad / 2;
constexpr float kMarkingTile = 12.f;  // m of road in one marking texture
constexpr float kZebra = 4.f;         // depth of a pedestrian crossing

// A strip of road along +z from z0 to z1 at height y; u across, v along.
void addStrip(MeshBuilder& b, float half, float y, float z0, float z1, float metresPerTile) {
  const float v0 = -z0 / metresPerTile, v1 = -z1 / metresPerTile;
  b.quad({vec3(-half, y, z1), vec3(half, y, z1), vec3(half, y, z0), vec3(-half, y, z0)},
         {vec2(0, v1), vec2(1, v1), vec2(1, v0), vec2(0, v0)});
}

// One street along +z at x = 0, from crossing to crossing.
void addStreet(MeshBuilder& lanes, MeshBuilder& zebra, const Extent& extent) {
  for (int i = extent.first; i < extent.last; ++i) {
    const float z0 = kPitch * static_cast<float>(i) + kHalf;
    const float z1 = kPitch * static_cast<float>(i + 1) - kHalf;
    addStrip(zebra, kHalf, 0, z0, z0 + kZebra, kZebra);
    addStrip(lanes, kHalf, 0, z0 + kZebra, z1 - kZebra, kMarkingTile);
    addStrip(zebra, kHalf, 0, z1 - kZebra, z1, kZebra);
  }
}

// One span, from x = -kSpan / 2 to kSpan / 2, its pillar below the middle.
Mesh spanConcrete() {
  constexpr float x = kSpan / 2, z = kHighwayHalf, top = kHighwayTop, wall = 0.35f;
  MeshBuilder b;
  b.box({-x, top - 1.2f, -z}, {x, top, z}, 4, kFaceBottom | kFaceFront | kFaceBack);
  for (const float side : {-1.f, 1.f}) {
    const float outer = side * z, inner = side * (z - wall);
    b.box({-x, top, std::min(outer, inner)}, {x, top + 1.f, std::max(outer, inner)}, 4,
          kFaceFront | kFaceBack | kFaceTop);
  }
  b.box({-1.1f, top - 2.4f, -6.f}, {1.1f, top - 1.2f, 6.f}, 4, kAllFaces & ~kFaceTop);
  b.lathe(std::vector<vec2>{{1.1f, 0.f}, {0.95f, top - 2.4f}},
          {.segments = 12, .metresPerTile = {4, 4}});
  return b.take("highway span");
}

Mesh spanDeck() {
  MeshBuilder b;
  b.setTransform(turnedY(kPi / 2));
  addStrip(b, kHighwayHalf - 0.35f, kHighwayTop, -kSpan / 2, kSpan / 2, kMarkingTile);
  return b.take("highway deck");
}

// The tunnel's inner outline, from the left foot over the vault to the right foot.
std::vector<vec2> tunnelOutline() {
  constexpr int kSegments = 12;
  std::vector<vec2> outline{{-kTunnelHalf, 0}};
  for (int i = 0; i <= kSegments; ++i) {
    const float angle = kPi * (1 - static_cast<float>(i) / kSegments);
    outline.emplace_back(kTunnelHalf * std::cos(angle),
                         kTunnelSpring + kTunnelRise * std::sin(angle));
  }
  outline.emplace_back(kTunnelHalf, 0);
  return outline;
}

// The front of the portal, facing +z at z = 0: a rectangle less the outline.
void addPortal(MeshBuilder& b, float half, float top) {
  const std::vector<vec2> outline = tunnelOutline();
  for (std::size_t i = 1; i + 2 < outline.size(); ++i) {
    const vec2 p = outline[i], q = outline[i + 1];
    b.quad({vec3(p, 0), vec3(q, 0), vec3(q.x, top, 0), vec3(p.x, top, 0)}, 4);
  }
  b.quad({vec3(-half, 0, 0), vec3(-kTunnelHalf, 0, 0), vec3(-kTunnelHalf, top, 0),
          vec3(-half, top, 0)},
         4);
  b.quad({vec3(kTunnelHalf, 0, 0), vec3(half, 0, 0), vec3(half, top, 0), vec3(kTunnelHalf, top, 0)},
         4);
}

}  // namespace

void addRoads(City& city) {
  const Materials& m = city.materials;
  MeshBuilder lanes, zebra, crossings;
  addStreet(lanes, zebra, city.extent);
  const std::uint32_t lanesMesh = addMesh(city.scene, lanes.take("lanes"));
  const std::uint32_t zebraMesh = addMesh(city.scene, zebra.take("pedestrian crossings"));
  for (int i = city.extent.first; i <= city.extent.last; ++i) {
    const float z = kPitch * static_cast<float>(i);
    crossings.quad({vec3(-kHalf, 0, z + kHalf), vec3(kHalf, 0, z + kHalf),
                    vec3(kHalf, 0, z - kHalf), vec3(-kHalf, 0, z - kHalf)},
                   kMarkingTile);
  }
  const std::uint32_t crossingMesh = addMesh(city.scene, crossings.take("crossings"));
  // A street along x is one along z turned about the middle of the city.
  const float middle = 0.5f * kPitch * static_cast<float>(city.extent.first + city.extent.last);
  for (int line = city.extent.first; line <= city.extent.last; ++line) {
    const float at = kPitch * static_cast<float>(line);
    addObject(city.scene, city.root, lanesMesh, m.road, {at, 0, 0});
    addObject(city.scene, city.root, zebraMesh, m.zebra, {at, 0, 0});
    addObject(city.scene, city.root, crossingMesh, m.crossing, {at, 0, 0});
    const vec3 turned(2 * middle, 0, at);
    addObject(city.scene, city.root, lanesMesh, m.road, turned, -kPi / 2);
    addObject(city.scene, city.root, zebraMesh, m.zebra, turned, -kPi / 2);
  }
}

void addHighway(City& city) {
  const std::uint32_t concrete = addMesh(city.scene, spanConcrete());
  const std::uint32_t deck = addMesh(city.scene, spanDeck());
  const int spans = 6 * (city.extent.last - city.extent.first);
  for (int i = 0; i < spans; ++i) {
    const float x =
        kPitch * static_cast<float>(city.extent.first) + kSpan * (static_cast<float>(i) + 0.5f);
    addObject(city.scene, city.root, concrete, city.materials.concrete, {x, 0, kHighwayZ});
    addObject(city.scene, city.root, deck, city.materials.deck, {x, 0, kHighwayZ});
  }
}

void addTunnel(City& city) {
  constexpr float kOuter = kTunnelHalf + 3, kTop = kTunnelSpring + kTunnelRise + 1.8f;
  constexpr float kLength = kTunnelFrom - kTunnelTo;
  const vec3 entrance(0, 0, kTunnelFrom);
  MeshBuilder portal, walls, ceiling, hill;
  addPortal(portal, kOuter, kTop);
  portal.box({-kOuter - 0.3f, kTop, -1.2f}, {kOuter + 0.3f, kTop + 0.9f, 0.4f}, 4);
  const std::uint32_t portalMesh = addMesh(city.scene, portal.take("tunnel portal"));
  addObject(city.scene, city.root, portalMesh, city.materials.concrete, entrance);
  addObject(city.scene, city.root, portalMesh, city.materials.concrete, {0, 0, kTunnelTo}, kPi);

  const std::vector<vec2> outline = tunnelOutline();
  float v = 0;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const vec2 p = outline[i], q = outline[i + 1];
    const float next = v + glm::length(q - p) / 4;
    const bool wall = std::min(p.y, q.y) < kTunnelSpring;
    (wall ? walls : ceiling)
        .quad({vec3(p, 0), vec3(p, -kLength), vec3(q, -kLength), vec3(q, 0)},
              {vec2(0, -v), vec2(kLength / 4, -v), vec2(kLength / 4, -next), vec2(0, -next)});
    v = next;
  }
  addObject(city.scene, city.root, addMesh(city.scene, walls.take("tunnel walls")),
            city.materials.tunnelWall, entrance);
  addObject(city.scene, city.root, addMesh(city.scene, ceiling.take("tunnel ceiling")),
            city.materials.tunnelCeiling, entrance);

  hill.box({-kOuter, 0, -kLength}, {kOuter, kTop, 0}, 6, kFaceLeft | kFaceRight);
  addObject(city.scene, city.root, addMesh(city.scene, hill.take("tunnel sides")),
            city.materials.concrete, entrance);
  hill.box({-kOuter, kTop - 1, -kLength}, {kOuter, kTop, 0}, 6, kFaceTop);
  addObject(city.scene, city.root, addMesh(city.scene, hill.take("tunnel roof")),
            city.materials.grass, entrance);
}

}  // namespace lucerna::scene::builtin::city

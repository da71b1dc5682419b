// Lamps of the night city: where they stand, what they look like, their light.
#include <algorithm>
#include <cmath>

#include "scene/builtin/assembly.hpp"
#include "scene/builtin/nightcity.hpp"

namespace lucerna::scene::builtin::city {
namespace {

constexpr float kPoleHeight = 8.5f, kArm = 2.6f;
constexpr float kSetBack = 0.7f;  // from the kerb

struct Lamp {
  vec3 position{0.f};  // of the foot; of the light for a ceiling lamp
  float angle = 0;     // the arm points along +z turned by this
  Tint tint = kWarm;
  float quadratic = 0.1f;
  bool ceiling = false;
};

// Slot `slot` at the side of the street (line) that runs along z (or x), beside block `row`.
Lamp streetLamp(bool alongX, int line, int row, int side, int slot) {
  const float along = kPitch * (static_cast<float>(row) + 0.5f) +
                      kLampSpacing * (static_cast<float>(slot) - 0.5f * (kLampSlots - 1));
  const float across =
      kPitch * static_cast<float>(line) + static_cast<float>(side) * (kRoad / 2 + kSetBack);
  Lamp lamp;
  lamp.position = alongX ? vec3(along, kKerb, across) : vec3(across, kKerb, along);
  // The arm reaches over the road.
  if (alongX)
    lamp.angle = side > 0 ? kPi : 0.f;
  else
    lamp.angle = side > 0 ? -kPi / 2 : kPi / 2;
  return lamp;
}

// The boulevard from one block south of the origin to the tunnel; the switchable ones come first.
void addBoulevard(std::vector<Lamp>& lamps) {
  for (const int row : {-1, -2, 0}) {
    for (int slot = kLampSlots - 1; slot >= 0; --slot) {
      for (const int side : {-1, 1}) {
        Lamp lamp = streetLamp(false, 0, row, side, slot);
        lamp.quadratic = 0.05f;
        lamps.push_back(lamp);
      }
    }
  }
}

// Every other slot of the street along x on a line, for one block to each side of the boulevard.
void addCrossStreet(std::vector<Lamp>& lamps, int line) {
  for (const int row : {-1, 0}) {
    for (int slot = 0; slot < kLampSlots; slot += 2) {
      for (const int side : {-1, 1}) {
        Lamp lamp = streetLamp(true, line, row, side, slot);
        lamp.tint = kSodium;
        lamps.push_back(lamp);
      }
    }
  }
}

void addTunnelLamps(std::vector<Lamp>& lamps) {
  constexpr int kCount = 10;
  for (int i = 0; i < kCount; ++i) {
    const float share = (static_cast<float>(i) + 0.5f) / kCount;
    Lamp lamp;
    lamp.position = {0, kTunnelSpring + kTunnelRise - 0.35f,
                     glm::mix(kTunnelFrom, kTunnelTo, share)};
    lamp.tint = kSodium;
    lamp.quadratic = 0.05f;
    lamp.ceiling = true;
    lamps.push_back(lamp);
  }
}

void addHighwayLamps(std::vector<Lamp>& lamps) {
  constexpr int kCount = 16;
  for (int i = 0; i < kCount; ++i) {
    const int side = i % 2 ? 1 : -1;
    Lamp lamp;
    lamp.position = {kSpan * (static_cast<float>(i) - 0.5f * (kCount - 1)), kHighwayTop,
                     kHighwayZ + static_cast<float>(side) * (kHighwayHalf - 0.17f)};
    lamp.angle = side > 0 ? kPi : 0.f;
    lamp.tint = kCold;
    lamp.quadratic = 0.06f;
    lamps.push_back(lamp);
  }
}

// The remaining slots of all streets, nearest to the middle first.
void addOtherStreets(std::vector<Lamp>& lamps, const Extent& extent, std::size_t count) {
  struct Candidate {
    float distance;
    Lamp lamp;
  };
  const auto taken = [&](const Lamp& lamp) {
    return std::any_of(lamps.begin(), lamps.end(), [&](const Lamp& other) {
      return glm::length(other.position - lamp.position) < 1;
    });
  };
  std::vector<Candidate> candidates;
  for (const bool alongX : {false, true})
    for (int line = extent.first; line <= extent.last; ++line)
      for (int row = extent.first; row < extent.last; ++row)
        for (const int side : {-1, 1})
          for (int slot = 0; slot < kLampSlots; slot += 2) {
            const bool inTunnel = !alongX && line == 0 && row == -3;
            const bool outside = line == (side < 0 ? extent.first : extent.last);
            Lamp lamp = streetLamp(alongX, line, row, side, slot);
            lamp.tint = line % 2 ? kSodium : kWarm;
            const vec3 from = lamp.position - vec3(0, 0, -kPitch / 2);
            if (!inTunnel && !outside) candidates.push_back({glm::length(from), lamp});
          }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  std::vector<Lamp> others;
  for (const Candidate& candidate : candidates) {
    if (others.size() == count) break;
    if (!taken(candidate.lamp)) others.push_back(candidate.lamp);
  }
  lamps.insert(lamps.end(), others.begin(), others.end());
}

std::vector<Lamp> planLamps(const City& city) {
  std::vector<Lamp> lamps;
  addBoulevard(lamps);
  addCrossStreet(lamps, -1);
  addCrossStreet(lamps, -2);
  addTunnelLamps(lamps);
  addHighwayLamps(lamps);
  CHECK(lamps.size() == kLamps, "{} lamps", lamps.size());
  const std::size_t blocks = city.options.blocks;
  const std::size_t wanted = kLamps * blocks * blocks / 64;
  if (wanted > kLamps) addOtherStreets(lamps, city.extent, wanted - kLamps);
  return lamps;
}

Mesh pole() {
  MeshBuilder b;
  const float y = kPoleHeight;
  b.lathe(std::vector<vec2>{{0.14f, 0}, {0.06f, y}}, {.segments = 6});
  b.box({-0.05f, y - 0.1f, -0.05f}, {0.05f, y, kArm - 0.4f}, 1);
  b.box({-0.18f, y - 0.12f, kArm - 0.4f}, {0.18f, y + 0.08f, kArm + 0.4f}, 1,
        kAllFaces & ~kFaceBottom);
  return b.take("lamp post");
}

Mesh poleGlow() {
  MeshBuilder b;
  const float y = kPoleHeight - 0.12f;
  b.box({-0.18f, y, kArm - 0.4f}, {0.18f, y + 0.1f, kArm + 0.4f}, 1, kFaceBottom);
  return b.take("lamp glass");
}

Mesh ceilingBox() {
  MeshBuilder b;
  b.box({-0.3f, 0.1f, -0.9f}, {0.3f, 0.3f, 0.9f}, 1, kAllFaces & ~kFaceBottom);
  return b.take("tunnel lamp");
}

Mesh ceilingGlow() {
  MeshBuilder b;
  b.box({-0.3f, 0.1f, -0.9f}, {0.3f, 0.2f, 0.9f}, 1, kFaceBottom);
  return b.take("tunnel lamp glass");
}

// Intensity pi: at the distance 0 and head on a white surface has brightness 1.
Light lightOf(const Lamp& lamp, std::size_t index) {
  Light light;
  light.name = fmt::format("lamp-{:02}", index + 1);
  if (index < kSwitchable) light.group = light.name;
  light.kind = LightKind::Spot;
  light.color = tintColor(lamp.tint);
  light.intensity = kPi;
  light.attenuation = {1.f, 0.f, lamp.quadratic};
  light.radius = 0.18f;
  light.innerCone = glm::radians(lamp.ceiling ? 60.f : 45.f);
  light.outerCone = glm::radians(lamp.ceiling ? 88.f : 84.f);
  light.exponent = 0.5f;
  return light;
}

}  // namespace

vec3 tintColor(Tint tint) {
  switch (tint) {
    case kSodium:
      return {1.f, 0.50f, 0.17f};
    case kCold:
      return {0.72f, 0.86f, 1.f};
    default:
      return {1.f, 0.76f, 0.46f};
  }
}

void addLamps(City& city) {
  Scene& scene = city.scene;
  const std::uint32_t poleMesh = addMesh(scene, pole()), poleGlass = addMesh(scene, poleGlow());
  const std::uint32_t boxMesh = addMesh(scene, ceilingBox());
  const std::uint32_t boxGlass = addMesh(scene, ceilingGlow());
  const std::vector<Lamp> lamps = planLamps(city);
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const Lamp& lamp = lamps[i];
    const std::uint32_t body = addObject(scene, city.root, lamp.ceiling ? boxMesh : poleMesh,
                                         city.materials.metal, lamp.position, lamp.angle);
    addObject(scene, body, lamp.ceiling ? boxGlass : poleGlass, city.materials.glows[lamp.tint]);
    Light light = lightOf(lamp, i);
    light.on = city.options.lamps;
    Node node;
    node.name = light.name;
    node.parent = body;
    // Just below the glass; street lamps look a little towards the houses.
    if (!lamp.ceiling) node.translation = {0, kPoleHeight - 0.2f, kArm};
    node.rotation = lookAlong(lamp.ceiling ? vec3(0, -1, 0) : vec3(0, -1, -0.06f));
    light.node = addNode(scene, std::move(node));
    scene.lights.push_back(std::move(light));
  }
}

}  // namespace lucerna::scene::builtin::city

// Shapes of the atrium. Rows of columns run along local x unless stated otherwise.
#include <cmath>

#include "scene/builtin/assembly.hpp"
#include "scene/builtin/atrium.hpp"

namespace lucerna::scene::builtin {
namespace {

using namespace atrium;

// Plinth, base, capital and abacus of a column of 5 m; the shaft is a mesh of its own.
Mesh columnStone() {
  MeshBuilder b;
  b.box({-0.55f, 0, -0.55f}, {0.55f, 0.22f, 0.55f}, 1, kSideFaces | kFaceTop);
  const Lathe round{.segments = 16, .creaseCosine = 0.5f};
  b.lathe(std::vector<vec2>{{0.48f, 0.22f},
                            {0.54f, 0.30f},
                            {0.48f, 0.40f},
                            {0.43f, 0.46f},
                            {0.47f, 0.53f},
                            {0.41f, 0.60f}},
          round);
  b.lathe(
      std::vector<vec2>{
          {0.35f, 4.33f}, {0.41f, 4.40f}, {0.37f, 4.47f}, {0.42f, 4.62f}, {0.56f, 4.80f}},
      round);
  b.box({-0.6f, 4.8f, -0.6f}, {0.6f, 5.f, 0.6f}, 1);
  return b.take("column stone");
}

Mesh shaft() {
  MeshBuilder b;
  b.lathe(std::vector<vec2>{{0.43f, 0.58f}, {0.37f, 4.36f}},
          {.segments = 48, .flutes = 12, .fluteDepth = 0.09f, .metresPerTile = {1.8f, 1.8f}});
  return b.take("shaft");
}

// The wall over one bay: from the springing (y = 0) up to `height`, with an arch cut out.
Mesh arch(float height, std::string name) {
  constexpr int kSegments = 12;
  constexpr float kRadius = kBay / 2 - 0.4f, kHalf = 0.35f, kCut = kRadius + 0.1f;
  MeshBuilder b;
  b.archRing(vec3(0), kRadius - 0.03f, kRadius + 0.22f, -kHalf - 0.07f, kHalf + 0.07f, kSegments);
  const auto at = [](float angle) { return kCut * vec2(std::cos(angle), std::sin(angle)); };
  const auto bothFaces = [&](vec2 p0, vec2 p1, vec2 p2, vec2 p3) {
    b.quad({vec3(p0, kHalf), vec3(p1, kHalf), vec3(p2, kHalf), vec3(p3, kHalf)});
    b.quad({vec3(p1, -kHalf), vec3(p0, -kHalf), vec3(p3, -kHalf), vec3(p2, -kHalf)});
  };
  for (int i = 0; i < kSegments; ++i) {
    const vec2 right = at(kPi * static_cast<float>(i) / kSegments);
    const vec2 left = at(kPi * static_cast<float>(i + 1) / kSegments);
    bothFaces(left, right, vec2(right.x, height), vec2(left.x, height));
  }
  bothFaces({kCut, 0}, {kBay / 2, 0}, {kBay / 2, height}, {kCut, height});
  bothFaces({-kBay / 2, 0}, {-kCut, 0}, {-kCut, height}, {-kBay / 2, height});
  b.box({kCut, 0, -kHalf}, {kBay / 2, 0.01f, kHalf}, 1, kFaceBottom);
  b.box({-kBay / 2, 0, -kHalf}, {-kCut, 0.01f, kHalf}, 1, kFaceBottom);
  return b.take(std::move(name));
}

Mesh balustrade() {
  constexpr int kBalusters = 8;
  constexpr float kHalf = kBay / 2 - 0.5f;
  MeshBuilder b;
  b.box({-kHalf, 0, -0.14f}, {kHalf, 0.14f, 0.14f});
  b.box({-kHalf, 0.92f, -0.16f}, {kHalf, 1.06f, 0.16f});
  const std::vector<vec2> profile{{0.075f, 0.14f}, {0.075f, 0.20f}, {0.045f, 0.25f}, {0.09f, 0.42f},
                                  {0.04f, 0.80f},  {0.075f, 0.86f}, {0.075f, 0.92f}};
  for (int i = 0; i < kBalusters; ++i) {
    const float x = kHalf * (2 * (static_cast<float>(i) + 0.5f) / kBalusters - 1);
    b.setTransform(translated({x, 0, 0}));
    b.lathe(profile, {.segments = 8, .creaseCosine = 0.6f});
  }
  return b.take("balustrade");
}

// A ceiling panel of 2 x 2.25 m seen from below, stepped upwards twice; y = 0 is the ceiling.
Mesh coffer() {
  MeshBuilder b;
  const auto rectangle = [](float inset, float y) {
    const float x = 1.f - inset, z = kBay / 4 - inset;
    return std::array<vec3, 4>{vec3(-x, y, -z), vec3(x, y, -z), vec3(x, y, z), vec3(-x, y, z)};
  };
  const auto ring = [&](const std::array<vec3, 4>& outer, const std::array<vec3, 4>& inner) {
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4;
      b.quad({outer[i], outer[j], inner[j], inner[i]});
    }
  };
  ring(rectangle(0, 0), rectangle(0.2f, 0));
  ring(rectangle(0.2f, 0), rectangle(0.26f, 0.25f));
  ring(rectangle(0.26f, 0.25f), rectangle(0.45f, 0.25f));
  ring(rectangle(0.45f, 0.25f), rectangle(0.5f, 0.45f));
  const auto top = rectangle(0.5f, 0.45f);
  b.quad({top[0], top[1], top[2], top[3]});
  return b.take("coffer");
}

// A bay of an outer wall, its inner face towards +z at z = 0, pilaster at the left end.
void wallTrim(MeshBuilder& b, float height) {
  const float left = -kBay / 2, right = kBay / 2;
  b.box({left - 0.35f, 0, 0}, {left + 0.35f, height, 0.18f}, 1,
        kFaceLeft | kFaceRight | kFaceFront);
  b.box({left, 0, 0}, {right, 0.35f, 0.08f}, 1, kFaceTop | kFaceFront);
  b.box({left, height - 0.4f, 0}, {right, height, 0.22f}, 1, kFaceBottom | kFaceFront);
}

Mesh lowerWall() {
  MeshBuilder b;
  constexpr float kHeight = kGallery - kSlab;
  b.quad({vec3(-kBay / 2, 0, 0), vec3(kBay / 2, 0, 0), vec3(kBay / 2, kHeight, 0),
          vec3(-kBay / 2, kHeight, 0)},
         2);
  return b.take("lower wall");
}

// With an opening of 1.8 x 3 m, 1.2 m above the gallery's floor.
Mesh upperWall() {
  MeshBuilder b;
  constexpr float kHeight = kCeiling - kGallery;
  constexpr float x = kBay / 2, w = 0.9f, low = 1.2f, high = 4.2f, back = -0.4f;
  const auto panel = [&](float x0, float y0, float x1, float y1) {
    // Texture coordinates that run on across the four panels.
    b.quad({vec3(x0, y0, 0), vec3(x1, y0, 0), vec3(x1, y1, 0), vec3(x0, y1, 0)},
           {vec2(x0, -y0) / 2.f, vec2(x1, -y0) / 2.f, vec2(x1, -y1) / 2.f, vec2(x0, -y1) / 2.f});
  };
  panel(-x, 0, x, low);
  panel(-x, high, x, kHeight);
  panel(-x, low, -w, high);
  panel(w, low, x, high);
  b.quad({vec3(-w, low, 0), vec3(w, low, 0), vec3(w, low, back), vec3(-w, low, back)}, 2);
  b.quad({vec3(-w, high, back), vec3(w, high, back), vec3(w, high, 0), vec3(-w, high, 0)}, 2);
  b.quad({vec3(-w, low, back), vec3(-w, high, back), vec3(-w, high, 0), vec3(-w, low, 0)}, 2);
  b.quad({vec3(w, low, 0), vec3(w, high, 0), vec3(w, high, back), vec3(w, low, back)}, 2);
  return b.take("upper wall");
}

Mesh windowQuad(float z, std::string name) {
  MeshBuilder b;
  b.quad({vec3(-0.9f, 1.2f, z), vec3(0.9f, 1.2f, z), vec3(0.9f, 4.2f, z), vec3(-0.9f, 4.2f, z)},
         {vec2(0, 1), vec2(1, 1), vec2(1, 0), vec2(0, 0)});
  return b.take(std::move(name));
}

Mesh endWall() {
  MeshBuilder b;
  b.quad(
      {vec3(-kWall, 0, 0), vec3(kWall, 0, 0), vec3(kWall, kCeiling, 0), vec3(-kWall, kCeiling, 0)},
      2);
  return b.take("end wall");
}

// A great arch round the middle of the end wall, the window's frame, and two cornices.
Mesh endTrim() {
  MeshBuilder b;
  constexpr float kRadius = 4.1f, kSpring = 7.8f;
  b.archRing({0, kSpring, 0}, kRadius, kRadius + 0.5f, -0.1f, 0.45f, 32, 1.5f);
  for (const float side : {-1.f, 1.f}) {
    const float x0 = side < 0 ? -kRadius - 0.5f : kRadius;
    b.box({x0, 0, -0.1f}, {x0 + 0.5f, kSpring, 0.45f}, 1.5f, kFaceLeft | kFaceRight | kFaceFront);
    b.box({x0 - 0.12f, kSpring - 0.35f, -0.1f}, {x0 + 0.62f, kSpring, 0.55f}, 1.5f);
  }
  b.setTransform(translated({0, 9.f, 0}));
  b.archRing(vec3(0), 2.05f, 2.4f, -0.1f, 0.2f, 24, 1.5f);
  b.setTransform(translated({0, 9.f, 0}) * glm::rotate(mat4(1.f), kPi, vec3(0, 0, 1)));
  b.archRing(vec3(0), 2.05f, 2.4f, -0.1f, 0.2f, 24, 1.5f);
  b.setTransform(mat4(1.f));
  b.box({-kWall, kCeiling - 0.5f, 0}, {kWall, kCeiling, 0.3f}, 1.5f, kFaceBottom | kFaceFront);
  return b.take("end trim");
}

Mesh rose() {
  constexpr int kSegments = 32;
  constexpr float kRadius = 2.1f;
  MeshBuilder b;
  const auto at = [](int i) {
    const float angle = 2 * kPi * static_cast<float>(i % kSegments) / kSegments;
    return vec2(std::cos(angle), std::sin(angle));
  };
  for (int i = 0; i < kSegments; ++i) {
    const vec2 p = at(i), q = at(i + 1);
    const auto uv = [](vec2 d) { return vec2(0.5f + 0.5f * d.x, 0.5f - 0.5f * d.y); };
    b.triangle({vec3(0), vec3(kRadius * p, 0), vec3(kRadius * q, 0)}, {vec2(0.5f), uv(p), uv(q)});
  }
  return b.take("rose window");
}

Mesh dais() {
  MeshBuilder b;
  for (int step = 0; step < 3; ++step) {
    const float s = static_cast<float>(step);
    b.box({-3.2f + 0.5f * s, 0.18f * s, -1.5f}, {3.2f - 0.5f * s, 0.18f * (s + 1), 2.4f - 0.5f * s},
          1.5f, kSideFaces | kFaceTop);
  }
  return b.take("dais");
}

Mesh plinth() {
  MeshBuilder b;
  b.box({-0.55f, 0, -0.55f}, {0.55f, 0.15f, 0.55f}, 1, kSideFaces | kFaceTop);
  b.box({-0.45f, 0.15f, -0.45f}, {0.45f, 1.05f, 0.45f}, 1, kSideFaces);
  b.box({-0.52f, 1.05f, -0.52f}, {0.52f, 1.2f, 0.52f}, 1);
  return b.take("plinth");
}

// A standing figure in a pleated robe, 1.75 m to the shoulders.
Mesh robe() {
  MeshBuilder b;
  b.lathe(std::vector<vec2>{{0.42f, 0},
                            {0.34f, 0.25f},
                            {0.27f, 0.7f},
                            {0.22f, 1.05f},
                            {0.27f, 1.3f},
                            {0.26f, 1.45f},
                            {0.12f, 1.56f},
                            {0.07f, 1.6f}},
          {.segments = 32, .creaseCosine = -1, .flutes = 8, .fluteDepth = 0.16f});
  return b.take("robe");
}

Mesh head() {
  MeshBuilder b;
  std::vector<vec2> profile;
  constexpr int kRings = 6;
  for (int i = 0; i <= kRings; ++i) {
    const float angle = kPi * static_cast<float>(i) / kRings;
    const float radius = i == 0 || i == kRings ? 0.f : 0.14f * std::sin(angle);
    profile.push_back({radius, 1.76f - 0.19f * std::cos(angle)});
  }
  b.lathe(profile, {.segments = 12, .creaseCosine = -1});
  // Both hands hold a globe before the chest.
  b.setTransform(translated({0, -0.55f, 0.34f}));
  b.lathe(profile, {.segments = 12, .creaseCosine = -1});
  return b.take("head and globe");
}

Mesh vase() {
  MeshBuilder b;
  b.lathe(std::vector<vec2>{{0.f, 0.f},
                            {0.22f, 0.f},
                            {0.20f, 0.06f},
                            {0.12f, 0.12f},
                            {0.26f, 0.32f},
                            {0.36f, 0.60f},
                            {0.33f, 0.85f},
                            {0.20f, 1.05f},
                            {0.14f, 1.18f},
                            {0.22f, 1.32f},
                            {0.19f, 1.31f},
                            {0.11f, 1.18f}},
          {.segments = 24, .creaseCosine = 0.3f});
  return b.take("vase");
}

Mesh pot() {
  MeshBuilder b;
  b.lathe(std::vector<vec2>{{0.30f, 0},
                            {0.42f, 0.55f},
                            {0.46f, 0.55f},
                            {0.46f, 0.66f},
                            {0.40f, 0.66f},
                            {0.38f, 0.58f},
                            {0, 0.58f}},
          {.segments = 20});
  return b.take("pot");
}

// Fronds that bend outwards from the pot's middle.
Mesh plant() {
  constexpr int kFronds = 11;
  MeshBuilder b;
  for (int i = 0; i < kFronds; ++i) {
    const float share = static_cast<float>(i) / kFronds;
    const float reach = i % 2 ? 0.9f : 0.55f, rise = i % 2 ? 1.0f : 1.5f;
    b.setTransform(translated({0, 0.58f, 0}) * turnedY(2 * kPi * share));
    b.grid(1, 4, [=](float s, float t) {
      return vec3((s - 0.5f) * 0.5f, rise * (t - 0.45f * t * t), -reach * t * t - 0.02f * t);
    });
  }
  return b.take("plant");
}

// 1.6 x 4.2 m, hanging from y = 0 down, in folds; front towards +z.
Mesh banner() {
  MeshBuilder b;
  b.grid(12, 10, [](float s, float t) {
    const float fall = 1 - t;
    const float fold = 0.09f * std::sin(4 * kPi * s) * (0.35f + 0.65f * fall);
    const float hem = 0.3f * std::abs(s - 0.5f) * fall * fall * fall;
    return vec3((s - 0.5f) * 1.6f, -4.2f * fall + hem, fold + 0.12f * std::sin(3 * fall));
  });
  return b.take("banner");
}

// A shaded lamp that shines along -z from the origin, with its bulb's disc apart.
Mesh lamp() {
  MeshBuilder b;
  b.setTransform(glm::rotate(mat4(1.f), kPi / 2, vec3(1, 0, 0)));
  b.lathe(
      std::vector<vec2>{
          {0.20f, 0.03f}, {0.24f, 0.02f}, {0.17f, 0.26f}, {0.07f, 0.38f}, {0.05f, 0.5f}, {0, 0.5f}},
      {.segments = 16});
  return b.take("lamp");
}

Mesh bulb() {
  MeshBuilder b;
  b.setTransform(glm::rotate(mat4(1.f), kPi / 2, vec3(1, 0, 0)));
  b.lathe(std::vector<vec2>{{0, 0.03f}, {0.20f, 0.05f}}, {.segments = 16});
  return b.take("bulb");
}

Mesh boxMesh(vec3 low, vec3 high, unsigned faces, float metresPerTile, std::string name) {
  MeshBuilder b;
  b.box(low, high, metresPerTile, faces);
  return b.take(std::move(name));
}

Mesh trimmedSlab() {
  MeshBuilder b;
  // The gallery floor of one bay, from the nave's edge (z = 0.6) to the wall (z = -4.5), and a
  // stepped cornice along its edge.
  constexpr float x = kBay / 2;
  b.box({-x, -kSlab, kNave - kWall}, {x, 0, 0.6f}, 2, kFaceTop | kFaceBottom | kFaceFront);
  b.box({-x, -0.12f, 0.6f}, {x, 0.02f, 0.78f}, 1, kFaceTop | kFaceBottom | kFaceFront | kFaceBack);
  b.box({-x, -0.22f, 0.6f}, {x, -0.12f, 0.69f}, 1, kFaceBottom | kFaceFront);
  return b.take("gallery slab");
}

Mesh trim(float height, std::string name) {
  MeshBuilder b;
  wallTrim(b, height);
  return b.take(std::move(name));
}

// One bay of the open strip: a beam across it, and its upstands, which hide the ceiling's back.
// y = 0 is the ceiling.
Mesh skylight() {
  constexpr float x = kSkylight, z = kBay / 2;
  MeshBuilder b;
  b.box({-x, -0.05f, -0.18f}, {x, 0.65f, 0.18f}, 1, kAllFaces & ~(kFaceLeft | kFaceRight));
  for (const float side : {-1.f, 1.f})
    b.quad({vec3(side * x, 0, -side * z), vec3(side * x, 0, side * z),
            vec3(side * x, 0.9f, side * z), vec3(side * x, 0.9f, -side * z)});
  return b.take("skylight");
}

Mesh floorTile(float halfWidth, std::string name) {
  MeshBuilder b;
  const float x = halfWidth, z = kBay / 2;
  b.quad({vec3(-x, 0, z), vec3(x, 0, z), vec3(x, 0, -z), vec3(-x, 0, -z)}, 2.25f);
  return b.take(std::move(name));
}

Mesh aisleCeiling() {
  MeshBuilder b;
  const float x = (kWall - kNave) / 2, z = kBay / 2;
  b.quad({vec3(-x, 0, -z), vec3(x, 0, -z), vec3(x, 0, z), vec3(-x, 0, z)}, 2);
  return b.take("aisle ceiling");
}

Mesh chain() {
  MeshBuilder b;
  b.lathe(std::vector<vec2>{{0.02f, 0}, {0.02f, 1}}, {.segments = 6});
  return b.take("chain");
}

}  // namespace

AtriumMeshes addAtriumMeshes(Scene& scene) {
  const auto add = [&](Mesh mesh) { return addMesh(scene, std::move(mesh)); };
  AtriumMeshes m{};
  m.columnStone = add(columnStone());
  m.shaft = add(shaft());
  m.lowerArch = add(arch(kLowerArch, "lower arch"));
  m.upperArch = add(arch(kUpperArch, "upper arch"));
  m.balustrade = add(balustrade());
  m.coffer = add(coffer());
  m.naveFloor = add(floorTile(kNave, "nave floor"));
  m.aisleFloor = add(floorTile((kWall - kNave) / 2, "aisle floor"));
  m.slab = add(trimmedSlab());
  m.lowerWall = add(lowerWall());
  m.lowerTrim = add(trim(kGallery - kSlab, "lower trim"));
  m.upperWall = add(upperWall());
  m.upperTrim = add(trim(kCeiling - kGallery, "upper trim"));
  m.lattice = add(windowQuad(-0.38f, "lattice"));
  m.pane = add(windowQuad(-0.3f, "pane"));
  m.aisleCeiling = add(aisleCeiling());
  m.skylight = add(skylight());
  m.endWall = add(endWall());
  m.endTrim = add(endTrim());
  m.rose = add(rose());
  m.dais = add(dais());
  m.plinth = add(plinth());
  m.robe = add(robe());
  m.head = add(head());
  m.vase = add(vase());
  m.pot = add(pot());
  m.plant = add(plant());
  m.banner = add(banner());
  m.rod = add(boxMesh({-0.9f, -0.03f, -0.03f}, {0.9f, 0.03f, 0.03f}, kAllFaces, 1, "rod"));
  m.lamp = add(lamp());
  m.bulb = add(bulb());
  m.chain = add(chain());
  return m;
}

}  // namespace lucerna::scene::builtin

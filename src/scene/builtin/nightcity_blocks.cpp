// The blocks of the night city: pavements, buildings and trees.
//
// A few prototypes of each district are built once and placed many times, turned by quarters.
#include <algorithm>
#include <cmath>
#include <map>

#include "scene/builtin/assembly.hpp"
#include "scene/builtin/nightcity.hpp"
#include "scene/builtin/procedural_texture.hpp"

namespace lucerna::scene::builtin::city {
namespace {

constexpr float kFront = kBlockHalf - kSidewalk;  // the building line
constexpr float kShopHeight = 4.2f, kShopWidth = 5.f;
constexpr int kShopsPerTile = 8;
// From this size on buildings have a ledge at every floor.
constexpr std::uint32_t kFineBlocks = 16;

enum District { kCore, kMiddle, kOuter, kDistricts };
constexpr std::array<std::uint32_t, kDistricts> kPrototypes{6, 8, 6};

// The parts of a prototype, one builder a material.
struct Parts {
  std::map<std::uint32_t, MeshBuilder> byMaterial;
  mat4 transform{1.f};
  MeshBuilder& of(std::uint32_t material) {
    MeshBuilder& builder = byMaterial[material];
    builder.setTransform(transform);
    return builder;
  }
};

struct Building {
  Style style = kBrick;
  float width = 20, depth = 16;  // m, along and away from the street
  int floors = 5;
  bool shop = false;
  bool pitched = false;  // a pitched roof, else a cornice
  bool cornice = true;   // else a bare flat roof
  bool ledges = false;
};

// Four walls of `rows` window rows from y0 to y1 over a rectangle; each side shows whole windows
// from a random place of the texture. The front (+z) may begin higher, above a shop.
void addWalls(MeshBuilder& b, const Facade& facade, vec2 half, float y0, float y1, int rows,
              float frontY0, Random& random) {
  const std::array<vec2, 4> corners{vec2(-half.x, half.y), vec2(half.x, half.y),
                                    vec2(half.x, -half.y), vec2(-half.x, -half.y)};
  for (std::size_t side = 0; side < 4; ++side) {
    const vec2 p = corners[side], q = corners[(side + 1) % 4];
    const float cells = std::max(1.f, std::round(glm::length(q - p) / facade.cellWidth));
    const float low = side == 0 ? frontY0 : y0;
    const float rowCount =
        std::round(static_cast<float>(rows) * (y1 - low) / std::max(y1 - y0, 0.1f));
    const float u = static_cast<float>(random.below(kColumns)) / kColumns;
    const float v = static_cast<float>(random.below(kRows)) / kRows;
    const float du = cells / kColumns, dv = rowCount / kRows;
    b.quad({vec3(p.x, low, p.y), vec3(q.x, low, q.y), vec3(q.x, y1, q.y), vec3(p.x, y1, p.y)},
           {vec2(u, v), vec2(u + du, v), vec2(u + du, v - dv), vec2(u, v - dv)});
  }
}

void addShops(MeshBuilder& b, vec2 half, float y0, Random& random) {
  const float shops = std::max(1.f, std::round(2 * half.x / kShopWidth));
  const float u = static_cast<float>(random.below(kShopsPerTile)) / kShopsPerTile;
  const float du = shops / kShopsPerTile, y1 = y0 + kShopHeight;
  b.quad({vec3(-half.x, y0, half.y), vec3(half.x, y0, half.y), vec3(half.x, y1, half.y),
          vec3(-half.x, y1, half.y)},
         {vec2(u, 1), vec2(u + du, 1), vec2(u + du, 0), vec2(u, 0)});
}

void addPitchedRoof(Parts& parts, const Materials& m, const Building& building, vec2 half,
                    float y) {
  const float ridge = y + 0.5f * half.y;
  MeshBuilder& roof = parts.of(m.tiles);
  roof.quad({vec3(-half.x, y, half.y), vec3(half.x, y, half.y), vec3(half.x, ridge, 0),
             vec3(-half.x, ridge, 0)},
            3);
  roof.quad({vec3(half.x, y, -half.y), vec3(-half.x, y, -half.y), vec3(-half.x, ridge, 0),
             vec3(half.x, ridge, 0)},
            3);
  // Gables show the wall between two windows.
  MeshBuilder& wall = parts.of(m.facades[building.style]);
  const vec2 uv(0.5f / kColumns * 0.1f, 0.5f / kRows * 0.1f);
  wall.triangle({vec3(half.x, y, half.y), vec3(half.x, y, -half.y), vec3(half.x, ridge, 0)},
                {uv, uv, uv});
  wall.triangle({vec3(-half.x, y, -half.y), vec3(-half.x, y, half.y), vec3(-half.x, ridge, 0)},
                {uv, uv, uv});
}

void addCornice(Parts& parts, const Materials& m, vec2 half, float y, float out, float height) {
  parts.of(m.roof).box({-half.x - out, y, -half.y - out}, {half.x + out, y + height, half.y + out},
                       4);
}

// Under parts.transform: the front faces +z, the ground is the pavement.
void addBuilding(Parts& parts, const Materials& m, const Building& building, Random& random) {
  const Facade& style = facade(building.style);
  vec2 half(building.width / 2, building.depth / 2);
  float y = kKerb;
  float top = y + style.cellHeight * static_cast<float>(building.floors);
  const float front = building.shop ? y + kShopHeight : y;
  if (building.shop) {
    addShops(parts.of(m.shops), half, y, random);
    top += kShopHeight;
  }
  const int rows = building.floors + (building.shop ? 1 : 0);
  addWalls(parts.of(m.facades[building.style]), style, half, y, top, rows, front, random);
  if (building.ledges) {
    for (int floor = 1; floor < rows; ++floor)
      addCornice(parts, m, half,
                 y + (top - y) * static_cast<float>(floor) / static_cast<float>(rows) - 0.15f,
                 0.18f, 0.2f);
  }
  if (building.pitched) return addPitchedRoof(parts, m, building, half, top);
  if (building.cornice)
    addCornice(parts, m, half, top, 0.35f, 0.9f);
  else
    parts.of(m.roof).box({-half.x, top - 1, -half.y}, {half.x, top, half.y}, 4, kFaceTop);
  if (building.floors < 9) return;
  // Tall buildings step back once and carry a plant room.
  const int more = 3 + static_cast<int>(random.below(7));
  half *= 0.72f;
  y = top + 0.9f;
  top = y + style.cellHeight * static_cast<float>(more);
  addWalls(parts.of(m.facades[building.style]), style, half, y, top, more, y, random);
  addCornice(parts, m, half, top, 0.2f, 0.6f);
  addCornice(parts, m, half * 0.4f, top + 0.6f, 0.f, 3.f);
}

Style pickStyle(District district, Random& random) {
  constexpr std::array<std::array<Style, 6>, kDistricts> kChoice{
      {{kOffice, kClassic, kGlass, kBrick, kClassic, kOffice},
       {kBrick, kClassic, kPlaster, kConcrete, kBrick, kOffice},
       {kPlaster, kPlaster, kConcrete, kBrick, kPlaster, kPlaster}}};
  return kChoice[district][random.below(6)];
}

Building pickBuilding(District district, const NightCityOptions& options, Random& random) {
  Building building;
  building.style = pickStyle(district, random);
  const auto floors = [&](std::uint32_t low, std::uint32_t high) {
    return static_cast<int>(low + random.below(high - low + 1));
  };
  switch (district) {
    case kCore:
      building.width = random.uniform(18, 30);
      building.depth = random.uniform(15, 20);
      building.floors = random.below(4) == 0 ? floors(10, 16) : floors(5, 8);
      building.shop = random.below(5) != 0;
      break;
    case kMiddle:
      building.width = random.uniform(24, 40);
      building.depth = random.uniform(12, 16);
      building.floors = floors(3, 6);
      building.shop = random.below(4) == 0;
      building.pitched = building.style != kOffice && random.below(3) == 0;
      building.cornice = random.below(2) == 0;
      break;
    default:
      building.width = random.uniform(12, 18);
      building.depth = random.uniform(10, 12);
      building.floors = floors(2, 3);
      building.pitched = building.style != kConcrete;
  }
  building.ledges = options.blocks > kFineBlocks;
  return building;
}

// Buildings along one side of a block, which faces +z under `side`.
void addRow(Parts& parts, const Materials& m, District district, const NightCityOptions& options,
            const mat4& side, float reach, Random& random) {
  float x = -reach;
  while (reach - x > 8) {
    Building building = pickBuilding(district, options, random);
    // The last house takes what is left rather than leaving a slot.
    if (reach - x - building.width < 14 && district != kOuter) building.width = reach - x;
    if (x + building.width > reach + 0.01f) return;
    const float setBack = district == kOuter ? 6.f : 0.f;
    const vec3 center(x + building.width / 2, 0, kFront - setBack - building.depth / 2);
    const float angle = options.jitter * random.uniform(-0.25f, 0.25f);
    x += building.width;
    if (district == kMiddle && random.below(2) == 0) x += random.uniform(8, 24);
    if (district == kOuter) x += random.uniform(16, 40);
    // A turned house shrinks to stay within its lot.
    const float shrink = 1 / (std::cos(angle) + std::abs(std::sin(angle)));
    building.width *= shrink;
    building.depth *= shrink;
    parts.transform = side * translated(center) * turnedY(angle);
    addBuilding(parts, m, building, random);
    parts.transform = mat4(1.f);
  }
}

void addPavement(Parts& parts, const Materials& m) {
  constexpr float a = kBlockHalf, b = kFront, y = kKerb;
  for (int side = 0; side < 4; ++side) {
    parts.transform = turnedY(kPi / 2 * static_cast<float>(side));
    MeshBuilder& stone = parts.of(m.sidewalk);
    stone.quad({vec3(-a, y, a), vec3(a, y, a), vec3(b, y, b), vec3(-b, y, b)}, 2);
    stone.quad({vec3(-a, 0, a), vec3(a, 0, a), vec3(a, y, a), vec3(-a, y, a)}, 2);
  }
  parts.transform = mat4(1.f);
  parts.of(m.yard).quad({vec3(-b, y, b), vec3(b, y, b), vec3(b, y, -b), vec3(-b, y, -b)}, kYard);
}

void addTree(MeshBuilder& b, vec3 foot, float height, float angle) {
  const float half = 0.42f * height;
  for (int i = 0; i < 2; ++i) {
    const float turn = angle + kPi / 2 * static_cast<float>(i);
    const vec3 d = half * vec3(std::cos(turn), 0, std::sin(turn)), up(0, height, 0);
    b.quad({foot - d, foot + d, foot + d + up, foot - d + up},
           {vec2(0, 1), vec2(1, 1), vec2(1, 0), vec2(0, 0)});
  }
}

void addTrees(Parts& parts, const Materials& m, District district, Random& random) {
  MeshBuilder& b = parts.of(m.tree);
  const int perSide = district == kCore ? 7 : 3;
  for (int side = 0; side < 4; ++side) {
    const mat4 turn = turnedY(kPi / 2 * static_cast<float>(side));
    for (int i = 0; i < perSide; ++i) {
      // Between the lamps.
      const int slot = district == kCore ? i - 3 : static_cast<int>(random.below(7)) - 3;
      const vec4 foot(kLampSpacing * static_cast<float>(slot), kKerb, kBlockHalf - 1.6f, 1);
      addTree(b, vec3(turn * foot), random.uniform(5.f, 7.5f), random.uniform(0, kPi));
    }
  }
}

struct Prototype {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> parts;  // mesh, material
};

Prototype makePrototype(City& city, District district, std::uint32_t variant) {
  Random random(city.options.seed, 100 + 16 * district + variant);
  Parts parts;
  addPavement(parts, city.materials);
  for (int side = 0; side < 4; ++side) {
    const mat4 turn = turnedY(kPi / 2 * static_cast<float>(side));
    // Two opposite sides take the corners; the other two fit in between.
    addRow(parts, city.materials, district, city.options, turn, side % 2 ? kFront - 21 : kFront,
           random);
  }
  addTrees(parts, city.materials, district, random);
  Prototype prototype;
  for (auto& [material, builder] : parts.byMaterial) {
    if (builder.empty()) continue;
    const std::string name = fmt::format("block {}-{} {}", static_cast<int>(district), variant,
                                         city.scene.materials[material].name);
    prototype.parts.emplace_back(addMesh(city.scene, builder.take(name)), material);
  }
  return prototype;
}

// Dense around the boulevard between the origin and the tunnel, loose at the edge.
District districtAt(vec2 center, const Extent& extent) {
  const float radius = 0.5f * kPitch * static_cast<float>(extent.last - extent.first);
  const float share =
      std::max(std::abs(center.x), 0.75f * std::abs(center.y + kPitch / 2)) / radius;
  return share < 0.3f ? kCore : share < 0.65f ? kMiddle : kOuter;
}

}  // namespace

void addBlocks(City& city) {
  std::array<std::vector<Prototype>, kDistricts> prototypes;
  for (int district = 0; district < kDistricts; ++district)
    for (std::uint32_t variant = 0; variant < kPrototypes[district]; ++variant)
      prototypes[district].push_back(makePrototype(city, static_cast<District>(district), variant));
  std::array<std::uint32_t, kDistricts> used{};
  for (int row = city.extent.first; row < city.extent.last; ++row) {
    for (int column = city.extent.first; column < city.extent.last; ++column) {
      const vec2 center = kPitch * (vec2(column, row) + 0.5f);
      const District district = districtAt(center, city.extent);
      const std::uint32_t hash =
          latticeHash(static_cast<std::uint32_t>(column + 1000),
                      static_cast<std::uint32_t>(row + 1000), city.options.seed);
      // In turn, so that a small city shows every prototype.
      const std::uint32_t variant = used[district]++ % kPrototypes[district];
      const float angle = kPi / 2 * static_cast<float>(hash >> 30);
      // Along the tunnel there is no room for trees.
      const bool treeless = row == -3 && (column == -1 || column == 0);
      for (const auto& [mesh, material] : prototypes[district][variant].parts)
        if (!treeless || material != city.materials.tree)
          addObject(city.scene, city.root, mesh, material, {center.x, 0, center.y}, angle);
    }
  }
}

}  // namespace lucerna::scene::builtin::city

// Where each triangle of a scene lies in the lightmaps.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/file.hpp"
#include "scene/scene.hpp"

namespace lucerna::lightmap {

struct TrianglePlace {
  static constexpr std::int32_t kNowhere = -1;
  std::int32_t map = kNowhere;  // kNowhere: the triangle has no area, or takes no light
  std::uint32_t chart = 0;      // triangles of a chart are connected in the map
  // Texels of the map, (0, 0) its top left corner; in the order of the mesh's corners.
  std::array<vec2, 3> corners{};
};

struct Layout {
  int side = 0;  // texels of each map
  int maps = 0;
  int charts = 0;
  // As Scene::objects. Each as long as its mesh has triangles; empty: it has no light of its own.
  std::vector<std::vector<TrianglePlace>> objects;
};

Bytes toBytes(const Layout& layout);
// Errors (ErrorKind::Input) name the file. What comes back refers to nothing outside of it.
Result<Layout> layoutFrom(std::span<const std::byte> bytes, const std::string& name);

// ErrorKind::Input unless the layout is one of this scene: as many objects and triangles.
Status checkFits(const Layout& layout, const scene::Scene& scene);

}  // namespace lucerna::lightmap

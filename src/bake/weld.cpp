#include "bake/weld.hpp"

#include <algorithm>
#include <tuple>

#include "bake/triangle.hpp"

namespace lucerna::bake {

std::vector<std::uint32_t> weld(std::span<const vec3> positions) {
  struct Vertex {
    vec3 place;
    std::uint32_t number;
    auto key() const { return std::tuple(place.x, place.y, place.z, number); }
  };
  std::vector<Vertex> vertices;
  vertices.reserve(positions.size());
  for (const vec3 p : positions)
    vertices.push_back({.place = isFinite(p) ? p + 0.f : vec3(0.f),  // -0 is 0
                        .number = static_cast<std::uint32_t>(vertices.size())});
  std::ranges::sort(vertices, {}, &Vertex::key);
  std::vector<std::uint32_t> lowest(positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i)
    lowest[vertices[i].number] = i > 0 && vertices[i].place == vertices[i - 1].place
                                     ? lowest[vertices[i - 1].number]
                                     : vertices[i].number;
  return lowest;
}

}  // namespace lucerna::bake

#include "lightmap/layout.hpp"

#include <cmath>

#include "core/byte_stream.hpp"

namespace lucerna::lightmap {
namespace {

constexpr std::uint64_t kMagic = 0x31'74'75'6f'79'61'4c'4cull;  // "LLayout1"

// The same members in the same order, written or read.
template <typename Stream, typename L>
void fields(Stream& stream, L& layout) {
  stream(layout.side);
  stream(layout.maps);
  stream(layout.charts);
  stream.list(layout.objects, [](auto& s, auto& triangles) { s(triangles); });
}

bool isSound(const TrianglePlace& place, const Layout& layout) {
  if (place.map == TrianglePlace::kNowhere) return true;
  if (place.map < 0 || place.map >= layout.maps) return false;
  if (place.chart >= static_cast<std::uint32_t>(layout.charts)) return false;
  const auto most = static_cast<float>(layout.side);
  for (const vec2 p : place.corners)
    if (!(p.x >= 0.f && p.y >= 0.f && p.x <= most && p.y <= most)) return false;
  return true;
}

bool isSound(const Layout& layout) {
  constexpr int kMostSide = 32768, kMostMaps = 65536;
  if (layout.side < 1 || layout.side > kMostSide || layout.maps < 0 || layout.maps > kMostMaps ||
      layout.charts < 0)
    return false;
  for (const auto& triangles : layout.objects)
    for (const TrianglePlace& place : triangles)
      if (!isSound(place, layout)) return false;
  return true;
}

}  // namespace

Bytes toBytes(const Layout& layout) {
  ByteWriter writer;
  writer(kMagic);
  fields(writer, layout);
  return std::move(writer.bytes);
}

Result<Layout> layoutFrom(std::span<const std::byte> bytes, const std::string& name) {
  ByteReader reader(bytes);
  std::uint64_t magic = 0;
  reader(magic);
  if (magic != kMagic)
    return error(ErrorKind::Input, "{}: found no lightmap layout; bake the scene again", name);
  Layout layout;
  fields(reader, layout);
  if (!reader.good() || !reader.atEnd() || !isSound(layout))
    return error(ErrorKind::Input, "{}: the layout is damaged; bake the scene again", name);
  return layout;
}

Status checkFits(const Layout& layout, const scene::Scene& scene) {
  if (layout.objects.size() != scene.objects.size())
    return error(ErrorKind::Input,
                 "the lightmap is of a scene of {} objects, found {} in '{}'; bake it again",
                 layout.objects.size(), scene.objects.size(), scene.name);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::size_t found = scene.meshes[scene.objects[i].mesh].triangleCount();
    const std::size_t wanted = layout.objects[i].size();
    if (wanted != 0 && wanted != found)
      return error(
          ErrorKind::Input,
          "the lightmap knows object {} of '{}' with {} triangles, found {}; bake it again", i,
          scene.name, wanted, found);
  }
  return {};
}

}  // namespace lucerna::lightmap

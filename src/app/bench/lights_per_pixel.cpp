#include "app/bench/lights_per_pixel.hpp"

#include <algorithm>

#include "trace/light_sampling.hpp"
#include "trace/ray_scene.hpp"

namespace lucerna::app::bench {
namespace {

// Through the pixels' centres.
std::vector<trace::Ray> raysThrough(const scene::View& view, uvec2 size) {
  const mat4 worldFromClip = glm::inverse(view.clipFromWorld());
  std::vector<trace::Ray> rays;
  for (std::uint32_t y = 0; y < size.y; ++y)
    for (std::uint32_t x = 0; x < size.x; ++x) {
      const vec2 share = (vec2(x, y) + 0.5f) / vec2(size);
      const vec4 nearW = worldFromClip * vec4(2.f * share.x - 1.f, 1.f - 2.f * share.y, 1.f, 1.f);
      const vec3 startW = vec3(nearW) / nearW.w;
      const vec3 originW = view.orthographic ? startW : view.positionW();
      rays.push_back({.originW = originW,
                      .directionW = view.orthographic ? -vec3(view.worldFromView[2])
                                                      : glm::normalize(startW - originW)});
    }
  return rays;
}

bool reaches(const scene::PlacedLight& light, const trace::SurfacePoint& point) {
  const trace::LightSample centre = trace::lightCentre(light, point.positionW);
  return centre.irradiance != vec3(0.f) && glm::dot(centre.toLightW, point.normalW) > 0.f;
}

}  // namespace

std::vector<double> lightsPerPixel(const scene::Scene& scene, const scene::View& view, uvec2 size) {
  const trace::RayScene surfaces(scene, view.viewFromWorld);
  const std::vector<trace::Ray> rays = raysThrough(view, size);
  std::vector<trace::Hit> hits(rays.size());
  surfaces.closest(rays, hits);
  const std::vector<scene::PlacedLight> lights = scene::placeLights(scene);
  std::vector<double> counts;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].any()) continue;
    const trace::SurfacePoint point = surfaces.lookup().at(hits[i].spot, rays[i].directionW);
    counts.push_back(static_cast<double>(
        std::ranges::count_if(lights, [&](const auto& light) { return reaches(light, point); })));
  }
  return counts;
}

}  // namespace lucerna::app::bench

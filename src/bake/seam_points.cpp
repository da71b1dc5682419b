#include "bake/seam_points.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace lucerna::bake {
namespace {

// Of a seam; a lookup's course along it bends once or twice a texel.
constexpr float kPerTexel = 4.f;

std::vector<SeamPoint> pointsAlong(std::span<const Seam> seams, int extra) {
  std::vector<SeamPoint> points;
  for (std::uint32_t i = 0; i < seams.size(); ++i) {
    const float length = seams[i].length();
    const int count = std::max(static_cast<int>(std::ceil(length * kPerTexel)), 1) + extra;
    for (int k = 0; k < count; ++k)
      points.push_back({.seam = i,
                        .along = (static_cast<float>(k) + 0.5f) / static_cast<float>(count),
                        .share = length / static_cast<float>(count)});
  }
  return points;
}

void setRay(ShadowRays& rays, std::size_t i, const Seam& seam, float along) {
  const vec3 p = glm::mix(seam.endsW[0], seam.endsW[1], along);
  const vec3 from = p + seam.sides[0].offW, to = p + seam.sides[1].offW;
  rays.fromX[i] = from.x, rays.fromY[i] = from.y, rays.fromZ[i] = from.z;
  rays.toX[i] = to.x, rays.toY[i] = to.y, rays.toZ[i] = to.z;
}

}  // namespace

std::vector<SeamPoint> seamPoints(std::span<const Seam> seams, int extra,
                                  const ShadowTracer& tracer) {
  std::vector<SeamPoint> points = pointsAlong(seams, extra);
  constexpr std::size_t kGrain = 4096;
  std::vector<vec3> shares(points.size());
  parallelFor(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    ShadowRays rays;
    rays.resize(end - begin);
    for (std::size_t i = begin; i < end; ++i)
      setRay(rays, i - begin, seams[points[i].seam], points[i].along);
    tracer.trace(rays, std::span(shares).subspan(begin, end - begin));
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (shares[i] == vec3(1.f)) points[kept++] = points[i];
  points.resize(kept);
  return points;
}

}  // namespace lucerna::bake

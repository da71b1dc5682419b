#include "bake/brute_force.hpp"

#include <cmath>

#include "bake/triangle.hpp"
#include "trace/light_sampling.hpp"
#include "trace/low_discrepancy.hpp"

namespace lucerna::bake::testing {

using trace::Ray;

BruteForce::BruteForce(const Plan& plan) : plan_(plan), rays_(*plan.world.scene, mat4(1.f)) {
  if (!plan.emittersShine()) return;
  const World& world = plan.world;
  for (const WorldObject& object : world.objects) {
    const scene::Material& material =
        world.scene->materials[world.scene->objects[object.object].material];
    if (material.emissive == vec3(0.f)) continue;
    const auto indices = world.indicesOf(object);
    for (std::uint32_t t = 0; t < object.triangleCount; ++t) {
      Emitter emitter{.object = object.object,
                      .triangle = t,
                      .corners = {},
                      .doubleSided = material.doubleSided};
      for (std::uint32_t k = 0; k < 3; ++k)
        emitter.corners[k] = world.positions[indices[3 * t + k]];
      const TriangleShape shape = shapeOf(emitter.corners);
      emitter.normalW = object.mirrored ? -shape.normal : shape.normal;
      emitter.area = shape.area;
      if (shape.area > 0.f) emitters_.push_back(emitter);
    }
  }
}

std::vector<BruteForce::Place> BruteForce::placesOn(std::uint32_t at, ivec2 texel,
                                                    std::uint32_t samples) const {
  const Chart& chart = plan_.charts.charts[at];
  const WorldObject& object = plan_.world.objects[chart.object];
  const auto indices = plan_.world.indicesOf(object);
  std::vector<Place> places;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const vec2 p = vec2(texel) + trace::lowDiscrepancyPoint(i, 77);
    for (std::size_t t = 0; t < chart.corners.size(); ++t) {
      const auto& c = chart.corners[t];
      const glm::dvec2 a(c[0]), b = glm::dvec2(c[1]) - a, d = glm::dvec2(c[2]) - a,
                                q = glm::dvec2(p) - a;
      const double area2 = b.x * d.y - b.y * d.x;
      const double v = (q.x * d.y - q.y * d.x) / area2, w = (b.x * q.y - b.y * q.x) / area2;
      if (!(v >= 0. && w >= 0. && v + w <= 1.)) continue;
      const vec3 weights(static_cast<float>(1. - v - w), static_cast<float>(v),
                         static_cast<float>(w));
      Place place;
      std::array<vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = indices[3 * std::size_t{chart.triangles[t]} + k];
        corners[k] = plan_.world.positions[vertex];
        place.positionW += weights[static_cast<int>(k)] * corners[k];
        place.normalW += weights[static_cast<int>(k)] * plan_.world.normals[vertex];
      }
      const vec3 flat = (object.mirrored ? -1.f : 1.f) * shapeOf(corners).normal;
      place.positionW += flat * liftAt(place.positionW);
      place.normalW = glm::length(place.normalW) > 1e-3f ? glm::normalize(place.normalW) : flat;
      places.push_back(place);
      break;
    }
  }
  return places;
}

vec3 BruteForce::traced(const std::vector<Ray>& rays, const std::vector<vec3>& values) const {
  std::vector<vec3> shares(rays.size());
  rays_.transmittance(rays, shares);
  glm::dvec3 sum(0.);
  for (std::size_t i = 0; i < rays.size(); ++i) sum += glm::dvec3(values[i] * shares[i]);
  return vec3(sum);
}

vec3 BruteForce::sumOf(const std::vector<Place>& places, const scene::PlacedLight& light,
                       std::uint32_t seed) const {
  std::vector<Ray> rays;
  std::vector<vec3> values;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    if (!trace::mayLight(light, place.positionW, place.normalW)) continue;
    const trace::LightSample sample =
        trace::sampleLight(light, place.positionW, trace::lowDiscrepancyPoint(i, seed));
    const float cosine = glm::dot(place.normalW, sample.toLightW);
    if (cosine <= 0.f || sample.irradiance == vec3(0.f)) continue;
    rays.push_back({.originW = place.positionW,
                    .directionW = sample.toLightW,
                    .far = sample.distance * (1.f - 0x1p-12f)});
    values.push_back(sample.irradiance * cosine);
  }
  return traced(rays, values);
}

vec3 BruteForce::sumOf(const std::vector<Place>& places, const Emitter& emitter,
                       std::uint32_t seed) const {
  std::vector<Ray> rays;
  std::vector<vec3> values;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    vec2 u = trace::lowDiscrepancyPoint(i, seed);
    const float root = std::sqrt(u.x);
    const vec2 barycentric(root * (1.f - u.y), root * u.y);
    const auto& c = emitter.corners;
    const vec3 from = c[0] + barycentric.x * (c[1] - c[0]) + barycentric.y * (c[2] - c[0]);
    const vec3 to = from - place.positionW;
    const float receiving = glm::dot(to, place.normalW), sending = -glm::dot(to, emitter.normalW);
    if (receiving <= 0.f || (emitter.doubleSided ? sending == 0.f : sending <= 0.f)) continue;
    const trace::Spot spot{
        .object = emitter.object, .triangle = emitter.triangle, .barycentric = barycentric};
    const vec3 radiance = rays_.lookup().at(spot, to).emissive;
    if (radiance == vec3(0.f)) continue;
    const float d2 = glm::dot(to, to);
    rays.push_back({.originW = place.positionW, .directionW = to, .far = 1.f - 0x1p-12f});
    values.push_back(radiance * (emitter.area * receiving * std::abs(sending) / (d2 * d2)));
  }
  return traced(rays, values);
}

vec3 BruteForce::irradiance(std::uint32_t chart, ivec2 texel, std::uint32_t samples) const {
  const std::vector<Place> places = placesOn(chart, texel, samples);
  if (places.empty()) return vec3(0.f);
  vec3 sum(0.f);
  std::uint32_t seed = 1000;
  for (const LightGroup& group : plan_.groups)
    for (const scene::PlacedLight& light : group.lights) sum += sumOf(places, light, ++seed);
  for (const Emitter& emitter : emitters_) sum += sumOf(places, emitter, ++seed);
  return sum / static_cast<float>(places.size());
}

}  // namespace lucerna::bake::testing

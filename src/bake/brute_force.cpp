#include "bake/brute_force.hpp"

#include <cmath>

#include "bake/triangle.hpp"
#include "core/check.hpp"
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
      if (shape.area > 0.f) emitters_.push_back(emitter);
    }
  }
}

std::vector<BruteForce::Place> BruteForce::placesOn(std::uint32_t at, ivec2 texel,
                                                    const Effort& effort) const {
  const Chart& chart = plan_.charts.charts[at];
  const WorldObject& object = plan_.world.objects[chart.object];
  const auto indices = plan_.world.indicesOf(object);
  std::vector<Place> places;
  for (std::uint32_t i = 0; i < effort.places; ++i) {
    const vec2 p = vec2(texel) + trace::lowDiscrepancyPoint(i, 77 + effort.seed);
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

void BruteForce::Rays::add(const Place& place, vec3 direction, float far, vec3 value) {
  rays.push_back({.originW = place.positionW, .directionW = direction, .far = far});
  values.push_back(value);
}

void BruteForce::trace(Rays& rays) const {
  std::vector<vec3> shares(rays.rays.size());
  rays_.transmittance(rays.rays, shares);
  for (std::size_t i = 0; i < shares.size(); ++i)
    rays.sum += glm::dvec3(rays.values[i] * shares[i]);
  rays.rays.clear();
  rays.values.clear();
}

// By points of the sequence from `first` on.
void BruteForce::add(Rays& rays, const Place& place, const scene::PlacedLight& light,
                     std::uint32_t first, std::uint32_t points, std::uint32_t seed) const {
  if (!trace::mayLight(light, place.positionW, place.normalW)) return;
  for (std::uint32_t i = first; i < first + points; ++i) {
    const trace::LightSample sample =
        trace::sampleLight(light, place.positionW, trace::lowDiscrepancyPoint(i, seed));
    const float cosine = glm::dot(place.normalW, sample.toLightW);
    if (cosine <= 0.f || sample.irradiance == vec3(0.f)) continue;
    rays.add(place, sample.toLightW, sample.distance * (1.f - 0x1p-12f),
             sample.irradiance * (cosine / static_cast<float>(points)));
  }
}

namespace {

// A part of a triangle by the barycentric coordinates of its corners.
using Piece = std::array<vec2, 3>;

vec3 pointOn(const std::array<vec3, 3>& c, vec2 barycentric) {
  return c[0] + barycentric.x * (c[1] - c[0]) + barycentric.y * (c[2] - c[0]);
}

// Cuts it until all pieces are small enough for their distance to the point.
void cut(std::vector<Piece>& pieces, const std::array<vec3, 3>& triangle, const Piece& piece,
         vec3 point, float share, int depth) {
  const vec3 a = pointOn(triangle, piece[0]), b = pointOn(triangle, piece[1]),
             c = pointOn(triangle, piece[2]);
  const float size = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  // No corner is nearer than the nearest point by more than the size.
  const float distance =
      std::min({glm::distance(a, point), glm::distance(b, point), glm::distance(c, point)}) -
      0.6f * size;
  if (depth == 0 || size <= share * distance) {
    pieces.push_back(piece);
    return;
  }
  const vec2 ab = 0.5f * (piece[0] + piece[1]), bc = 0.5f * (piece[1] + piece[2]),
             ca = 0.5f * (piece[2] + piece[0]);
  for (const Piece& part : {Piece{piece[0], ab, ca}, Piece{ab, piece[1], bc},
                            Piece{ca, bc, piece[2]}, Piece{ab, bc, ca}})
    cut(pieces, triangle, part, point, share, depth - 1);
}

}  // namespace

void BruteForce::add(Rays& rays, const std::vector<Place>& places, const Emitter& emitter,
                     const Effort& effort, std::uint32_t seed) const {
  constexpr int kDepth = 12;
  constexpr std::uint32_t kFewest = 32;
  const auto count = static_cast<std::uint32_t>(places.size());
  const auto& c = emitter.corners;
  const float size =
      std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
  const float distance = glm::distance((c[0] + c[1] + c[2]) / 3.f, places[0].positionW);
  // Neighbours in the list are spread over the texel.
  std::uint32_t asked = count;
  for (float share = effort.pieceSize; asked / 2 >= kFewest && size < 0.25f * share * distance;
       share *= 0.5f)
    asked /= 2;
  const std::uint32_t first = trace::mixed(seed, 3) % count;
  std::vector<Piece> pieces;
  for (std::uint32_t k = 0; k < asked; ++k) {
    const Place& place = places[(first + k) % count];
    const auto height = [&](vec3 corner) {
      return glm::dot(corner - place.positionW, place.normalW);
    };
    if (std::max({height(c[0]), height(c[1]), height(c[2])}) <= 0.f) continue;
    if (!emitter.doubleSided && glm::dot(c[0] - place.positionW, emitter.normalW) >= 0.f) continue;
    pieces.clear();
    cut(pieces, c, {vec2(0, 0), vec2(1, 0), vec2(0, 1)}, place.positionW, effort.pieceSize, kDepth);
    const float wholeArea = 0.5f * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
    for (std::uint32_t p = 0; p < pieces.size(); ++p) {
      const vec2 u = trace::lowDiscrepancyPoint(k, trace::mixed(seed, 16 + p));
      const float root = std::sqrt(u.x);
      const Piece& piece = pieces[p];
      const vec2 b = piece[0] + root * (1.f - u.y) * (piece[1] - piece[0]) +
                     root * u.y * (piece[2] - piece[0]);
      const vec2 e = piece[1] - piece[0], f = piece[2] - piece[0];
      const vec3 to = pointOn(c, b) - place.positionW;
      const float receiving = glm::dot(to, place.normalW), sending = -glm::dot(to, emitter.normalW);
      if (receiving <= 0.f) continue;
      const vec3 radiance =
          rays_.lookup()
              .at({.object = emitter.object, .triangle = emitter.triangle, .barycentric = b}, to)
              .emissive;
      if (radiance == vec3(0.f)) continue;
      const float d2 = glm::dot(to, to), area = wholeArea * std::abs(e.x * f.y - e.y * f.x);
      rays.add(place, to, 1.f - 0x1p-12f,
               radiance * (area * receiving * std::abs(sending) / (d2 * d2) *
                           static_cast<float>(count) / static_cast<float>(asked)));
    }
  }
}

vec3 BruteForce::irradiance(std::uint32_t chart, ivec2 texel, const Effort& effort) const {
  constexpr std::size_t kMostRays = 1 << 14;
  const std::vector<Place> places = placesOn(chart, texel, effort);
  if (places.empty()) return vec3(0.f);
  Rays rays;
  std::uint32_t seed = 1000 + (effort.seed << 20);
  for (const LightGroup& group : plan_.groups)
    for (const scene::PlacedLight& light : group.lights) {
      const bool sized = light.radius > 0.f || light.angle > 0.f;
      const std::uint32_t points = sized ? effort.points : 1;
      ++seed;
      for (std::uint32_t i = 0; i < places.size(); ++i) {
        add(rays, places[i], light, i * points, points, seed);
        if (rays.rays.size() >= kMostRays) trace(rays);
      }
    }
  for (const Emitter& emitter : emitters_) {
    add(rays, places, emitter, effort, ++seed);
    if (rays.rays.size() >= kMostRays) trace(rays);
  }
  trace(rays);
  return vec3(rays.sum / static_cast<double>(places.size()));
}

}  // namespace lucerna::bake::testing

#include "trace/tile_tracer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "trace/light_sampling.hpp"
#include "trace/low_discrepancy.hpp"
#include "trace/reflectance.hpp"
#include "trace/texture_reader.hpp"

namespace lucerna::trace {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr int kMostLayers = 64;  // translucent or turned-away surfaces that a ray passes

// Purposes of random numbers; lights follow.
enum : std::uint32_t { kPixel, kLens, kOcclusion, kBounce, kFirstLight };

// Clear of the surface that a ray starts on, by some rounding errors of its place.
vec3 offset(vec3 positionW, vec3 normalW) {
  const vec3 size = glm::abs(positionW);
  return positionW + normalW * (std::max({size.x, size.y, size.z, 0.1f}) * 0x1p-16f);
}

// On the side of the surface that the direction leaves to.
vec3 originOf(const SurfacePoint& point, vec3 directionW) {
  const bool seenSide = glm::dot(point.geometricNormalW, directionW) >= 0.f;
  return offset(point.positionW, seenSide ? point.geometricNormalW : -point.geometricNormalW);
}

}  // namespace

TracedScene::TracedScene(const scene::Scene& s, const ReferenceSettings& chosen)
    : scene(s),
      settings(chosen),
      rays(s, chosen.view.viewFromWorld),
      lights(placeLights(s)),
      ambient(s.ambient),
      viewFromClip(glm::inverse(chosen.view.clipFromView)) {
  for (const scene::PlacedLight& light : lights) ambient += light.ambient;
}

std::vector<ivec2> packedPixels(ivec2 first, ivec2 end) {
  std::vector<ivec2> pixels;
  for (int by = first.y; by < end.y; by += 4)
    for (int bx = first.x; bx < end.x; bx += 4)
      for (int y = by; y < std::min(by + 4, end.y); ++y)
        for (int x = bx; x < std::min(bx + 4, end.x); ++x) pixels.emplace_back(x, y);
  return pixels;
}

TileTracer::TileTracer(const TracedScene& traced) : traced_(traced) {}

void TileTracer::trace(std::span<const ivec2> pixels, std::uint32_t index,
                       std::span<PixelSample> samples, std::span<float> visibility) {
  pixels_ = pixels;
  index_ = index;
  samples_ = samples;
  visibility_ = visibility;
  generate();
  while (!paths_.empty()) {
    follow();
    lit_.clear();
    nextPaths_.clear();
    nextRays_.clear();
    nextPassed_.clear();
    for (std::size_t i = 0; i < paths_.size(); ++i) meet(paths_[i], rays_[i], passed_[i], hits_[i]);
    light();
    std::swap(paths_, nextPaths_);
    std::swap(rays_, nextRays_);
    std::swap(passed_, nextPassed_);
  }
}

vec2 TileTracer::random(const Path& path, std::uint32_t purpose) const {
  const ivec2 pixel = pixels_[path.pixel];
  const auto seed = traced_.settings.seed;
  std::uint32_t hash =
      mixed(static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32));
  for (const int value : {pixel.x, pixel.y, static_cast<int>(path.depth)})
    hash = mixed(hash, static_cast<std::uint32_t>(value));
  return lowDiscrepancyPoint(index_, mixed(hash, purpose));
}

// Rays of the camera. t counts metres along the view axis, so that near and far planes are its
// bounds.
void TileTracer::generate() {
  const ReferenceSettings& s = traced_.settings;
  const mat4& worldFromView = s.view.worldFromView;
  paths_.clear();
  rays_.clear();
  for (std::uint32_t i = 0; i < pixels_.size(); ++i) {
    const Path path{.pixel = i};
    const vec2 within = s.primary == Primary::Centre ? vec2(0.5f) : random(path, kPixel);
    const vec2 share = (vec2(pixels_[i]) + within) / vec2(s.size);
    const vec4 homogeneous =
        traced_.viewFromClip * vec4(2.f * share.x - 1.f, 1.f - 2.f * share.y, 1.f, 1.f);
    const vec3 onNear = vec3(homogeneous) / homogeneous.w;
    vec3 originV(0.f), directionV(0.f, 0.f, -1.f);
    if (s.view.orthographic)
      originV = {onNear.x, onNear.y, 0.f};
    else
      directionV = onNear / -onNear.z;
    if (s.lensRadius > 0.f) {
      const vec3 sharp = originV + directionV * s.focusDistance;
      originV += vec3(s.lensRadius * discPoint(random(path, kLens)), 0.f);
      directionV = (sharp - originV) / s.focusDistance;
    }
    paths_.push_back(path);
    rays_.push_back({.originW = vec3(worldFromView * vec4(originV, 1.f)),
                     .near = s.view.near,
                     .directionW = mat3(worldFromView) * directionV,
                     .far = s.view.far});
  }
  passed_.assign(paths_.size(), {});
}

void TileTracer::add(const Path& path, vec3 radiance, bool direct) {
  const vec3 value = path.throughput * radiance;
  PixelSample& sample = samples_[path.pixel];
  sample.color += value;
  if (path.mirrors > 0) sample.reflection += value;
  if (direct && path.mirrors == 0 && path.bounces == 0) sample.direct += value;
}

void TileTracer::missed(const Path& path, vec3 directionW) {
  if (path.bounces > 0) return add(path, traced_.ambient, false);
  const scene::Background& background = traced_.scene.background;
  switch (background.kind) {
    case scene::BackgroundKind::Color:
      return add(path, background.color, false);
    case scene::BackgroundKind::Image: {
      const vec2 uv = (vec2(pixels_[path.pixel]) + 0.5f) / vec2(traced_.settings.size);
      const scene::Texture& texture = traced_.scene.textures[background.texture];
      return add(path, background.intensity * vec3(colorAt(texture, uv)), false);
    }
    case scene::BackgroundKind::CubeMap: {
      const scene::Texture& texture = traced_.scene.textures[background.texture];
      return add(path, background.intensity * vec3(cubeColorAt(texture, directionW)), false);
    }
  }
}

void TileTracer::continueFrom(const SurfacePoint& point, Path path, vec3 directionW) {
  ++path.depth;
  nextPaths_.push_back(path);
  nextRays_.push_back({.originW = originOf(point, directionW), .directionW = directionW});
  nextPassed_.emplace_back();
}

void TileTracer::meet(const Path& path, const Ray& ray, const Passed& passed, const Hit& hit) {
  if (!hit.any()) return missed(path, ray.directionW);
  const MaterialLookup& lookup = traced_.rays.lookup();
  const scene::Material& material = lookup.materialOf(hit.spot.object);
  const auto goOn = [&](vec3 share) {
    if (share == vec3(0.f) || path.depth >= kMostLayers) return;
    Path behind = path;
    behind.throughput *= share;
    ++behind.depth;
    nextPaths_.push_back(behind);
    nextRays_.push_back(ray);
    nextPassed_.push_back(passed);
    nextRays_.back().near = nextPassed_.back().pass(hit);
  };
  if (!material.doubleSided && !lookup.frontFacing(hit.spot, ray.directionW))
    return goOn(vec3(1.f));

  Lit lit{.point = lookup.at(hit.spot, ray.directionW), .path = path};
  if (material.alphaMode == scene::AlphaMode::Blend) {
    goOn(scene::transmittance(lit.point.opacity, material.transmission));
    lit.path.throughput *= lit.point.opacity;
    lit.path.first = false;  // what is looked for stands behind
  }
  const ReferenceSettings& s = traced_.settings;
  if (isMirror(material) && path.mirrors < s.mirrors) {
    Path mirrored = path;
    mirrored.throughput *= material.reflectivity;
    mirrored.first = false;
    ++mirrored.mirrors;
    continueFrom(lit.point, mirrored, glm::reflect(-lit.point.toEyeW, lit.point.geometricNormalW));
    lit.path.throughput *= 1.f - material.reflectivity;
  }
  if (lit.point.unlit) {
    add(lit.path, lit.point.albedo, false);
    return;
  }
  add(lit.path, lit.point.emissive, false);
  lit_.push_back(lit);
}

// What all surfaces of this round get: lights one by one, then what is around them.
void TileTracer::light() {
  for (std::uint32_t i = 0; i < traced_.lights.size(); ++i) lightBy(i);
  occlude();
}

void TileTracer::lightBy(std::uint32_t index) {
  const scene::PlacedLight& light = traced_.lights[index];
  const bool ofPoint = traced_.settings.shading == Shading::Point;
  values_.clear();
  probes_.clear();
  for (std::uint32_t i = 0; i < lit_.size(); ++i) {
    const auto& [point, path] = lit_[i];
    if (!mayLight(light, point.positionW, point.normalW)) continue;
    const LightSample sample =
        sampleLight(light, point.positionW, random(path, kFirstLight + index));
    const LightSample shaded = ofPoint ? lightCentre(light, point.positionW) : sample;
    if (glm::dot(point.normalW, shaded.toLightW) <= 0.f || shaded.irradiance == vec3(0.f)) continue;
    values_.push_back({i, reflected(point, shaded.toLightW) * shaded.irradiance});
    const vec3 originW = originOf(point, sample.toLightW);
    probes_.push_back({.originW = originW,
                       .directionW = sample.toLightW,
                       .far = sample.distance * (1.f - 0x1p-12f)});
  }
  followProbes(traced_.settings.shadows);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Path& path = lit_[values_[i].lit].path;
    add(path, values_[i].value * shares_[i], true);
    if (path.first && !visibility_.empty())
      visibility_[index * pixels_.size() + path.pixel] +=
          (shares_[i].x + shares_[i].y + shares_[i].z) / 3.f;
  }
}

void TileTracer::follow() {
  if (traced_.observe) traced_.observe(rays_, RayKind::Closest);
  const auto start = Clock::now();
  hits_.resize(rays_.size());
  const bool allFresh = std::ranges::none_of(passed_, &Passed::any);
  traced_.rays.closest(rays_, hits_, allFresh ? std::span<const Passed>() : passed_);
  statistics_.closest += rays_.size();
  statistics_.seconds += secondsSince(start);
}

void TileTracer::followProbes(bool occluded) {
  shares_.assign(probes_.size(), vec3(1.f));
  if (!occluded || probes_.empty()) return;
  if (traced_.observe) traced_.observe(probes_, RayKind::Occlusion);
  const auto start = Clock::now();
  traced_.rays.transmittance(probes_, shares_);
  statistics_.occlusion += probes_.size();
  statistics_.seconds += secondsSince(start);
}

// Ambient light, whole or as far as nothing is in its way, or bounced light in its place.
void TileTracer::occlude() {
  const ReferenceSettings& s = traced_.settings;
  values_.clear();
  probes_.clear();
  for (std::uint32_t i = 0; i < lit_.size(); ++i) {
    const auto& [point, path] = lit_[i];
    const Frame frame(point.normalW);
    const bool gathers = path.bounces < s.bounces;
    if (gathers) {
      Path bounced = path;
      ++bounced.bounces;
      bounced.first = false;
      bounced.throughput *= diffuseAlbedo(point);
      const vec3 directionW = frame.toWorld(cosineDirection(random(path, kBounce)));
      if (bounced.throughput != vec3(0.f)) continueFrom(point, bounced, directionW);
      if (s.aoRadius <= 0.f) continue;
    }
    const vec3 value =
        gathers ? vec3(0.f) : traced_.ambient * ambientAlbedo(point) * point.occlusion;
    if (s.aoRadius <= 0.f) {
      add(path, value, false);
      continue;
    }
    const vec3 directionW = frame.toWorld(cosineDirection(random(path, kOcclusion)));
    values_.push_back({i, value});
    probes_.push_back(
        {.originW = originOf(point, directionW), .directionW = directionW, .far = s.aoRadius});
  }
  followProbes(true);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Path& path = lit_[values_[i].lit].path;
    add(path, values_[i].value * shares_[i], false);
    if (path.first) samples_[path.pixel].ao = (shares_[i].x + shares_[i].y + shares_[i].z) / 3.f;
  }
}

}  // namespace lucerna::trace

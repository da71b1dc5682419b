#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "bake/holes.hpp"
#include "bake/overlap.hpp"
#include "bake/shadow_tracer.hpp"
#include "core/check.hpp"
#include "trace/material_lookup.hpp"

namespace lucerna::bake {
namespace {

constexpr std::size_t kPacket = 16;

// What filters find behind Embree's context.
struct Context {
  explicit Context(const trace::MaterialLookup& asked) : lookup(asked) {
    rtcInitIntersectContext(&embree);
  }
  RTCIntersectContext embree;  // first: Embree hands out its address
  const trace::MaterialLookup& lookup;
  // Of the packet under way, one a lane. For lanes without a ray as well: Embree 3.13.5 asks about
  // some of them.
  std::array<vec3, kPacket> through;
};

// What a ray meets of a geometry whose user data are its triangles.
trace::Spot spotOf(const RTCFilterFunctionNArguments& args, unsigned lane) {
  trace::Spot spot =
      static_cast<const trace::Spot*>(args.geometryUserPtr)[RTCHitN_primID(args.hit, args.N, lane)];
  spot.barycentric = {RTCHitN_u(args.hit, args.N, lane), RTCHitN_v(args.hit, args.N, lane)};
  return spot;
}

// Of alpha-tested triangles, whose user data are their holes: lets rays through those, however
// often it is asked.
void passHoles(const RTCFilterFunctionNArguments* args) {
  const Holes& holes = *static_cast<const Holes*>(args->geometryUserPtr);
  for (unsigned lane = 0; lane < args->N; ++lane)
    if (args->valid[lane] == -1 &&
        holes.at(RTCHitN_primID(args->hit, args->N, lane),
                 {RTCHitN_u(args->hit, args->N, lane), RTCHitN_v(args->hit, args->N, lane)}))
      args->valid[lane] = 0;
}

// Of translucent ones, each of which must be shown once to a ray. Packets that are marked as
// coherent show some twice (Embree 3.13.5), and so may scenes of high build quality, which split
// triangles.
void takeLight(const RTCFilterFunctionNArguments* args) {
  Context& context = *reinterpret_cast<Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] != -1) continue;
    const vec3 toLightW(RTCRayN_dir_x(args->ray, args->N, lane),
                        RTCRayN_dir_y(args->ray, args->N, lane),
                        RTCRayN_dir_z(args->ray, args->N, lane));
    vec3& share = context.through[RTCRayN_id(args->ray, args->N, lane)];
    share *= trace::shareThrough(context.lookup, spotOf(*args, lane), toLightW);
    if (share != vec3(0.f)) args->valid[lane] = 0;
  }
}

// Sixteen rays as Embree reads them, from samples to lights: what is near a ray's start is met
// where it is, and most of what decides is near samples. From lights, and without robust mode, one
// in a thousand rays of the night city slips through somewhere.
struct Packet {
  Packet() {
    for (unsigned i = 0; i < kPacket; ++i) {
      rays.time[i] = 0.f;
      rays.mask[i] = ~0u;
      rays.id[i] = i;
      rays.flags[i] = 0;
    }
  }

  // Rays of the list from `first` on, into all lanes: there are as many.
  void setAll(const ShadowRays& list, std::size_t first) {
    const auto set = [first](const auto& light, const auto& sample, float* origin, float* way) {
      const float *start = &sample[first], *end = &light[first];
      for (std::size_t i = 0; i < kPacket; ++i) origin[i] = start[i];
      for (std::size_t i = 0; i < kPacket; ++i) way[i] = end[i] - start[i];
    };
    set(list.fromX, list.toX, rays.org_x, rays.dir_x);
    set(list.fromY, list.toY, rays.org_y, rays.dir_y);
    set(list.fromZ, list.toZ, rays.org_z, rays.dir_z);
  }
  void set(std::size_t lane, const ShadowRays& list, std::size_t at) {
    rays.org_x[lane] = list.toX[at];
    rays.org_y[lane] = list.toY[at];
    rays.org_z[lane] = list.toZ[at];
    rays.dir_x[lane] = list.fromX[at] - list.toX[at];
    rays.dir_y[lane] = list.fromY[at] - list.toY[at];
    rays.dir_z[lane] = list.fromZ[at] - list.toZ[at];
  }
  // Lanes of [begin, end) take part.
  void start(std::size_t begin, std::size_t end) {
    for (std::size_t i = 0; i < kPacket; ++i)
      rays.tnear[i] = clearOfSample({rays.org_x[i], rays.org_y[i], rays.org_z[i]},
                                    {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]});
    std::ranges::fill(rays.tfar, 1.f - kClearOfLight);
    for (std::size_t i = 0; i < kPacket; ++i) valid[i] = i >= begin && i < end ? -1 : 0;
  }
  // Of the lanes that took part those that nothing was in the way of take part again. Whether any.
  bool restart() {
    int any = 0;
    for (std::size_t i = 0; i < kPacket; ++i) any |= valid[i] &= isBlocked(i) ? 0 : -1;
    return any != 0;
  }
  // Below 0: Embree's mark of what is in the way.
  bool isBlocked(std::size_t lane) const { return rays.tfar[lane] < 0.f; }

  alignas(64) RTCRay16 rays{};
  alignas(64) std::array<int, kPacket> valid{};
};

RTCDevice newDevice() {
  RTCDevice device = rtcNewDevice((std::string("isa=") + rayInstructionSet()).c_str());
  CHECK(device, "Embree makes no device (error {})", static_cast<int>(rtcGetDeviceError(nullptr)));
  return device;
}

// Rays are followed in coherent packets: first past all that lets light through by holes or not at
// all; those that came through are then asked whether anything translucent is in the way, and only
// those for which there is, what it takes. The first scene is not robust, as this costs a sixth:
// overlapping triangles let nothing through either. Splitting them does no harm.
class EmbreeTracer final : public ShadowTracer {
 public:
  explicit EmbreeTracer(const World& world)
      : world_(world),
        lookup_(*world.scene, mat4(1.f)),
        device_(newDevice()),
        solidScene_(rtcNewScene(device_)),
        translucentScene_(rtcNewScene(device_)),
        holes_(lookup_, *world.scene, spotsOf(trianglesOf(scene::AlphaMode::Mask))),
        translucent_(spotsOf(trianglesOf(scene::AlphaMode::Blend))) {
    rtcSetSceneBuildQuality(solidScene_, RTC_BUILD_QUALITY_HIGH);
    attach(solidScene_, overlapping(world, trianglesOf(scene::AlphaMode::Opaque)));
    attach(solidScene_, overlapping(world, trianglesOf(scene::AlphaMode::Mask)), passHoles,
           &holes_);
    rtcCommitScene(solidScene_);
    rtcSetSceneFlags(translucentScene_,
                     RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    attach(translucentScene_, cornersOf(trianglesOf(scene::AlphaMode::Blend)), nullptr,
           translucent_.data());
    rtcCommitScene(translucentScene_);
  }
  ~EmbreeTracer() override {
    rtcReleaseScene(solidScene_);
    rtcReleaseScene(translucentScene_);
    rtcReleaseDevice(device_);
  }
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  void trace(const ShadowRays& rays, std::span<vec3> shares) const override {
    CHECK(rays.size() == shares.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    Packet packet;
    std::vector<std::size_t> behind;  // rays with something translucent in the way
    for (std::size_t done = 0; done < rays.size(); done += kPacket) {
      const std::size_t count = std::min(kPacket, rays.size() - done);
      // The last packet has some of the rays of the one before, which take part in nothing.
      const std::size_t begin = rays.size() >= kPacket ? kPacket - count : 0;
      const std::size_t first = done - begin;
      if (rays.size() >= kPacket)
        packet.setAll(rays, first);
      else
        for (std::size_t i = 0; i < kPacket; ++i) packet.set(i, rays, std::min(i, count - 1));
      packet.start(begin, begin + count);
      rtcOccluded16(packet.valid.data(), solidScene_, &context, &packet.rays);
      for (std::size_t i = begin; i < begin + count; ++i)
        shares[first + i] = vec3(packet.isBlocked(i) ? 0.f : 1.f);
      if (translucent_.empty() || !packet.restart()) continue;
      rtcOccluded16(packet.valid.data(), translucentScene_, &context, &packet.rays);
      for (std::size_t i = begin; i < begin + count; ++i)
        if (packet.valid[i] == -1 && packet.isBlocked(i)) behind.push_back(first + i);
    }
    traceTranslucent(rays, behind, shares);
  }

 private:
  // Sets the shares of the rays `which`, which nothing else is in the way of.
  void traceTranslucent(const ShadowRays& rays, std::span<const std::size_t> which,
                        std::span<vec3> shares) const {
    if (which.empty()) return;
    Context context(lookup_);
    context.embree.filter = takeLight;
    Packet packet;
    for (std::size_t done = 0; done < which.size(); done += kPacket) {
      const auto part = which.subspan(done, std::min(kPacket, which.size() - done));
      for (std::size_t i = 0; i < kPacket; ++i)
        packet.set(i, rays, part[std::min(i, part.size() - 1)]);
      packet.start(0, part.size());
      context.through.fill(vec3(1.f));
      rtcOccluded16(packet.valid.data(), translucentScene_, &context.embree, &packet.rays);
      for (std::size_t i = 0; i < part.size(); ++i)
        shares[part[i]] = packet.isBlocked(i) ? vec3(0.f) : context.through[i];
    }
  }

  // Of the world, those whose materials are like that.
  std::vector<std::uint32_t> trianglesOf(scene::AlphaMode mode) const {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < world_.triangleCount(); ++i)
      if (lookup_.materialOf(world_.objects[world_.owners[i]].object).alphaMode == mode)
        triangles.push_back(i);
    return triangles;
  }

  std::vector<trace::Spot> spotsOf(const std::vector<std::uint32_t>& triangles) const {
    std::vector<trace::Spot> spots;
    for (const std::uint32_t triangle : triangles) {
      const WorldObject& object = world_.objects[world_.owners[triangle]];
      spots.push_back({.object = object.object, .triangle = triangle - object.firstTriangle});
    }
    return spots;
  }

  std::vector<vec3> cornersOf(const std::vector<std::uint32_t>& triangles) const {
    std::vector<vec3> corners;
    for (const std::uint32_t triangle : triangles)
      for (std::size_t k = 0; k < 3; ++k)
        corners.push_back(world_.positions[world_.indices[3 * std::size_t{triangle} + k]]);
    return corners;
  }

  // Three corners a triangle. userData: what the filter looks at; it stays where it is.
  void attach(RTCScene scene, const std::vector<vec3>& corners, RTCFilterFunctionN filter = nullptr,
              void* userData = nullptr) const {
    if (corners.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // The padding that Embree asks for behind shared buffers is not there, so it keeps a copy.
    auto* positions = static_cast<vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), corners.size()));
    std::ranges::copy(corners, positions);
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), corners.size() / 3));
    std::iota(indices, indices + corners.size(), 0u);
    rtcSetGeometryUserData(geometry, userData);
    if (filter) rtcSetGeometryOccludedFilterFunction(geometry, filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }

  const World& world_;
  trace::MaterialLookup lookup_;
  RTCDevice device_;
  RTCScene solidScene_, translucentScene_;
  Holes holes_;                           // of the alpha-tested triangles
  std::vector<trace::Spot> translucent_;  // these triangles
};

}  // namespace

const char* rayInstructionSet() {
  // All that Embree's "avx512" is made of.
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    return "avx512";
  return __builtin_cpu_supports("avx2") ? "avx2" : "sse4.2";
}

std::unique_ptr<ShadowTracer> makeEmbreeTracer(const World& world) {
  return std::make_unique<EmbreeTracer>(world);
}

}  // namespace lucerna::bake

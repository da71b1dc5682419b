#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <string>

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

// What is in the way of a ray, of a geometry whose user data are its triangles.
trace::Spot spotOf(const RTCFilterFunctionNArguments& args, unsigned lane) {
  trace::Spot spot =
      static_cast<const trace::Spot*>(args.geometryUserPtr)[RTCHitN_primID(args.hit, args.N, lane)];
  spot.barycentric = {RTCHitN_u(args.hit, args.N, lane), RTCHitN_v(args.hit, args.N, lane)};
  return spot;
}

// Of alpha-tested triangles: lets rays through their holes, however often it is asked.
void passHoles(const RTCFilterFunctionNArguments* args) {
  const Context& context = *reinterpret_cast<const Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane)
    if (args->valid[lane] == -1 && trace::isHole(context.lookup, spotOf(*args, lane)))
      args->valid[lane] = 0;
}

// Of translucent ones, each of which must be shown once to a ray. Packets that are marked as
// coherent show some twice (Embree 3.13.5), and so may scenes of high build quality, which split
// triangles.
void takeLight(const RTCFilterFunctionNArguments* args) {
  Context& context = *reinterpret_cast<Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] != -1) continue;
    const vec3 toLightW(-RTCRayN_dir_x(args->ray, args->N, lane),
                        -RTCRayN_dir_y(args->ray, args->N, lane),
                        -RTCRayN_dir_z(args->ray, args->N, lane));
    vec3& share = context.through[RTCRayN_id(args->ray, args->N, lane)];
    share *= trace::shareThrough(context.lookup, spotOf(*args, lane), toLightW);
    if (share != vec3(0.f)) args->valid[lane] = 0;
  }
}

// Sixteen rays as Embree reads them.
struct Packet {
  Packet() {
    for (unsigned i = 0; i < kPacket; ++i) {
      rays.tnear[i] = kClearOfLight;
      rays.time[i] = 0.f;
      rays.mask[i] = ~0u;
      rays.id[i] = i;
      rays.flags[i] = 0;
    }
  }

  // Rays of the list from `first` on, into all lanes: there are as many.
  void setAll(const ShadowRays& list, std::size_t first) {
    const auto set = [first](const auto& from, const auto& to, float* origin, float* way) {
      const float *start = &from[first], *end = &to[first];
      for (std::size_t i = 0; i < kPacket; ++i) origin[i] = start[i];
      for (std::size_t i = 0; i < kPacket; ++i) way[i] = end[i] - start[i];
    };
    set(list.fromX, list.toX, rays.org_x, rays.dir_x);
    set(list.fromY, list.toY, rays.org_y, rays.dir_y);
    set(list.fromZ, list.toZ, rays.org_z, rays.dir_z);
  }
  void set(std::size_t lane, const ShadowRays& list, std::size_t at) {
    rays.org_x[lane] = list.fromX[at];
    rays.org_y[lane] = list.fromY[at];
    rays.org_z[lane] = list.fromZ[at];
    rays.dir_x[lane] = list.toX[at] - list.fromX[at];
    rays.dir_y[lane] = list.toY[at] - list.fromY[at];
    rays.dir_z[lane] = list.toZ[at] - list.fromZ[at];
  }
  // Lanes of [begin, end) take part.
  void start(std::size_t begin, std::size_t end) {
    const int first = static_cast<int>(begin), last = static_cast<int>(end);
    for (std::size_t i = 0; i < kPacket; ++i) rays.tfar[i] = 1.f - kClearOfSample;
    for (int i = 0; i < 16; ++i) valid[i] = i >= first && i < last ? -1 : 0;
  }
  // Of the lanes that took part those that nothing was in the way of take part again. Whether any.
  bool restart() {
    int any = 0;
    for (std::size_t i = 0; i < kPacket; ++i) any |= valid[i] &= isBlocked(i) ? 0 : -1;
    return any != 0;
  }
  // Below 0: Embree's mark of what is in the way.
  bool isBlocked(std::size_t lane) const { return rays.tfar[lane] < 0.f; }

  alignas(64) RTCRay16 rays;
  alignas(64) std::array<int, kPacket> valid;
};

// Rays are followed in coherent packets: first past all that lets light through by holes or not at
// all; those that came through are then asked whether anything translucent is in the way, and only
// those for which there is, what it takes.
class EmbreeTracer final : public ShadowTracer {
 public:
  explicit EmbreeTracer(const World& world)
      : world_(world),
        lookup_(*world.scene, mat4(1.f)),
        device_(rtcNewDevice((std::string("isa=") + rayInstructionSet()).c_str())),
        solidScene_(rtcNewScene(device_)),
        translucentScene_(rtcNewScene(device_)) {
    CHECK(device_, "Embree makes no device (error {})",
          static_cast<int>(rtcGetDeviceError(nullptr)));
    rtcSetSceneFlags(solidScene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneFlags(translucentScene_,
                     RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    attach(solidScene_, trianglesOf(scene::AlphaMode::Opaque));
    const std::vector<std::uint32_t> masked = trianglesOf(scene::AlphaMode::Mask);
    masked_ = spotsOf(masked);
    attach(solidScene_, masked, passHoles, masked_.data());
    const std::vector<std::uint32_t> translucent = trianglesOf(scene::AlphaMode::Blend);
    translucent_ = spotsOf(translucent);
    attach(translucentScene_, translucent, nullptr, translucent_.data());
    rtcCommitScene(solidScene_);
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
    Context context(lookup_);
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
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
        for (std::size_t i = 0; i < count; ++i) packet.set(i, rays, i);
      packet.start(begin, begin + count);
      rtcOccluded16(packet.valid.data(), solidScene_, &context.embree, &packet.rays);
      for (std::size_t i = begin; i < begin + count; ++i)
        shares[first + i] = vec3(packet.isBlocked(i) ? 0.f : 1.f);
      if (translucent_.empty() || !packet.restart()) continue;
      rtcOccluded16(packet.valid.data(), translucentScene_, &context.embree, &packet.rays);
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
      for (std::size_t i = 0; i < part.size(); ++i) packet.set(i, rays, part[i]);
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

  // spots: of the triangles; they stay where they are.
  void attach(RTCScene scene, const std::vector<std::uint32_t>& triangles,
              RTCFilterFunctionN filter = nullptr, trace::Spot* spots = nullptr) const {
    if (triangles.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // The padding that Embree asks for behind shared buffers is not there, so it keeps a copy.
    auto* positions = static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
                                                                 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                                                                 world_.positions.size()));
    std::ranges::copy(world_.positions, positions);
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), triangles.size()));
    for (std::size_t i = 0; i < triangles.size(); ++i)
      std::copy_n(&world_.indices[3 * std::size_t{triangles[i]}], 3, &indices[3 * i]);
    rtcSetGeometryUserData(geometry, spots);
    if (filter) rtcSetGeometryOccludedFilterFunction(geometry, filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }

  const World& world_;
  trace::MaterialLookup lookup_;
  RTCDevice device_;
  RTCScene solidScene_, translucentScene_;
  std::vector<trace::Spot> masked_, translucent_;  // their triangles, what is opaque left out
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

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "bake/holes.hpp"
#include "bake/overlap.hpp"
#include "bake/shadow_tracer.hpp"
#include "core/check.hpp"
#include "image/vector_math.hpp"
#include "trace/material_lookup.hpp"

namespace lucerna::bake {
namespace {

constexpr std::size_t kPacket = 16;
// Packets that are set before the first of them is traced: Embree reads whole vectors, for which
// the processor would wait if their parts had just been written.
constexpr std::size_t kBatch = 4;

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
  RTCHitN* const hit = args->hit;
  int* const valid = args->valid;
  const unsigned count = args->N;
  for (unsigned lane = 0; lane < count; ++lane)
    if (valid[lane] == -1)
      valid[lane] = holes.at(RTCHitN_primID(hit, count, lane),
                             {RTCHitN_u(hit, count, lane), RTCHitN_v(hit, count, lane)})
                        ? 0
                        : -1;
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
  // The rays of the list from `done` on: sixteen, or what is left. Lanes before them have those
  // before, if there are any, which take part in nothing.
  void set(const ShadowRays& list, std::size_t done) {
    const std::size_t count = std::min(kPacket, list.size() - done);
    begin = list.size() >= kPacket ? kPacket - count : 0;
    end = begin + count;
    first = done - begin;
    if (list.size() >= kPacket) {
      setAll(&list.toX[first], &list.fromX[first], rays.org_x, rays.dir_x);
      setAll(&list.toY[first], &list.fromY[first], rays.org_y, rays.dir_y);
      setAll(&list.toZ[first], &list.fromZ[first], rays.org_z, rays.dir_z);
    } else {
      for (std::size_t i = 0; i < kPacket; ++i) setOne(i, list, std::min(i, count - 1));
    }
    start();
  }
  // These rays of the list: sixteen at most.
  void set(const ShadowRays& list, std::span<const std::size_t> which) {
    begin = first = 0;
    end = which.size();
    for (std::size_t i = 0; i < kPacket; ++i) setOne(i, list, which[std::min(i, end - 1)]);
    start();
  }
  void trace(RTCScene scene, RTCIntersectContext& context) {
    rtcOccluded16(valid.data(), scene, &context, &rays);
  }
  // Of the lanes that took part those that nothing was in the way of take part again. Whether any.
  bool restart() {
    int any = 0;
    for (std::size_t i = 0; i < kPacket; ++i) any |= valid[i] &= isBlocked(i) ? 0 : -1;
    return any != 0;
  }
  // Below 0: Embree's mark of what is in the way.
  bool isBlocked(std::size_t lane) const { return rays.tfar[lane] < 0.f; }
  // Sets the list's shares: all or nothing.
  void answer(std::span<vec3> shares) const {
    std::array<float, kPacket> share;
    for (std::size_t i = 0; i < kPacket; ++i) share[i] = isBlocked(i) ? 0.f : 1.f;
    for (std::size_t i = begin; i < end; ++i) shares[first + i] = vec3(share[i]);
  }

  alignas(64) RTCRay16 rays;
  alignas(64) std::array<int, kPacket> valid;  // -1: takes part
  std::size_t begin, end;                      // the lanes that take part, at first
  std::size_t first;                           // ray of the list that lane 0 has

 private:
  // `__restrict`: else this does not become vector code.
  static void setAll(const float* sample, const float* light, float* __restrict origin,
                     float* __restrict way) {
    for (std::size_t i = 0; i < kPacket; ++i) {
      origin[i] = sample[i];
      way[i] = light[i] - sample[i];
    }
  }
  void setOne(std::size_t lane, const ShadowRays& list, std::size_t at) {
    rays.org_x[lane] = list.toX[at];
    rays.org_y[lane] = list.toY[at];
    rays.org_z[lane] = list.toZ[at];
    rays.dir_x[lane] = list.fromX[at] - list.toX[at];
    rays.dir_y[lane] = list.fromY[at] - list.toY[at];
    rays.dir_z[lane] = list.fromZ[at] - list.toZ[at];
  }
  void start() {
    for (std::size_t i = 0; i < kPacket; ++i)
      rays.tnear[i] = clearOfSample({rays.org_x[i], rays.org_y[i], rays.org_z[i]},
                                    {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]});
    std::ranges::fill(rays.tfar, 1.f - kClearOfLight);
    std::ranges::fill(rays.time, 0.f);
    std::ranges::fill(rays.mask, ~0u);
    std::iota(std::begin(rays.id), std::end(rays.id), 0u);
    std::ranges::fill(rays.flags, 0u);
    const int from = static_cast<int>(begin), to = static_cast<int>(end);
    for (int i = 0; i < static_cast<int>(kPacket); ++i) valid[i] = i >= from && i < to ? -1 : 0;
  }
};

// The packets get the rays of the list from `first` on.
LUCERNA_WIDE_VECTORS
void setPackets(std::span<Packet> packets, const ShadowRays& list, std::size_t first) {
  for (std::size_t i = 0; i < packets.size(); ++i) packets[i].set(list, first + i * kPacket);
}

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
    std::array<Packet, kBatch> batch;
    std::vector<std::size_t> behind;  // rays with something translucent in the way
    const std::size_t all = (rays.size() + kPacket - 1) / kPacket;
    for (std::size_t done = 0; done < all; done += kBatch) {
      const auto packets = std::span(batch).first(std::min(kBatch, all - done));
      setPackets(packets, rays, done * kPacket);
      for (Packet& packet : packets) packet.trace(solidScene_, context);
      for (const Packet& packet : packets) packet.answer(shares);
      if (translucent_.empty()) continue;
      for (Packet& packet : packets) {
        if (!packet.restart()) continue;
        packet.trace(translucentScene_, context);
        for (std::size_t i = packet.begin; i < packet.end; ++i)
          if (packet.valid[i] == -1 && packet.isBlocked(i)) behind.push_back(packet.first + i);
      }
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
      packet.set(rays, part);
      context.through.fill(vec3(1.f));
      packet.trace(translucentScene_, context.embree);
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

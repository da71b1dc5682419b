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

// What the filter finds behind Embree's context. Each triangle must reach the filter once: packets
// that are marked coherent show it some twice (Embree 3.13.5), and so may scenes of high build
// quality, which split triangles. Neither is faster here.
struct Context {
  RTCIntersectContext embree;  // first: Embree hands out its address
  const World* world = nullptr;
  const trace::MaterialLookup* lookup = nullptr;
  std::span<const std::uint32_t> triangles;  // of the world, by primitive
  vec3* shares = nullptr;                    // of the packet under way, one a lane
};

// Of the geometry that lets some light through.
void filter(const RTCFilterFunctionNArguments* args) {
  const Context& context = *reinterpret_cast<const Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] != -1) continue;
    const std::uint32_t triangle = context.triangles[RTCHitN_primID(args->hit, args->N, lane)];
    const WorldObject& object = context.world->objects[context.world->owners[triangle]];
    const trace::Spot spot{
        .object = object.object,
        .triangle = triangle - object.firstTriangle,
        .barycentric = {RTCHitN_u(args->hit, args->N, lane), RTCHitN_v(args->hit, args->N, lane)}};
    const vec3 toLightW(-RTCRayN_dir_x(args->ray, args->N, lane),
                        -RTCRayN_dir_y(args->ray, args->N, lane),
                        -RTCRayN_dir_z(args->ray, args->N, lane));
    vec3& share = context.shares[RTCRayN_id(args->ray, args->N, lane)];
    share *= trace::shareThrough(*context.lookup, spot, toLightW);
    if (share != vec3(0.f)) args->valid[lane] = 0;
  }
}

class EmbreeTracer final : public ShadowTracer {
 public:
  explicit EmbreeTracer(const World& world)
      : world_(world),
        lookup_(*world.scene, mat4(1.f)),
        device_(rtcNewDevice((std::string("isa=") + rayInstructionSet()).c_str())) {
    CHECK(device_, "Embree makes no device (error {})",
          static_cast<int>(rtcGetDeviceError(nullptr)));
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    std::vector<std::uint32_t> opaque;
    for (std::uint32_t i = 0; i < world.triangleCount(); ++i) {
      const scene::Object& object = world.scene->objects[world.objects[world.owners[i]].object];
      const bool solid =
          world.scene->materials[object.material].alphaMode == scene::AlphaMode::Opaque;
      (solid ? opaque : filtered_).push_back(i);
    }
    attach(opaque, false);
    attach(filtered_, true);
    rtcCommitScene(scene_);
  }
  ~EmbreeTracer() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  void trace(const ShadowRays& rays, std::span<vec3> shares) const override {
    CHECK(rays.size() == shares.size());
    Context context{.embree = {}, .world = &world_, .lookup = &lookup_, .triangles = filtered_};
    rtcInitIntersectContext(&context.embree);
    alignas(64) RTCRay16 packet;
    alignas(64) std::array<int, kPacket> valid;
    // For lanes without a ray as well: Embree 3.13.5 asks the filter about some of them.
    std::array<vec3, kPacket> through;
    context.shares = through.data();
    for (unsigned i = 0; i < kPacket; ++i) {
      packet.tnear[i] = kClearOfLight;
      packet.time[i] = 0.f;
      packet.mask[i] = ~0u;
      packet.id[i] = i;
      packet.flags[i] = 0;
    }
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
      const std::size_t count = std::min(kPacket, rays.size() - first);
      setRays(packet, valid, rays, first, count);
      through.fill(vec3(1.f));
      rtcOccluded16(valid.data(), scene_, &context.embree, &packet);
      for (std::size_t i = 0; i < count; ++i)  // below 0: Embree's mark of what is in the way
        shares[first + i] = packet.tfar[i] < 0.f ? vec3(0.f) : through[i];
    }
  }

 private:
  void attach(std::span<const std::uint32_t> triangles, bool filtered) const {
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
    if (filtered) rtcSetGeometryOccludedFilterFunction(geometry, filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  // Lanes behind the end of the list take part in nothing.
  static void setRays(RTCRay16& packet, std::array<int, kPacket>& valid, const ShadowRays& rays,
                      std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < kPacket; ++i) {
      valid[i] = i < count ? -1 : 0;
      const std::size_t at = first + std::min(i, count - 1);
      packet.org_x[i] = rays.fromX[at];
      packet.org_y[i] = rays.fromY[at];
      packet.org_z[i] = rays.fromZ[at];
      packet.dir_x[i] = rays.toX[at] - rays.fromX[at];
      packet.dir_y[i] = rays.toY[at] - rays.fromY[at];
      packet.dir_z[i] = rays.toZ[at] - rays.fromZ[at];
      packet.tfar[i] = 1.f - kClearOfSample;
    }
  }

  const World& world_;
  trace::MaterialLookup lookup_;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
  std::vector<std::uint32_t> filtered_;  // triangles of the world that let some light through
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

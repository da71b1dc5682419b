#include "trace/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/check.hpp"
#include "trace/material_lookup.hpp"

namespace lucerna::trace {
namespace {

constexpr std::size_t kPacket = 16;

void report(void*, RTCError code, const char* message) {
  CHECK(false, "Embree reports error {}: {}", static_cast<int>(code), message ? message : "");
}

RTCDevice makeDevice(const std::string& instructionSet) {
  const std::string config = instructionSet.empty() ? "" : "isa=" + instructionSet;
  RTCDevice device = rtcNewDevice(config.c_str());
  CHECK(device, "Embree makes no device (error {})", static_cast<int>(rtcGetDeviceError(nullptr)));
  rtcSetDeviceErrorFunction(device, report, nullptr);
  return device;
}

// What the filters find behind Embree's context. Not marked coherent: with instances, robust mode
// and several threads Embree 3.13.5 then now and then never comes back from rtcOccluded16.
struct Context {
  explicit Context(const MaterialLookup& l) : lookup(l) { rtcInitIntersectContext(&embree); }

  RTCIntersectContext embree;  // first: Embree hands out its address
  const MaterialLookup& lookup;
  std::span<const std::uint8_t> solid;  // of each object: opaque and one-sided
  // Of the packet under way, one a lane that has a ray.
  std::span<const Ray> rays;
  vec3* shares = nullptr;
  std::span<const Passed> passed;
  std::span<int> counts;
};

Spot spotOf(RTCHitN* hit, unsigned count, unsigned lane) {
  return {.object = RTCHitN_instID(hit, count, lane, 0),
          .triangle = RTCHitN_primID(hit, count, lane),
          .barycentric = {RTCHitN_u(hit, count, lane), RTCHitN_v(hit, count, lane)}};
}

// Of the nearest surfaces holes are none; translucent ones are.
void closestFilter(const RTCFilterFunctionNArguments* args) {
  const Context& context = *reinterpret_cast<const Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane)
    if (args->valid[lane] == -1 && isHole(context.lookup, spotOf(args->hit, args->N, lane)))
      args->valid[lane] = 0;
}

// Of all geometry, for rays that have passed something.
void passedFilter(const RTCFilterFunctionNArguments* args) {
  const Context& context = *reinterpret_cast<const Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] != -1) continue;
    // Embree 3.13.5 asks about lanes without a ray, too.
    const unsigned id = RTCRayN_id(args->ray, args->N, lane);
    if (id >= context.passed.size()) continue;
    if (context.passed[id].has(RTCHitN_instID(args->hit, args->N, lane, 0),
                               RTCHitN_primID(args->hit, args->N, lane)))
      args->valid[lane] = 0;
  }
}

// Of all geometry: counts what is met, and lets all rays on.
void countFilter(const RTCFilterFunctionNArguments* args) {
  const Context& context = *reinterpret_cast<const Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] != -1) continue;
    args->valid[lane] = 0;
    // Embree 3.13.5 asks about lanes without a ray, too.
    const unsigned id = RTCRayN_id(args->ray, args->N, lane);
    if (id >= context.counts.size()) continue;
    if (!context.solid[RTCHitN_instID(args->hit, args->N, lane, 0)]) continue;
    // Ray and normal are both the object's here.
    const vec3 direction(RTCRayN_dir_x(args->ray, args->N, lane),
                         RTCRayN_dir_y(args->ray, args->N, lane),
                         RTCRayN_dir_z(args->ray, args->N, lane));
    const vec3 normal(RTCHitN_Ng_x(args->hit, args->N, lane),
                      RTCHitN_Ng_y(args->hit, args->N, lane),
                      RTCHitN_Ng_z(args->hit, args->N, lane));
    context.counts[id] += glm::dot(normal, direction) < 0.f ? -1 : 1;
  }
}

void transmittanceFilter(const RTCFilterFunctionNArguments* args) {
  const Context& context = *reinterpret_cast<const Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] != -1) continue;
    const unsigned id = RTCRayN_id(args->ray, args->N, lane);
    if (id >= context.rays.size()) continue;
    // Embree's ray is the object's here, so the direction is that of the one that was asked.
    const Spot spot = spotOf(args->hit, args->N, lane);
    vec3& share = context.shares[id];
    share *= shareThrough(context.lookup, spot, context.rays[id].directionW);
    if (share != vec3(0.f)) args->valid[lane] = 0;
  }
}

// What all packets have in common.
template <typename Packet>
void prepare(Packet& packet) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    packet.time[i] = 0.f;
    packet.mask[i] = ~0u;
    packet.id[i] = static_cast<unsigned>(i);
    packet.flags[i] = 0;
  }
}

// Lanes behind the end of the list take part in nothing.
template <typename Packet>
void setRays(Packet& packet, std::span<const Ray> rays, std::array<int, kPacket>& valid) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    valid[i] = i < rays.size() ? -1 : 0;
    const Ray& ray = rays[std::min(i, rays.size() - 1)];
    packet.org_x[i] = ray.originW.x;
    packet.org_y[i] = ray.originW.y;
    packet.org_z[i] = ray.originW.z;
    packet.tnear[i] = ray.near;
    packet.dir_x[i] = ray.directionW.x;
    packet.dir_y[i] = ray.directionW.y;
    packet.dir_z[i] = ray.directionW.z;
    packet.tfar[i] = ray.far;
  }
}

}  // namespace

struct RayScene::Impl {
  Impl(const scene::Scene& scene, const mat4& viewFromWorld, const std::string& instructionSet)
      : lookup(scene, viewFromWorld), device(makeDevice(instructionSet)) {
    top = newScene();
    for (const scene::Object& object : scene.objects) {
      const scene::Material& material = scene.materials[object.material];
      solid.push_back(!material.doubleSided && material.alphaMode == scene::AlphaMode::Opaque);
    }
    std::vector<bool> filtered(scene.meshes.size());
    for (const scene::Object& object : scene.objects)
      if (scene.materials[object.material].alphaMode != scene::AlphaMode::Opaque)
        filtered[object.mesh] = true;
    meshes.resize(scene.meshes.size(), nullptr);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
      const scene::Object& object = scene.objects[i];
      const scene::Mesh& mesh = scene.meshes[object.mesh];
      if (mesh.indices.empty()) continue;  // lines and points stop no ray
      RTCScene& bottom = meshes[object.mesh];
      if (!bottom) bottom = build(mesh, filtered[object.mesh]);
      attachInstance(bottom, scene.nodes[object.node].worldFromNode, i);
    }
    rtcCommitScene(top);
  }
  ~Impl() {
    for (RTCScene mesh : meshes)
      if (mesh) rtcReleaseScene(mesh);
    rtcReleaseScene(top);
    rtcReleaseDevice(device);
  }

  RTCScene newScene() const {
    RTCScene made = rtcNewScene(device);
    // Robust: no ray slips through where triangles meet.
    rtcSetSceneFlags(made, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    return made;
  }

  RTCScene build(const scene::Mesh& mesh, bool filtered) const {
    RTCScene made = newScene();
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
                                                                 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                                                                 mesh.positions.size()));
    std::ranges::copy(mesh.positions, positions);
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangleCount()));
    std::copy_n(mesh.indices.begin(), 3 * mesh.triangleCount(), indices);
    if (filtered) {
      rtcSetGeometryIntersectFilterFunction(geometry, closestFilter);
      rtcSetGeometryOccludedFilterFunction(geometry, transmittanceFilter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(made, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(made);
    return made;
  }

  void attachInstance(RTCScene bottom, const mat4& worldFromObject, std::uint32_t object) const {
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, bottom);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &worldFromObject[0].x);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(top, instance, object);
    rtcReleaseGeometry(instance);
  }

  // Packet after packet: before(first, count) of the rays, then take(ray, packet, lane) of each.
  template <typename Before, typename Take>
  void intersect(std::span<const Ray> rays, Context& context, const Before& before,
                 const Take& take) const {
    alignas(64) RTCRayHit16 packet;
    alignas(64) std::array<int, kPacket> valid;
    prepare(packet.ray);
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
      const std::size_t count = std::min(kPacket, rays.size() - first);
      setRays(packet.ray, rays.subspan(first, count), valid);
      before(first, count);
      std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
      rtcIntersect16(valid.data(), top, &context.embree, &packet);
      for (std::size_t i = 0; i < count; ++i) take(first + i, packet, i);
    }
  }

  MaterialLookup lookup;
  RTCDevice device;
  RTCScene top = nullptr;
  std::vector<RTCScene> meshes;     // null where no object shows it
  std::vector<std::uint8_t> solid;  // of each object: opaque and one-sided
};

float Passed::pass(const Hit& hit) {
  constexpr float kRounding = 0x1p-20f;
  if (hit.t > t_ * (1.f + kRounding) || count_ == triangles_.size()) {
    const bool full = hit.t <= t_ * (1.f + kRounding);
    count_ = 0;
    t_ = hit.t;
    if (full) return hit.t * (1.f + kRounding);
  }
  triangles_[count_++] = {hit.spot.object, hit.spot.triangle};
  return hit.t * (1.f - kRounding);
}

bool Passed::has(std::uint32_t object, std::uint32_t triangle) const {
  return std::any_of(triangles_.begin(), triangles_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [&](const Triangle& t) { return t.object == object && t.index == triangle; });
}

RayScene::RayScene(const scene::Scene& scene, const mat4& viewFromWorld,
                   const std::string& instructionSet)
    : impl_(std::make_unique<Impl>(scene, viewFromWorld, instructionSet)) {}

RayScene::~RayScene() = default;

const MaterialLookup& RayScene::lookup() const {
  return impl_->lookup;
}

void RayScene::closest(std::span<const Ray> rays, std::span<Hit> hits,
                       std::span<const Passed> passed) const {
  CHECK(rays.size() == hits.size() && (passed.empty() || passed.size() == rays.size()));
  Context context(impl_->lookup);
  if (!passed.empty()) context.embree.filter = passedFilter;
  impl_->intersect(
      rays, context,
      [&](std::size_t first, std::size_t count) {
        if (!passed.empty()) context.passed = passed.subspan(first, count);
      },
      [&](std::size_t ray, const RTCRayHit16& packet, std::size_t lane) {
        hits[ray] = packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID
                        ? Hit{}
                        : Hit{.t = packet.ray.tfar[lane],
                              .spot = {.object = packet.hit.instID[0][lane],
                                       .triangle = packet.hit.primID[lane],
                                       .barycentric = {packet.hit.u[lane], packet.hit.v[lane]}}};
      });
}

void RayScene::transmittance(std::span<const Ray> rays, std::span<vec3> shares) const {
  CHECK(rays.size() == shares.size());
  Context context(impl_->lookup);
  alignas(64) RTCRay16 packet;
  alignas(64) std::array<int, kPacket> valid;
  std::array<vec3, kPacket> through;
  context.shares = through.data();
  prepare(packet);
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    context.rays = rays.subspan(first, count);
    setRays(packet, context.rays, valid);
    through.fill(vec3(1.f));
    rtcOccluded16(valid.data(), impl_->top, &context.embree, &packet);
    for (std::size_t i = 0; i < count; ++i)  // below 0: Embree's mark of what is in the way
      shares[first + i] = packet.tfar[i] < 0.f ? vec3(0.f) : through[i];
  }
}

void RayScene::solidsAround(std::span<const Ray> rays, std::span<int> counts) const {
  CHECK(rays.size() == counts.size());
  std::ranges::fill(counts, 0);
  Context context(impl_->lookup);
  context.embree.filter = countFilter;
  context.solid = impl_->solid;
  impl_->intersect(
      rays, context,
      [&](std::size_t first, std::size_t count) { context.counts = counts.subspan(first, count); },
      [](std::size_t, const RTCRayHit16&, std::size_t) {});
}

}  // namespace lucerna::trace

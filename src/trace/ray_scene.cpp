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

RTCDevice makeDevice() {
  RTCDevice device = rtcNewDevice(nullptr);
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
  vec3* shares = nullptr;  // of transmittance(), one a lane
};

bool lets(const Context& context, RTCHitN* hit, unsigned count, unsigned lane, vec3& share) {
  const Spot spot{.object = RTCHitN_instID(hit, count, lane, 0),
                  .triangle = RTCHitN_primID(hit, count, lane),
                  .barycentric = {RTCHitN_u(hit, count, lane), RTCHitN_v(hit, count, lane)}};
  const scene::Material& material = context.lookup.materialOf(spot.object);
  if (material.alphaMode == scene::AlphaMode::Opaque) return false;
  const float alpha = context.lookup.opacity(spot);
  if (material.alphaMode == scene::AlphaMode::Mask) return alpha < material.alphaCutoff;
  share *= scene::transmittance(alpha, material.transmission);
  return share != vec3(0.f);
}

// Of the nearest surfaces holes are none; translucent ones are.
void closestFilter(const RTCFilterFunctionNArguments* args) {
  const Context& context = *reinterpret_cast<const Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] != -1) continue;
    const std::uint32_t object = RTCHitN_instID(args->hit, args->N, lane, 0);
    if (context.lookup.materialOf(object).alphaMode != scene::AlphaMode::Mask) continue;
    vec3 ignored(1.f);
    if (lets(context, args->hit, args->N, lane, ignored)) args->valid[lane] = 0;
  }
}

void transmittanceFilter(const RTCFilterFunctionNArguments* args) {
  const Context& context = *reinterpret_cast<const Context*>(args->context);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] != -1) continue;
    vec3& share = context.shares[RTCRayN_id(args->ray, args->N, lane)];
    if (lets(context, args->hit, args->N, lane, share)) args->valid[lane] = 0;
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
    packet.time[i] = 0.f;
    packet.tfar[i] = ray.far;
    packet.mask[i] = ~0u;
    packet.id[i] = static_cast<unsigned>(i);
    packet.flags[i] = 0;
  }
}

}  // namespace

struct RayScene::Impl {
  Impl(const scene::Scene& scene, const mat4& viewFromWorld)
      : lookup(scene, viewFromWorld), device(makeDevice()) {
    top = newScene();
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
    rtcSetSceneFlags(made, RTC_SCENE_FLAG_ROBUST);
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

  MaterialLookup lookup;
  RTCDevice device;
  RTCScene top = nullptr;
  std::vector<RTCScene> meshes;  // null where no object shows it
};

RayScene::RayScene(const scene::Scene& scene, const mat4& viewFromWorld)
    : impl_(std::make_unique<Impl>(scene, viewFromWorld)) {}

RayScene::~RayScene() = default;

const MaterialLookup& RayScene::lookup() const {
  return impl_->lookup;
}

void RayScene::closest(std::span<const Ray> rays, std::span<Hit> hits) const {
  CHECK(rays.size() == hits.size());
  Context context(impl_->lookup);
  alignas(64) RTCRayHit16 packet;
  alignas(64) std::array<int, kPacket> valid;
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    setRays(packet.ray, rays.subspan(first, count), valid);
    std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect16(valid.data(), impl_->top, &context.embree, &packet);
    for (std::size_t i = 0; i < count; ++i)
      hits[first + i] = packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                            ? Hit{}
                            : Hit{.t = packet.ray.tfar[i],
                                  .spot = {.object = packet.hit.instID[0][i],
                                           .triangle = packet.hit.primID[i],
                                           .barycentric = {packet.hit.u[i], packet.hit.v[i]}}};
  }
}

void RayScene::transmittance(std::span<const Ray> rays, std::span<vec3> shares) const {
  CHECK(rays.size() == shares.size());
  Context context(impl_->lookup);
  alignas(64) RTCRay16 packet;
  alignas(64) std::array<int, kPacket> valid;
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    setRays(packet, rays.subspan(first, count), valid);
    context.shares = &shares[first];
    std::fill_n(context.shares, count, vec3(1.f));
    rtcOccluded16(valid.data(), impl_->top, &context.embree, &packet);
    for (std::size_t i = 0; i < count; ++i)
      if (packet.tfar[i] < 0.f) shares[first + i] = vec3(0.f);  // Embree's mark
  }
}

}  // namespace lucerna::trace

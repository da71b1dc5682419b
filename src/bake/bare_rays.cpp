#include "bake/bare_rays.hpp"
#include "bake/seconds.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "core/check.hpp"

namespace lucerna::bake {
namespace {

constexpr std::size_t kPacket = 16;

struct Packet {
  RTCRay16 rays;
  alignas(64) std::array<int, kPacket> valid{};
};

// Of the rays from `first` on, from samples to lights as the tracer follows them; lanes behind the
// end of the list repeat the last.
Packet packetOf(const ShadowRays& rays, std::size_t first) {
  Packet packet{};
  for (std::size_t i = 0; i < kPacket; ++i) {
    const std::size_t at = std::min(first + i, rays.size() - 1);
    packet.valid[i] = first + i < rays.size() ? -1 : 0;
    const vec3 sample(rays.toX[at], rays.toY[at], rays.toZ[at]);
    const vec3 toLight = vec3(rays.fromX[at], rays.fromY[at], rays.fromZ[at]) - sample;
    packet.rays.org_x[i] = sample.x;
    packet.rays.org_y[i] = sample.y;
    packet.rays.org_z[i] = sample.z;
    packet.rays.dir_x[i] = toLight.x;
    packet.rays.dir_y[i] = toLight.y;
    packet.rays.dir_z[i] = toLight.z;
    packet.rays.tnear[i] = clearOfSample(sample, toLight);
    packet.rays.tfar[i] = 1.f - kClearOfLight;
    packet.rays.mask[i] = ~0u;
  }
  return packet;
}

RTCRay rayOf(const Packet& packet, std::size_t i) {
  RTCRay ray{};
  ray.org_x = packet.rays.org_x[i];
  ray.org_y = packet.rays.org_y[i];
  ray.org_z = packet.rays.org_z[i];
  ray.dir_x = packet.rays.dir_x[i];
  ray.dir_y = packet.rays.dir_y[i];
  ray.dir_z = packet.rays.dir_z[i];
  ray.tnear = packet.rays.tnear[i];
  ray.tfar = packet.rays.tfar[i];
  ray.mask = ~0u;
  return ray;
}

std::vector<RTCRay> raysOf(const std::vector<Packet>& packets) {
  std::vector<RTCRay> rays;
  rays.reserve(kPacket * packets.size());
  for (const Packet& packet : packets)
    for (std::size_t i = 0; i < kPacket && packet.valid[i] == -1; ++i)
      rays.push_back(rayOf(packet, i));
  return rays;
}

RTCScene sceneOf(RTCDevice device, const World& world, bool robust) {
  RTCScene scene = rtcNewScene(device);
  if (robust) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, sizeof(vec3),
                                                               world.positions.size()));
  std::ranges::copy(world.positions, positions);
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), world.triangleCount()));
  std::ranges::copy(world.indices, indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

}  // namespace

BareSettings likeTracer() {
  return {.robust = false, .coherent = true, .instructionSet = rayInstructionSet()};
}

struct BareRays::State {
  bool coherent = true;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Packet> ready, used;  // Embree marks in `used` what is in the way
  std::size_t count = 0, blocked = 0;
};

BareRays::BareRays(const World& world, std::span<const ShadowRays> lists,
                   const BareSettings& settings)
    : state_(std::make_unique<State>()) {
  state_->coherent = settings.coherent;
  const std::string& isa = settings.instructionSet;
  state_->device = rtcNewDevice(isa.empty() ? nullptr : ("isa=" + isa).c_str());
  CHECK(state_->device, "Embree makes no device (error {})",
        static_cast<int>(rtcGetDeviceError(nullptr)));
  state_->scene = sceneOf(state_->device, world, settings.robust);
  for (const ShadowRays& rays : lists) {
    state_->count += rays.size();
    for (std::size_t first = 0; first < rays.size(); first += kPacket)
      state_->ready.push_back(packetOf(rays, first));
  }
}

BareRays::~BareRays() {
  rtcReleaseScene(state_->scene);
  rtcReleaseDevice(state_->device);
}

std::size_t BareRays::count() const {
  return state_->count;
}

std::size_t BareRays::blocked() const {
  return state_->blocked;
}

double BareRays::packetSeconds() {
  state_->used = state_->ready;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (state_->coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const auto start = Clock::now();
  for (Packet& packet : state_->used)
    rtcOccluded16(packet.valid.data(), state_->scene, &context, &packet.rays);
  const double seconds = secondsSince(start);
  state_->blocked = 0;
  for (const Packet& packet : state_->used)
    for (std::size_t i = 0; i < kPacket; ++i)
      state_->blocked += packet.valid[i] == -1 && packet.rays.tfar[i] < 0.f;
  return seconds;
}

std::vector<bool> BareRays::blockedOneByOne() const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::vector<bool> blocked;
  std::vector<RTCRay> rays = raysOf(state_->ready);
  for (RTCRay& ray : rays) {
    rtcOccluded1(state_->scene, &context, &ray);
    blocked.push_back(ray.tfar < 0.f);
  }
  return blocked;
}

double BareRays::singleSeconds() {
  std::vector<RTCRay> rays = raysOf(state_->ready);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const auto start = Clock::now();
  for (RTCRay& ray : rays) rtcOccluded1(state_->scene, &context, &ray);
  const double seconds = secondsSince(start);
  state_->blocked = static_cast<std::size_t>(
      std::ranges::count_if(rays, [](const RTCRay& ray) { return ray.tfar < 0.f; }));
  return seconds;
}

}  // namespace lucerna::bake

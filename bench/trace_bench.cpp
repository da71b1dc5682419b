// The reference's rays against a bare Embree loop over the same rays.
//
// Takes all rays of some samples of a scene in the order in which the reference follows them.
// Prints, on one thread, million rays a second: of the reference's streams, packing and alpha test
// included; of rtcIntersect16 and rtcOccluded16 over packets packed before; their ratio; and the
// share of a sample's time that is not rays. Medians of interleaved rounds.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "core/log.hpp"
#include "quick.hpp"
#include "scene/load.hpp"
#include "trace/tile_tracer.hpp"

namespace {

using namespace lucerna;
using Clock = std::chrono::steady_clock;

constexpr int kSamples = 2, kTile = 16;
constexpr uvec2 kSize{320, 180};
constexpr std::size_t kPacket = 16;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

// The same triangles in Embree with nothing of ours around them: an instance an object, no filters.
class BareScene {
 public:
  explicit BareScene(const scene::Scene& scene) : device_(rtcNewDevice(nullptr)) {
    top_ = robustScene();
    std::vector<RTCScene> meshes(scene.meshes.size(), nullptr);
    for (const scene::Object& object : scene.objects) {
      const scene::Mesh& mesh = scene.meshes[object.mesh];
      if (mesh.indices.empty()) continue;
      if (!meshes[object.mesh]) meshes[object.mesh] = sceneOf(mesh);
      RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(instance, meshes[object.mesh]);
      rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                              &scene.nodes[object.node].worldFromNode[0].x);
      rtcCommitGeometry(instance);
      rtcAttachGeometry(top_, instance);
      rtcReleaseGeometry(instance);
    }
    for (RTCScene mesh : meshes)
      if (mesh) rtcReleaseScene(mesh);
    rtcCommitScene(top_);
  }
  ~BareScene() {
    rtcReleaseScene(top_);
    rtcReleaseDevice(device_);
  }
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  RTCScene get() const { return top_; }

 private:
  RTCScene robustScene() const {
    RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return scene;
  }
  RTCScene sceneOf(const scene::Mesh& mesh) const {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::ranges::copy(mesh.positions, static_cast<vec3*>(rtcSetNewGeometryBuffer(
                                          geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                          sizeof(vec3), mesh.positions.size())));
    std::ranges::copy(mesh.indices, static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
                                        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        3 * sizeof(std::uint32_t), mesh.triangleCount())));
    rtcCommitGeometry(geometry);
    RTCScene scene = robustScene();
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
  }

  RTCDevice device_;
  RTCScene top_ = nullptr;
};

struct alignas(64) Packet {
  RTCRayHit16 rays;
  int valid[kPacket];
  trace::RayKind kind;
};

void pack(std::vector<Packet>& packets, std::span<const trace::Ray> rays, trace::RayKind kind) {
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    Packet& packet = packets.emplace_back();
    packet.kind = kind;
    for (std::size_t i = 0; i < kPacket; ++i) {
      packet.valid[i] = first + i < rays.size() ? -1 : 0;
      const trace::Ray& ray = rays[std::min(first + i, rays.size() - 1)];
      RTCRay16& r = packet.rays.ray;
      r.org_x[i] = ray.originW.x, r.org_y[i] = ray.originW.y, r.org_z[i] = ray.originW.z;
      r.dir_x[i] = ray.directionW.x, r.dir_y[i] = ray.directionW.y, r.dir_z[i] = ray.directionW.z;
      r.tnear[i] = ray.near, r.tfar[i] = ray.far, r.time[i] = 0.f, r.mask[i] = ~0u;
      r.id[i] = static_cast<unsigned>(i), r.flags[i] = 0;
      packet.rays.hit.geomID[i] = packet.rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
  }
}

// Seconds; the packets' results are thrown away but for how many rays met something.
double follow(const BareScene& scene, std::vector<Packet> packets, std::uint64_t& blocked) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const auto start = Clock::now();
  for (Packet& packet : packets)
    if (packet.kind == trace::RayKind::Closest)
      rtcIntersect16(packet.valid, scene.get(), &context, &packet.rays);
    else
      rtcOccluded16(packet.valid, scene.get(), &context, &packet.rays.ray);
  const double seconds = secondsSince(start);
  blocked = 0;
  for (const Packet& packet : packets)
    for (std::size_t i = 0; i < kPacket; ++i)
      blocked +=
          packet.valid[i] == -1 && (packet.kind == trace::RayKind::Closest
                                        ? packet.rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID
                                        : packet.rays.ray.tfar[i] < 0.f);
  return seconds;
}

struct Round {
  trace::RayStatistics rays;
  double seconds = 0;
};

Round trace(const trace::TracedScene& traced) {
  trace::TileTracer tracer(traced);
  const ivec2 size(kSize);
  const auto start = Clock::now();
  for (int y = 0; y < size.y; y += kTile)
    for (int x = 0; x < size.x; x += kTile) {
      const auto pixels = trace::packedPixels({x, y}, glm::min(ivec2(x, y) + kTile, size));
      std::vector<trace::PixelSample> samples(pixels.size());
      for (std::uint32_t i = 0; i < kSamples; ++i) tracer.trace(pixels, i, samples, {});
    }
  return {.rays = tracer.statistics(), .seconds = secondsSince(start)};
}

Status measure(const std::string& name, int rounds) {
  LUCERNA_TRY(scene, scene::loadScene(name));
  scene::animate(scene, 0.f);
  trace::ReferenceSettings settings;
  settings.size = kSize;
  settings.aoRadius = 0.05f * scene.boundsW().diagonal();
  settings.view =
      viewOf(scene, scene.cameras[0], static_cast<float>(kSize.x) / static_cast<float>(kSize.y));
  trace::TracedScene traced(scene, settings);
  std::vector<Packet> packets;
  traced.observe = [&](std::span<const trace::Ray> rays, trace::RayKind kind) {
    pack(packets, rays, kind);
  };
  trace(traced);
  traced.observe = nullptr;
  const BareScene bare(scene);
  std::vector<double> ours, bares, others;
  std::uint64_t blocked = 0, count = 0;
  for (int round = 0; round < rounds; ++round) {
    const Round r = trace(traced);
    count = r.rays.closest + r.rays.occlusion;
    ours.push_back(r.rays.seconds);
    others.push_back(1. - r.rays.seconds / r.seconds);
    bares.push_back(follow(bare, packets, blocked));
  }
  const double millions = static_cast<double>(count) * 1e-6;
  fmt::print("{:24} {:>8.2f} {:>9.1f} {:>8.1f} {:>6.2f} {:>9.0f}%  {:>5.1f}%\n", name, millions,
             millions / median(ours), millions / median(bares), median(bares) / median(ours),
             100 * median(others),
             100. * static_cast<double>(blocked) / static_cast<double>(count));
  return {};
}

}  // namespace

int main(int count, char** words) {
  log::setLevel(log::Level::Error);
  const bool quick = isQuick(count, words);
  const int rounds = quick ? 1 : 7;
  std::vector<std::string> scenes(words + 1, words + count);
  if (quick) scenes = {"builtin:cornell"};
  if (scenes.empty()) scenes = {"builtin:cornell", "builtin:atrium", "builtin:nightcity"};
  fmt::print("{}x{}, {} samples a pixel, lights and ambient occlusion, one thread, medians of {}\n",
             kSize.x, kSize.y, kSamples, rounds);
  fmt::print("{:24} {:>8} {:>9} {:>8} {:>6} {:>10}  {:>6}\n", "scene", "Mrays", "ours/s", "bare/s",
             "ratio", "other work", "met");
  for (const std::string& name : scenes)
    if (const Status status = measure(name, rounds); !status) {
      fmt::print(stderr, "{}\n", status.error().message);
      return 1;
    }
  return 0;
}

// After the thesis (spec B, section 5.1.3): an octree, mailboxes, the last two hit triangles first.
#include <algorithm>
#include <array>

#include "bake/octree.hpp"
#include "bake/segment_test.hpp"
#include "bake/shadow_tracer.hpp"
#include "core/check.hpp"
#include "trace/material_lookup.hpp"

namespace lucerna::bake {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

std::vector<Octree::Corners> cornersOf(const World& world) {
  std::vector<Octree::Corners> triangles(world.triangleCount());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) triangles[i][k] = world.positions[world.indices[3 * i + k]];
  return triangles;
}

// Which triangles the ray under way has met, as far as a small table remembers: one that forgets
// only tests again (Benthin, "Realtime Ray Tracing on Current CPU Architectures", 2006).
class Mailboxes {
 public:
  void nextRay() { ++ray_; }
  // Whether it was marked before; marks it.
  bool mark(std::uint32_t triangle) {
    const std::uint64_t mail = (ray_ << 32) | triangle;
    std::uint64_t& box = boxes_[triangle % boxes_.size()];
    if (box == mail) return true;
    box = mail;
    return false;
  }

 private:
  std::array<std::uint64_t, 128> boxes_{};
  std::uint64_t ray_ = 0;  // from 1 on
};

// What one call of trace() keeps from ray to ray. Nothing of it changes what is found.
struct Scratch {
  Mailboxes mailboxes;
  std::array<std::uint32_t, 2> lastHits{kNone, kNone};  // opaque ones, the last first
  std::vector<std::uint32_t> passed;  // by the ray under way: triangles that let some light through
};

class OctreeTracer final : public ShadowTracer {
 public:
  OctreeTracer(const World& world, const OctreeSettings& settings)
      : world_(world),
        lookup_(*world.scene, mat4(1.f)),
        settings_(settings),
        triangles_(cornersOf(world)),
        opaque_(world.triangleCount()),
        octree_(triangles_, settings.leafSize) {
    for (std::size_t i = 0; i < opaque_.size(); ++i) {
      const scene::Object& object = world.scene->objects[world.objects[world.owners[i]].object];
      opaque_[i] = world.scene->materials[object.material].alphaMode == scene::AlphaMode::Opaque;
    }
  }

  void trace(const ShadowRays& rays, std::span<vec3> shares) const override {
    CHECK(rays.size() == shares.size());
    Scratch scratch;
    for (std::size_t i = 0; i < rays.size(); ++i)
      shares[i] = share({rays.fromX[i], rays.fromY[i], rays.fromZ[i]},
                        {rays.toX[i], rays.toY[i], rays.toZ[i]}, scratch);
  }

 private:
  vec3 share(vec3 from, vec3 to, Scratch& scratch) const {
    const SegmentTest segment(from, to, kClearOfLight, clearOfSample(to, from - to));
    scratch.mailboxes.nextRay();
    scratch.passed.clear();
    vec2 barycentric;
    for (std::size_t i = 0; i < scratch.lastHits.size(); ++i) {
      const std::uint32_t triangle = scratch.lastHits[i];
      if (triangle == kNone || !segment.meets(triangles_[triangle], barycentric)) continue;
      std::swap(scratch.lastHits[0], scratch.lastHits[i]);
      return vec3(0.f);
    }
    vec3 share(1.f);
    octree_.visit(from, to, [&](std::span<const std::uint32_t> leaf) {
      for (const std::uint32_t triangle : leaf) {
        if (settings_.mailboxes && scratch.mailboxes.mark(triangle)) continue;
        if (!segment.meets(triangles_[triangle], barycentric)) continue;
        if (opaque_[triangle]) {
          scratch.lastHits = {triangle, scratch.lastHits[0]};
          share = vec3(0.f);
        } else {
          pass(triangle, barycentric, from - to, scratch, share);
        }
        if (share == vec3(0.f)) return true;
      }
      return false;
    });
    return share;
  }

  // Each triangle once, in however many leaves it is met.
  void pass(std::uint32_t triangle, vec2 barycentric, vec3 toLightW, Scratch& scratch,
            vec3& share) const {
    if (std::ranges::find(scratch.passed, triangle) != scratch.passed.end()) return;
    scratch.passed.push_back(triangle);
    const WorldObject& object = world_.objects[world_.owners[triangle]];
    share *= trace::shareThrough(lookup_,
                                 {.object = object.object,
                                  .triangle = triangle - object.firstTriangle,
                                  .barycentric = barycentric},
                                 toLightW);
  }

  const World& world_;
  trace::MaterialLookup lookup_;
  OctreeSettings settings_;
  std::vector<Octree::Corners> triangles_;  // of the world
  std::vector<bool> opaque_;                // each of them
  Octree octree_;
};

}  // namespace

std::unique_ptr<ShadowTracer> makeOctreeTracer(const World& world, const OctreeSettings& settings) {
  return std::make_unique<OctreeTracer>(world, settings);
}

}  // namespace lucerna::bake

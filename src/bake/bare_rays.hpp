// How fast Embree answers shadow rays when nothing else is done: the measure of the baker's
// engines.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bake/shadow_tracer.hpp"

namespace lucerna::bake {

// How Embree is asked. By itself: as fast as it goes.
struct BareSettings {
  bool robust = false;           // RTC_SCENE_FLAG_ROBUST
  bool coherent = true;          // RTC_INTERSECT_CONTEXT_FLAG_COHERENT, of packets
  std::string instructionSet{};  // "avx2", ...; "": the best there is
};
// As the tracer asks it.
BareSettings likeTracer();

// Rays that lie ready in Embree's own form, against a scene in which everything is opaque, so that
// no filter is asked. One thread.
class BareRays {
 public:
  // Each list by itself is cut into packets of sixteen.
  BareRays(const World& world, std::span<const ShadowRays> lists,
           const BareSettings& settings = {});
  ~BareRays();
  BareRays(const BareRays&) = delete;
  BareRays& operator=(const BareRays&) = delete;

  std::size_t count() const;
  // Seconds that Embree takes for all rays once: in packets, and one by one in the same order.
  double packetSeconds();
  double singleSeconds();
  // Whether something is in the way of each, asked one by one.
  std::vector<bool> blockedOneByOne() const;
  // Of the last call that takes time: rays with something in the way.
  std::size_t blocked() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lucerna::bake

// How fast Embree answers shadow rays when nothing else is done: the measure of the baker's
// engines.
#pragma once

#include <memory>
#include <span>

#include "bake/shadow_tracer.hpp"

namespace lucerna::bake {

// Rays that lie ready in Embree's own form, against a scene in which everything is opaque, so that
// no filter is asked; with the instructions and the settings that are fastest: not robust, and
// packets marked as coherent. One thread.
class BareRays {
 public:
  // Each list by itself is cut into packets of sixteen.
  BareRays(const World& world, std::span<const ShadowRays> lists);
  ~BareRays();
  BareRays(const BareRays&) = delete;
  BareRays& operator=(const BareRays&) = delete;

  std::size_t count() const;
  // Seconds that Embree takes for all rays once: in packets, and one by one in the same order.
  double packetSeconds();
  double singleSeconds();
  // Of the last of these calls: rays with something in the way.
  std::size_t blocked() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lucerna::bake

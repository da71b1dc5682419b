// How often a tracer is wrong about what is in the way, on the rays that a bake is made of, for the
// tests of bake/. The truth: Embree in robust mode, one ray at a time.
#pragma once

#include <span>

#include "bake/plan.hpp"
#include "bake/shadow_tracer.hpp"

namespace lucerna::bake::testing {

struct VisibilityCount {
  std::size_t pairs = 0;    // of a point of a light and a sample that faces it
  std::size_t blocked = 0;  // of them, by the truth
  // The tracer says otherwise than the truth: at the edge of a shadow, which is where the truth
  // changes if the sample is moved by 1e-4 texels, by both or either of the chart's axes; and
  // elsewhere.
  std::size_t atEdges = 0, wrong = 0;
};

// Of at least so many pairs: every sample of blocks of chance, and for each block a point of chance
// of every light. The plan's materials are all opaque.
VisibilityCount checkVisibility(const Plan& plan, const ShadowTracer& tracer,
                                std::span<const scene::PlacedLight> lights, std::size_t pairs,
                                std::uint64_t seed = 1);

}  // namespace lucerna::bake::testing

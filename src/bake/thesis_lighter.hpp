// Direct light on the samples of a block, by engine `octree`: as Vonásek, "Zobrazování rozsáhlých
// scén s předpočteným osvětlením" (2014), sections 5.1.3 and 6.2, and his program go about it, the
// baseline.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/emitters.hpp"
#include "bake/light_points.hpp"
#include "bake/lighter.hpp"
#include "bake/shadow_tracer.hpp"

namespace lucerna::bake {

// Every cell as a light by itself, whatever its distance.
std::vector<scene::PlacedLight> cellLights(const Emitters& emitters, const scene::Scene& scene);

// Triangle by triangle, light by light and sample by sample: those beyond the light's reach are
// skipped, the others shaded, and one ray is followed if that gives anything. Of surfaces that
// shine cells that do not reach the triangle are left out before. A light with a size, which the
// thesis has none of, is as many lights as LighterSettings::lightSamples, other ones for each place
// of a texel. If uneven texels are asked for, lights come first and triangles second. One thread's.
class ThesisLighter final : public Lighter {
 public:
  // Tracer and cells outlive it.
  ThesisLighter(const ShadowTracer& tracer, std::span<const scene::PlacedLight> cells,
                const LighterSettings& settings);

  bool light(const Samples& samples, std::span<const scene::PlacedLight> lights, bool emitters,
             std::vector<vec3>& texels, Uneven* uneven) override;

 private:
  // Samples of one triangle, at one place of their texels.
  struct Part {
    std::span<const std::uint32_t> samples;
    vec2 shift{0.f};  // of the points of lights
    Aabb boundsW;
  };
  void lightAgain(const Samples& samples, std::span<const scene::PlacedLight> lights,
                  std::uint32_t light) override;
  void sortByTriangle(const Samples& samples);
  void lightParts(const Samples& samples, std::span<const scene::PlacedLight> lights,
                  bool emitters);
  void lightByOne(const Samples& samples, std::span<const scene::PlacedLight> lights,
                  std::uint32_t light);
  bool lightOneByOne(const Samples& samples, std::span<const scene::PlacedLight> lights,
                     bool emitters, std::vector<vec3>& texels, Uneven& uneven);
  void lightPart(const Samples& samples, const Part& part,
                 std::span<const scene::PlacedLight> lights, bool emitters);
  void lightBySphere(const Samples& samples, const Part& part, const scene::PlacedLight& sphere,
                     int points);
  // share: of its intensity.
  void lightBy(const Samples& samples, const Part& part, const LightPoint& point, float share);
  void flush();

  const ShadowTracer& tracer_;
  std::span<const scene::PlacedLight> cells_;
  std::vector<std::uint32_t> order_;  // samples by triangle and place
  // Of the rays that are to be traced next, in the thesis' order:
  ShadowRays rays_;
  std::vector<std::uint32_t> lit_;  // samples that they lead to
  std::vector<vec3> values_;        // what these get if nothing is in the way
  std::vector<vec3> shares_;        // of the light that they let through
};

}  // namespace lucerna::bake

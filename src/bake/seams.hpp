// Seams closed: where two charts share an edge of a smooth surface, both show the same light there,
// so that no step is seen. Least squares over the texels that lookups along seams read: differences
// between the sides vanish while texels stay close to what was baked (Iwanicki, "Lighting
// Technology of The Last Of Us", SIGGRAPH 2013 Talks).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bake/assemble.hpp"
#include "bake/plan.hpp"
#include "bake/seam_system.hpp"

namespace lucerna::bake {

// What a white surface shows at the scene's exposure, and irradiance.
class Brightness {
 public:
  explicit Brightness(const scene::Scene& scene) : white_(irradianceOfWhite(scene)) {}
  glm::dvec3 of(vec3 irradiance) const { return glm::dvec3(irradiance) / white_; }
  std::array<std::uint16_t, 3> halves(glm::dvec3 brightness) const;  // of irradiance

 private:
  double white_;
};

// Steps across seams: of the brightness of a white surface at the scene's exposure, irradiance / pi
// * 2^EV within 0 and 1, the channel that differs most; everything that switches is on. Of halves,
// as they are stored, at points between those that were solved for; percentiles of the seams'
// length in texels.
struct SeamSteps {
  double median = 0., percentile99 = 0., largest = 0.;
};
// The same of maps as a copy in that encoding has them; groups as they are.
struct EncodedSteps {
  Encoding encoding;
  SeamSteps after;
};
struct SeamReport {
  std::uint64_t seams = 0;    // edges
  std::uint64_t texels = 0;   // unknowns
  std::uint64_t samples = 0;  // points where both sides ought to agree
  std::uint64_t parts = 0;    // solved each by itself
  std::uint64_t mostIterations = 0;
  SeamSteps before, after;
  std::vector<EncodedSteps> encoded;  // of copies that the settings ask for, but PNG
  double seconds = 0.;
};

// The seams of a plan, once, and then light in them: after dilate(), as what that gave texels
// beside the charts is where they start. The maps and each group are solved alike, so that a
// group's light and the rest still add up. The same result for any number of threads. Ctrl-C
// (Progress::cancelled()) ends it early, with some seams open.
class Seams {
 public:
  Seams(const Plan& plan, const MapTexels& texels);

  // The maps, or some groups, or all at once; each once, the maps first.
  void close(BakedLight& baked);
  SeamReport report() const;  // of what was closed so far

 private:
  void closeMaps(BakedLight& baked);
  void closeGroups(BakedLight& baked);

  const Plan& plan_;
  Brightness brightness_;
  std::optional<SeamSystem> system_;  // none: no seams
  SeamReport report_;
  // What unknowns show: everything before; the maps after, also as encoded; groups after.
  std::vector<vec3> before_, maps_, groups_;
  std::vector<std::vector<vec3>> encodedMaps_;  // as report_.encoded
};

SeamReport closeSeams(const Plan& plan, BakedLight& baked);  // all of it

}  // namespace lucerna::bake

// All that a bake decides before the first ray: charts and their places, lights, and the units of
// work that shards share out. The same scene and settings give the same plan.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bake/charts.hpp"
#include "bake/light_set.hpp"
#include "bake/pack_masks.hpp"
#include "bake/samples.hpp"
#include "bake/world.hpp"
#include "core/result.hpp"
#include "lightmap/layout.hpp"

namespace lucerna::bake {

enum class Engine { Embree, Octree };

// How finely light is sampled.
struct Sampling {
  int positions;      // along each side of a texel
  int finePositions;  // the same of texels at the edges of shadows; 0: no others
  int lightSamples;   // points on a light with a size, see LighterSettings
  float emitterSize;  // of an emitting surface for one ray / its distance
  // Of a texel's light that one ray to an emitting surface stands for at most, if the texel has one
  // position.
  float emitterShare;
  int skyDirections;  // lights that stand for the sky, see skyLights()
  int skyPoints;      // on each of them, see LighterSettings
  bool operator==(const Sampling&) const = default;
};
// The presets of `lucerna bake`.
inline constexpr Sampling kPreview{.positions = 1,
                                   .finePositions = 0,
                                   .lightSamples = 1,
                                   .emitterSize = 0.5f,
                                   .emitterShare = 1.f,
                                   .skyDirections = 64,
                                   .skyPoints = 16};
inline constexpr Sampling kStandard{.positions = 1,
                                    .finePositions = 3,
                                    .lightSamples = 16,
                                    .emitterSize = 0.25f,
                                    .emitterShare = 1.f / 16,
                                    .skyDirections = 128,
                                    .skyPoints = 32};
inline constexpr Sampling kFinal{.positions = 4,
                                 .finePositions = 8,
                                 .lightSamples = 32,
                                 .emitterSize = 0.05f,
                                 .emitterShare = 1.f,
                                 .skyDirections = 256,
                                 .skyPoints = 4};

struct Preset {
  const char* name;
  Sampling sampling;
};
inline constexpr Preset kPresets[]{
    {"preview", kPreview}, {"standard", kStandard}, {"final", kFinal}};

// Of maps, beside their masters.
enum class Encoding { Rgb9e5, Bc6h, Png };

struct BakeSettings {
  Unwrap unwrap = Unwrap::Charts;
  float density = 10.f;  // texels a metre
  PackSettings pack;
  Sampling sampling = kStandard;
  float reach = std::numeric_limits<float>::infinity();  // m that lights reach at most
  // An emitting surface reaches to where it gives a white one no more than this brightness at the
  // scene's exposure; 0: as far as `reach`.
  float faintest = 1.f / 256;
  vec3 sky{0.f};                    // radiance of all directions that meet nothing
  std::vector<std::string> groups;  // of lights that are baked; empty: all
  // By how much a patch may differ from its light: brightness of a white surface before exposure;
  // absent: 1/1024 of what shows as white at the scene's exposure.
  std::optional<float> patchTolerance;
  Engine engine = Engine::Embree;
  std::vector<Encoding> encodings;
};

// Blocks that are lit and stored together.
struct Unit {
  std::uint32_t firstBlock = 0, blocks = 0;
  std::uint32_t texels = 0;  // of the blocks, those that touch nothing too
};

struct Plan {
  BakeSettings settings;
  World world;
  Charts charts;
  PackedCharts packed;  // as charts
  std::vector<Block> blocks;
  std::vector<Unit> units;
  std::vector<LightGroup> groups;  // [0] is what is always on
  bool alwaysOn = true;            // lights without a group, and emitting surfaces, are baked
  std::uint64_t hash = 0;          // of everything that the light depends on
  std::vector<std::string> warnings;

  std::uint64_t texels() const;         // of all charts' rectangles
  std::uint64_t coveredTexels() const;  // of them those that a chart's triangles touch
  // Whether emitting surfaces light others.
  bool emittersShine() const { return alwaysOn && world.scene->bake.areaLights; }
};

// The scene outlives the plan. Errors: a scene without triangles (ErrorKind::Input), maps that
// cannot hold it (ErrorKind::Usage; the message says a density that fits), an unknown group of
// lights (ErrorKind::Usage).
Result<Plan> makePlan(const scene::Scene& scene, const BakeSettings& settings);

// A texel of a chart in the maps, and a point in the chart's texels.
ivec2 placed(const Plan& plan, std::uint32_t chart, ivec2 texel);
vec2 placed(const Plan& plan, std::uint32_t chart, vec2 point);

// The irradiance that a white surface shows as white at the scene's exposure.
float irradianceOfWhite(const scene::Scene& scene);

// The scene's lights among all, the sky's left out.
std::size_t lightCount(const Plan& plan);

lightmap::Layout layoutOf(const Plan& plan);

}  // namespace lucerna::bake

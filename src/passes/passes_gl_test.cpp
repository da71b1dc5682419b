// What must hold for every pass when it draws: each parameter at its ends, each row disabled, and
// deferred against forward shading.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/metrics.hpp"
#include "scene/load.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{64, 36};

// Rows that run the pass, the value they make, and values that the pass needs.
struct Stage {
  std::vector<std::string> rows;
  std::string value;
  graph::ParamValues params{};
};

Stage stageOf(const std::string& type) {
  if (type == "Forward") return {testing::kForwardRows, "ToneMap.color"};
  if (type == "Fullscreen")  // of any format, so nobody reads it
    return {{"Cull", "GBuffer", "TiledLighting", "ToneMap", "Fullscreen"}, "Fullscreen.color"};
  if (type == "ScreenSpaceAo")
    return {{"Cull", "GBuffer", "CustomShaders", type, "TiledLighting", "ToneMap"},
            "ToneMap.color"};
  if (type == "ShadowMaps" || type == "TiledLighting")
    return {{"Cull", "GBuffer", "ShadowMaps", "TiledLighting", "ToneMap"}, "ToneMap.color"};
  if (type == "PrefilteredShadows")
    return {{"Cull", "GBuffer", "ShadowMaps", type, "TiledLighting", "ToneMap"}, "ToneMap.color"};
  if (type == "TileLights" || type == "ShadowLayers" || type == "ShadowMask" ||
      type == "ShadowTiles" || type == "NearestBlockers" || type == "Penumbra" ||
      type == "ShadowBlur" || type == "LayeredTransmittance")
    return {{"Cull", "GBuffer", "ShadowMaps", "TileLights", "ShadowLayers", "ShadowMask",
             "ShadowTiles", "NearestBlockers", "Penumbra", "ShadowBlur", "LayeredTransmittance",
             "TiledLighting", "ToneMap"},
            "ToneMap.color"};
  if (type == "SaveImage")
    return {{"Cull", "GBuffer", "TiledLighting", "ToneMap", "SaveImage"},
            "ToneMap.color",
            {{"file", ::testing::TempDir() + "lucerna-each-pass.png"}}};
  if (type == "Fxaa") return {{"Cull", "GBuffer", "TiledLighting", "ToneMap", type}, "Fxaa.color"};
  if (type == "GeometrySamples" || type == "Sraa")
    return {{"Cull", "GBuffer", "TiledLighting", "ToneMap", "GeometrySamples", "Sraa"},
            "Sraa.color"};
  if (type == "ShowGBuffer")
    return {{"Cull", "GBuffer", "TiledLighting", "ToneMap", "ShowGBuffer"}, "ShowGBuffer.color"};
  if (std::ranges::find(testing::kDeferredRows, type) != testing::kDeferredRows.end())
    return {testing::kDeferredRows, "ToneMap.color"};
  return {{"Cull", "GBuffer", "TiledLighting", type, "ToneMap"}, "ToneMap.color"};
}

// With layered or prefiltered shadows, if there is who makes them.
graph::Pipeline pipelineOf(const Stage& stage) {
  graph::Pipeline pipeline = testing::rows(stage.rows);
  pipeline.output = stage.value;
  for (graph::PassRow& row : pipeline.passes) {
    for (const auto& [maker, shadows] :
         {std::pair{"ShadowBlur", "layered"}, std::pair{"PrefilteredShadows", "prefiltered"}})
      if (row.type == "TiledLighting" && std::ranges::find(stage.rows, maker) != stage.rows.end())
        row.params["shadows"] = std::string(shadows);
    if (row.type == "Penumbra" || row.type == "LayeredTransmittance")
      row.params["method"] = std::string("minimum");
  }
  return pipeline;
}

// Values at the ends of a parameter's range.
std::vector<graph::Value> extremes(const graph::ParamDescription& param) {
  using graph::ParamType;
  std::vector<graph::Value> values;
  switch (param.type) {
    case ParamType::Bool:
      return {false, true};
    case ParamType::Choice:
      for (const std::string& choice : param.choices) values.emplace_back(choice);
      return values;
    case ParamType::Int:
      return {static_cast<std::int64_t>(*param.min), static_cast<std::int64_t>(*param.max)};
    case ParamType::Float:
      return {*param.min, *param.max};
    case ParamType::Color:
    case ParamType::Vector:
      for (const double value : {param.min.value_or(0), param.max.value_or(1)})
        values.emplace_back(std::vector<double>(param.size, value));
      return values;
    case ParamType::Text:
    case ParamType::File:
      return {param.defaultValue};
  }
  return values;
}

bool allFinite(const Image& image) {
  const Image values = converted(image, ComponentType::F32, 4);
  return std::ranges::all_of(values.as<float>(), [](float v) { return std::isfinite(v); });
}

class EachPassDraws : public ::testing::TestWithParam<std::string> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
};
INSTANTIATE_TEST_SUITE_P(Passes, EachPassDraws,
                         ::testing::ValuesIn(testing::registry().typeNames()),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(EachPassDraws, FiniteValuesAtTheEndsOfEachParameter) {
  const scene::Scene scene = testing::sampleScene();
  testing::SceneRenderer renderer(scene);
  const Stage stage = stageOf(GetParam());
  const std::string own = GetParam() + ".color";
  const graph::PassDescription description = testing::registry().find(GetParam())->describe({});
  const bool makesColor = description.output("color") != nullptr;
  std::vector<std::string> kept;
  if (makesColor) kept.push_back(own);
  for (const graph::ParamDescription& param : description.params)
    for (const graph::Value& value : stage.params.contains(param.name)
                                         ? std::vector{stage.params.at(param.name)}
                                         : extremes(param)) {
      SCOPED_TRACE(param.name + "=" + graph::toText(value));
      graph::Pipeline pipeline = pipelineOf(stage);
      for (graph::PassRow& row : pipeline.passes)
        if (row.type == GetParam()) row.params[param.name] = value;
      auto output = renderer.render(pipeline, kSize, kept);
      ASSERT_TRUE(output) << output.error().message;
      EXPECT_TRUE(allFinite(output->picture));
      if (makesColor) {
        ASSERT_TRUE(output->kept.contains(own));
        EXPECT_TRUE(allFinite(output->kept.at(own)));
      }
    }
}

TEST_P(EachPassDraws, NothingWrongWhileItIsDisabled) {
  if (GetParam() == "Cull") GTEST_SKIP() << "Cull has no stand-in: disabling it is refused";
  const scene::Scene scene = testing::sampleScene();
  testing::SceneRenderer renderer(scene);
  const Stage stage = stageOf(GetParam());
  graph::Pipeline pipeline = pipelineOf(stage);
  pipeline.output = "";
  for (graph::PassRow& row : pipeline.passes) row.enabled = row.type != GetParam();
  auto output = renderer.render(pipeline, kSize, testing::radianceNames(pipeline));
  ASSERT_TRUE(output) << output.error().message;
  EXPECT_TRUE(allFinite(output->picture));
  for (const auto& [name, radiance] : output->kept) EXPECT_TRUE(allFinite(radiance)) << name;
}

}  // namespace
}  // namespace lucerna

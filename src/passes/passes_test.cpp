// What holds for every pass that ships, without a GPU.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "graph/validate.hpp"
#include "passes/register_passes.hpp"

namespace lucerna::passes {
namespace {

using Type = graph::ParamType;

const graph::Registry& registry() {
  static const graph::Registry* const kRegistry = [] {
    auto* made = new graph::Registry;
    registerPasses(*made);
    return made;
  }();
  return *kRegistry;
}

graph::Pipeline rows(const std::vector<std::string>& types) {
  graph::Pipeline pipeline;
  for (const std::string& type : types) {
    graph::PassRow& row = pipeline.passes.emplace_back();
    row.name = row.type = type;
  }
  return pipeline;
}

graph::Validation validated(const graph::Pipeline& pipeline) {
  return graph::validate(pipeline, registry(), gpu::Capabilities::baseline());
}

const std::vector<std::string> kDeferred = {
    "Cull", "GBuffer", "TiledLighting", "CustomShaders", "Background", "Transparency", "ToneMap"};
const std::vector<std::string> kForward = {"Cull", "Forward", "Background", "Transparency",
                                           "ToneMap"};

class EachPass : public ::testing::TestWithParam<std::string> {
 protected:
  graph::PassDescription description_ = registry().find(GetParam())->describe({});
};
INSTANTIATE_TEST_SUITE_P(Passes, EachPass, ::testing::ValuesIn(registry().typeNames()),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(EachPass, SaysInOneSentenceWhatItDoes) {
  EXPECT_EQ(description_.type, GetParam());
  EXPECT_TRUE(description_.summary.ends_with('.')) << description_.summary;
  EXPECT_EQ(std::ranges::count(description_.summary, '.'), 1) << description_.summary;
}

TEST_P(EachPass, DocumentsItsParametersWithRangesThatHoldTheDefaults) {
  for (const graph::ParamDescription& param : description_.params) {
    SCOPED_TRACE(param.name);
    EXPECT_FALSE(param.help.empty());
    if (param.type == Type::Choice) {
      const auto* name = std::get_if<std::string>(&param.defaultValue);
      ASSERT_NE(name, nullptr) << "a choice's default is one of its names";
      EXPECT_THAT(param.choices, ::testing::Contains(*name));
    }
    if (param.type == Type::Int || param.type == Type::Float) {
      ASSERT_TRUE(param.min && param.max) << "numbers have a range";
      const auto* real = std::get_if<double>(&param.defaultValue);
      const auto* whole = std::get_if<std::int64_t>(&param.defaultValue);
      const double value = real ? *real : static_cast<double>(*whole);
      EXPECT_GE(value, *param.min);
      EXPECT_LE(value, *param.max);
    }
  }
}

TEST_P(EachPass, DocumentsItsPortsAndStatesOneFormatForEachTextureItMakes) {
  EXPECT_FALSE(description_.ports.empty());
  for (const graph::PortDescription& port : description_.ports) {
    SCOPED_TRACE(port.name);
    EXPECT_FALSE(port.help.empty());
    if (port.makes() && port.type.texture) {
      EXPECT_EQ(port.type.texture->formats.size(), 1u);
      EXPECT_NE(port.standIn.kind, graph::StandIn::Kind::None)
          << "a disabled pass must leave something to its readers";
    }
  }
}

TEST(ShippedRows, OfTheDeferredPipelineAreValidWithoutWarnings) {
  const graph::Validation validation = validated(rows(kDeferred));
  EXPECT_TRUE(validation.ok());
  EXPECT_EQ(validation.text(), "");
}

TEST(ShippedRows, OfTheForwardPipelineAreValidWithoutWarnings) {
  const graph::Validation validation = validated(rows(kForward));
  EXPECT_TRUE(validation.ok());
  EXPECT_EQ(validation.text(), "");
}

TEST(ShippedRows, MayBeDisabledOneByOneButForCull) {
  for (const auto& types : {kDeferred, kForward})
    for (std::size_t i = 0; i < types.size(); ++i) {
      graph::Pipeline pipeline = rows(types);
      pipeline.passes[i].enabled = false;
      // Whatever comes last makes the picture.
      pipeline.output = types[i] == "ToneMap" ? "Transparency.color" : "ToneMap.color";
      const graph::Validation validation = validated(pipeline);
      EXPECT_EQ(validation.ok(), types[i] != "Cull") << types[i] << ":\n" << validation.text();
    }
}

TEST(ShippedRows, InAnOrderThatReadsBeforeWritingAreRefused) {
  const graph::Validation validation =
      validated(rows({"Cull", "TiledLighting", "GBuffer", "ToneMap"}));
  EXPECT_FALSE(validation.ok());
}

// They would begin another picture, in black.
TEST(ShippedRows, ThatDrawRadianceAreRefusedBehindToneMap) {
  for (const char* last : {"TiledLighting", "CustomShaders", "Transparency", "Background"}) {
    SCOPED_TRACE(last);
    EXPECT_THAT(
        validated(rows({"Cull", "GBuffer", "Forward", "ToneMap", last})).text(),
        ::testing::AllOf(::testing::HasSubstr("input 'color' [FormatMismatch]"),
                         ::testing::HasSubstr("'ToneMap.color', a 2D texture (Rgba8Unorm)"),
                         ::testing::HasSubstr("move this row before the pass that made it")));
  }
}

TEST(ShippedRows, ThatDrawOverAPictureWantItsDepthBufferAsLarge) {
  graph::Pipeline pipeline =
      rows({"Cull", "GBuffer", "TiledLighting", "Fullscreen", "Transparency", "ToneMap"});
  EXPECT_TRUE(validated(pipeline).ok());
  pipeline.passes[3].params["outputScale"] = 0.5;
  EXPECT_THAT(validated(pipeline).text(), ::testing::HasSubstr("SizeMismatch"));
}

TEST(ShippedRows, DrawCustomShadersBeforeOrAfterTheLighting) {
  for (const auto& types : {std::vector<std::string>{"CustomShaders", "TiledLighting"},
                            std::vector<std::string>{"TiledLighting", "CustomShaders"}}) {
    const graph::Validation validation =
        validated(rows({"Cull", "GBuffer", types[0], types[1], "Background", "ToneMap"}));
    EXPECT_EQ(validation.text(), "");
  }
}

TEST(ShippedRows, ShowTheHierarchyBeforeOrAfterToneMapping) {
  EXPECT_TRUE(validated(rows({"Cull", "GBuffer", "TiledLighting", "ShowBvh", "ToneMap"})).ok());
  EXPECT_TRUE(validated(rows({"Cull", "GBuffer", "TiledLighting", "ToneMap", "ShowBvh"})).ok());
}

}  // namespace
}  // namespace lucerna::passes

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/file.hpp"
#include "graph/validate.hpp"
#include "passes/fullscreen/shader_interface.hpp"
#include "passes/register_passes.hpp"

namespace lucerna::passes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Type = graph::ParamType;

ShaderInterface interfaceOf(std::string_view text) {
  const gpu::EmbeddedShader shader{"test.frag", text};
  gpu::ShaderSources sources;
  sources.add({&shader, 1});
  return readInterface(sources.expand("test.frag", {}).value());
}

TEST(ShaderInterface, FindsUniformsWithValuesAndComments) {
  const ShaderInterface found = interfaceOf(R"(// uniform float no;
/* uniform float
   no; */
#define DECLARE uniform \
  float no;
layout(binding = 3) uniform highp sampler2D depth;  // Reversed depth.
uniform vec3 ink = vec3(0.5, -1e-2f, 1), paper;
  uniform
  float weights[3] = {1.0, 2.0, 3.0};
uniform int[2] pair;
struct Light { vec3 color; };
float function(float uniforms) { float uniform_ = 1.0; return uniform_; }
uniform float last = 2.;)");
  std::vector<std::string> texts;
  for (const auto& u : found.uniforms)
    texts.push_back(u.type + (u.isArray ? "[] " : " ") + u.name + "=" + u.initial + " " + u.place);
  EXPECT_THAT(texts,
              ElementsAre("sampler2D depth= test.frag:6", "vec3 ink=vec3(0.5,-1e-2f,1) test.frag:7",
                          "vec3 paper= test.frag:7", "float[] weights= test.frag:9",
                          "int[] pair= test.frag:10", "float last=2. test.frag:13"));
  EXPECT_EQ(found.uniforms[0].comment, "Reversed depth.");
  EXPECT_THAT(found.blocks, IsEmpty());
}

TEST(ShaderInterface, FindsBlocksAndSurvivesTextThatIsNoShader) {
  const ShaderInterface found = interfaceOf(
      "layout(std140) uniform ViewBlock { mat4 m; } view;\nreadonly buffer Lights { vec4 l[]; "
      "};\n");
  ASSERT_EQ(found.blocks.size(), 2u);
  EXPECT_EQ(found.blocks[0].name, "ViewBlock");
  EXPECT_EQ(found.blocks[1].name, "Lights");
  EXPECT_EQ(found.blocks[1].place, "test.frag:2");
  for (const char* text : {"uniform", "uniform float", "uniform float a = (", "{{{", "}}", "/*",
                           "/", "uniform [", "uniform float a[", "uniform layout(", "#\\", "\\"})
    interfaceOf(text);
}

// Pipelines around a Fullscreen row whose shader is a file.
class FullscreenRowTest : public testing::Test {
 protected:
  void SetUp() override {
    registerPasses(registry_);
    std::string pattern = testing::TempDir() + "lucerna-fullscreen-XXXXXX";
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    EXPECT_TRUE(writeText(folder_ / name, text));
    return (folder_ / name).string();
  }
  graph::PassDescription describe(const std::string& shader) const {
    return registry_.find("Fullscreen")->describe({{"shader", shader}});
  }
  // Cull, GBuffer, TiledLighting and the row.
  static graph::Pipeline pipelineWith(graph::ParamValues params,
                                      std::map<std::string, std::string> reads = {}) {
    graph::Pipeline pipeline;
    for (const char* type : {"Cull", "GBuffer", "TiledLighting", "Fullscreen"}) {
      graph::PassRow& row = pipeline.passes.emplace_back();
      row.name = row.type = type;
    }
    pipeline.passes.back().params = std::move(params);
    pipeline.passes.back().reads = std::move(reads);
    return pipeline;
  }
  graph::Validation validated(const graph::Pipeline& pipeline) const {
    return graph::validate(pipeline, registry_, gpu::Capabilities::baseline());
  }
  // The one fault, as "Kind: place | found | wanted".
  std::string faultOf(const graph::Pipeline& pipeline) const {
    const graph::Validation validation = validated(pipeline);
    if (validation.faults.size() != 1) return validation.text();
    const graph::Fault& fault = validation.faults[0];
    return std::string(graph::nameOf(fault.kind)) + ": " + fault.place + " | " + fault.found +
           " | " + fault.wanted;
  }

  graph::Registry registry_;
  std::filesystem::path folder_;
};

TEST_F(FullscreenRowTest, SamplersArePortsAndUniformsParameters) {
  const std::string shader = write("a.frag",
                                   "#include \"render/view.glsl\"\n#include \"own.glsl\"\n"
                                   "uniform sampler2D color;  // The picture.\n"
                                   "uniform usampler2D material;\n"
                                   "uniform float time;\nuniform int frame;\n"
                                   "void main() {}\n");
  write("own.glsl",
        "uniform float reach = 0.5;  // 0 to 2 m: How far.\n"
        "uniform vec3 ink = vec3(0.25);  // color: of lines\n"
        "uniform int count = 3;\nuniform bool on = true;\nuniform vec2 shift;\n"
        "uniform vec4 box = vec4(1, 2, 3, 4);\n");
  const graph::PassDescription d = describe(shader);
  EXPECT_THAT(d.faults, IsEmpty());

  ASSERT_NE(d.input("color"), nullptr);
  EXPECT_EQ(d.input("color")->help, "The picture.");
  EXPECT_EQ(d.input("color")->halo, graph::kWholeImage) << "a shader may read anywhere";
  EXPECT_EQ(d.input("color")->type.text(), "a 2D texture (any unorm or any float or any depth)");
  EXPECT_EQ(d.input("material")->type.text(), "a 2D texture (any unsigned integer)");
  ASSERT_NE(d.input("view"), nullptr) << "the shader includes ViewBlock";
  ASSERT_NE(d.output("color"), nullptr);
  EXPECT_EQ(d.output("color")->standIn.kind, graph::StandIn::Kind::PassThrough);

  EXPECT_EQ(d.param("time"), nullptr) << "the program gives it";
  EXPECT_EQ(d.param("frame"), nullptr);
  const graph::ParamDescription& reach = *d.param("reach");
  EXPECT_EQ(reach.type, Type::Float);
  EXPECT_EQ(graph::toText(reach.defaultValue), "0.5");
  EXPECT_EQ(reach.min, 0);
  EXPECT_EQ(reach.max, 2);
  EXPECT_EQ(reach.unit, "m");
  EXPECT_EQ(reach.help, "How far.");
  EXPECT_EQ(d.param("ink")->type, Type::Color);
  EXPECT_EQ(graph::toText(d.param("ink")->defaultValue), "[0.25, 0.25, 0.25]");
  EXPECT_EQ(d.param("count")->type, Type::Int);
  EXPECT_EQ(graph::toText(d.param("on")->defaultValue), "true");
  EXPECT_EQ(graph::toText(d.param("shift")->defaultValue), "[0, 0]");
  EXPECT_EQ(d.param("box")->size, 4u);
}

TEST_F(FullscreenRowTest, FormatSizeAndHaloAreTheRows) {
  const graph::PassDescription d = registry_.find("Fullscreen")
                                       ->describe({{"format", std::string("R32Float")},
                                                   {"outputScale", 0.5},
                                                   {"halo", std::int64_t{2}}});
  EXPECT_EQ(d.output("color")->type.text(), "a 2D texture (R32Float)");
  EXPECT_EQ(d.output("color")->size.scale, 0.5f);
  EXPECT_EQ(d.input("color")->halo, 2);
}

TEST_F(FullscreenRowTest, AFittingRowIsValidAndReadsWhatItNames) {
  const std::string shader = write(
      "a.frag", "uniform sampler2D color, depth, before;\nuniform float amount;\nvoid main() {}\n");
  const graph::Validation validation = validated(pipelineWith(
      {{"shader", shader}, {"amount", std::int64_t{2}}}, {{"before", "GBuffer.albedo"}}));
  ASSERT_TRUE(validation.ok()) << validation.text();
  const graph::ResolvedRow& row = validation.plan->rows.back();
  EXPECT_EQ(row.input("color")->source.row, 2u);
  EXPECT_EQ(row.input("depth")->source.row, 1u) << "by its name, as every input";
  EXPECT_EQ(row.input("before")->source.port, "albedo");
}

TEST_F(FullscreenRowTest, EveryMisfitIsOneFaultThatNamesIt) {
  const std::string shader = write(
      "a.frag",
      "uniform sampler2D color;\nuniform float amount = 1.0;  // 0 to 1: x\nvoid main() {}\n");
  EXPECT_THAT(faultOf(pipelineWith({{"shader", shader}, {"amuont", 1.0}})),
              HasSubstr("UnknownParameter: row 4, pass 'Fullscreen', parameter 'amuont'"));
  EXPECT_THAT(faultOf(pipelineWith({{"shader", shader}, {"amount", true}})),
              HasSubstr("WrongValueType: row 4, pass 'Fullscreen', parameter 'amount'"));
  EXPECT_THAT(faultOf(pipelineWith({{"shader", shader}, {"amount", 2.0}})),
              HasSubstr("ValueOutOfRange"));
  EXPECT_THAT(faultOf(pipelineWith({{"shader", shader}}, {{"colour", "TiledLighting.color"}})),
              HasSubstr("UnknownPort: row 4, pass 'Fullscreen', reads 'colour'"));
  EXPECT_THAT(faultOf(pipelineWith({{"shader", shader}}, {{"color", "GBuffer.material"}})),
              HasSubstr("FormatMismatch"));
  EXPECT_THAT(faultOf(pipelineWith({{"shader", shader}, {"format", std::string("Depth32F")}})),
              HasSubstr("ValueOutOfRange"));
}

TEST_F(FullscreenRowTest, AShaderThatCannotBeUsedIsOneFaultWithItsFileAndLine) {
  const auto faultWith = [&](const std::string& text) {
    return faultOf(pipelineWith({{"shader", write("b.frag", text)}, {"amount", 1.0}},
                                {{"extra", "GBuffer.albedo"}}));
  };
  EXPECT_THAT(faultOf(pipelineWith({{"shader", "/nowhere/x.frag"}, {"amount", 1.0}})),
              HasSubstr("UnusableValue: row 4, pass 'Fullscreen', parameter 'shader' | "
                        "/nowhere/x.frag: cannot be opened"));
  EXPECT_THAT(faultWith("\n#include \"nowhere.glsl\"\n"), HasSubstr("b.frag:2: error: no shader"));
  EXPECT_THAT(faultWith("\nuniform mat4 m;\n"),
              HasSubstr("b.frag:2: the uniform 'm' of type mat4"));
  EXPECT_THAT(faultWith("uniform float w[4];\n"), HasSubstr("'w' of type float[]"));
  EXPECT_THAT(faultWith("uniform float w = 2.0 * 3.0;\n"), HasSubstr("a literal of type float"));
  EXPECT_THAT(faultWith("uniform vec2 w = vec2(1, 2, 3);\n"), HasSubstr("a literal of type vec2"));
  EXPECT_THAT(faultWith("uniform float w = 3.0;  // 0 to 1: x\n"), HasSubstr("from 0 to 1"));
  EXPECT_THAT(faultWith("uniform float halo;\n"), HasSubstr("Fullscreen's own parameters"));
  EXPECT_THAT(faultWith("uniform float a;\nuniform int a;\n"), HasSubstr("b.frag:2"));
  EXPECT_THAT(faultWith("uniform Lights { vec4 l; };\n"), HasSubstr("the block 'Lights'"));
}

}  // namespace
}  // namespace lucerna::passes

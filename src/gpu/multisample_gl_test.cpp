// Multisampled targets: where their samples lie, and what is drawn to each.
#include <array>

#include "gpu/gl_test_fixture.hpp"

namespace lucerna::gpu {
namespace {

constexpr int kSamples = 4;

class MultisampleGlTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    device().shaderSources().add(kShaders);
  }

  static constexpr EmbeddedShader kShaders[] = {
      // All that lies left of (axis 0) or below (axis 1) an edge.
      {"test/half_plane.vert",
       "uniform float edge;\nuniform int axis;\n"
       "void main() {\n"
       "  float e = 2.0 * edge - 1.0;\n"
       "  vec2 p = gl_VertexID == 2 ? vec2(-1e3, 0.0) : vec2(e, gl_VertexID == 0 ? -1e3 : 1e3);\n"
       "  gl_Position = vec4(axis == 0 ? p : p.yx, 1.0, 1.0);\n}\n"},
      {"test/one.frag",
       "layout(location = 0) out vec4 result;\nvoid main() { result = vec4(1.0); }\n"},
      {"test/sample.frag",
       "uniform sampler2DMS source;\nuniform int index;\nlayout(location = 0) out vec4 result;\n"
       "void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), index); }\n"},
      {"test/place.frag",
       "layout(location = 0) in vec2 uv;\nlayout(location = 0) out vec4 result;\nvoid main() {\n"
       "#ifdef EACH_SAMPLE\n  result = vec4(interpolateAtSample(uv, gl_SampleID), 0.0, 1.0);\n"
       "#else\n  result = vec4(uv, 0.0, 1.0);\n#endif\n}\n"},
  };

  Texture multisampled(Format format) {
    return device().createTexture(
        {.kind = TextureKind::Multisample2D, .format = format, .samples = kSamples}, "samples");
  }
  std::array<vec4, kSamples> samplesOf(const Texture& texture) {
    std::array<vec4, kSamples> found;
    const Texture one = target(Format::Rgba32Float, 1, 1);
    const ProgramPtr program =
        device().program({.vertex = "gpu/fullscreen.vert", .fragment = "test/sample.frag"});
    for (int i = 0; i < kSamples; ++i) {
      program->set("index", i);
      {
        Rendering rendering = device().render({.colors = {{&one, Load::Discard}}});
        rendering.use(*program, {});
        rendering.texture("source", texture, kNearest);
        rendering.fullscreen();
      }
      found[static_cast<std::size_t>(i)] = firstPixel(one);
    }
    return found;
  }
};

TEST_F(MultisampleGlTest, SamplesAreCoveredAtTheirPositions) {
  const ProgramPtr program =
      device().program({.vertex = "test/half_plane.vert", .fragment = "test/one.frag"});
  for (const Format format : {Format::R8Unorm, Format::Rg16Unorm, Format::Depth32F}) {
    const Texture texture = multisampled(format);
    const std::vector<vec2> positions = device().samplePositions(texture);
    ASSERT_EQ(positions.size(), std::size_t{kSamples});
    for (int axis = 0; axis < 2; ++axis)
      for (int step = 0; step < 32; ++step) {
        const float edge = (static_cast<float>(step) + 0.5f) / 32.f;
        program->set("edge", edge);
        program->set("axis", axis);
        {
          Rendering rendering = format == Format::Depth32F
                                    ? device().render({.depth = {&texture, Load::Clear}})
                                    : device().render({.colors = {{&texture, Load::Clear}}});
          rendering.use(*program, {.depthWrite = format == Format::Depth32F, .cull = Cull::None});
          rendering.fullscreen();
        }
        const auto samples = samplesOf(texture);
        for (std::size_t i = 0; i < positions.size(); ++i)
          EXPECT_EQ(samples[i].x, positions[i][axis] < edge ? 1.f : 0.f)
              << info(format).name << ", axis " << axis << ", edge " << edge << ", sample " << i;
      }
  }
}

TEST_F(MultisampleGlTest, ShadersThatReadAtSamplesRunForEach) {
  const Texture texture = multisampled(Format::Rg32Float);
  const std::vector<vec2> positions = device().samplePositions(texture);
  for (const bool each : {true, false}) {
    ProgramDesc desc{.vertex = "gpu/fullscreen.vert", .fragment = "test/place.frag"};
    if (each) desc.defines["EACH_SAMPLE"] = "1";
    const ProgramPtr program = device().program(desc);
    {
      Rendering rendering = device().render({.colors = {{&texture, Load::Discard}}});
      rendering.use(*program, {});
      rendering.fullscreen();
    }
    const auto samples = samplesOf(texture);
    for (std::size_t i = 0; i < positions.size(); ++i)
      for (int axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(samples[i][axis], each ? positions[i][axis] : 0.5f, 1e-5f) << i;
  }
}

TEST_F(MultisampleGlTest, ClearReachesAllSamples) {
  for (const Format format : {Format::R8Unorm, Format::Depth32F}) {
    const Texture texture = multisampled(format);
    for (const float value : {1.f, 0.f}) {
      device().clear(texture, vec4(value));
      for (const vec4& sample : samplesOf(texture)) EXPECT_EQ(sample.x, value);
    }
  }
}

}  // namespace
}  // namespace lucerna::gpu

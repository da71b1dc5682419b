#include "passes/fullscreen/row_description.hpp"

#include <algorithm>
#include <set>

#include "core/text.hpp"
#include "graph/pass_info.hpp"
#include "passes/fullscreen/uniform_param.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {
namespace {

using gpu::FormatClass;

// What every row has; the ports are added by the shader.
struct FixedPorts {
  graph::Out<gpu::Texture> color;
};
using FixedInfo = graph::PassInfo<FullscreenRow::Params, FixedPorts>;

std::vector<std::string> targetFormats() {
  std::vector<std::string> names;
  for (const gpu::FormatInfo& format : gpu::allFormats())
    if (format.renderable &&
        (format.kind == FormatClass::Float || format.kind == FormatClass::Unorm))
      names.emplace_back(format.name);
  return names;
}

void describeFixed(FixedInfo& d) {
  d.pass("Fullscreen", "Draws the whole picture with a fragment shader of your own.");
  d.param("shader", &FullscreenRow::Params::shader)
      .file()
      .rebuilds(graph::Rebuild::Ports)
      .help("The fragment shader; its samplers become ports, its uniforms parameters.");
  d.param("format", &FullscreenRow::Params::format)
      .choices(targetFormats())
      .rebuilds(graph::Rebuild::Ports)
      .help("Of the picture made: Rgba16Float for radiance, Rgba8Unorm after ToneMap.");
  d.param("outputScale", &FullscreenRow::Params::outputScale)
      .range(1.0 / 64, 4)
      .rebuilds(graph::Rebuild::Ports)
      .help("Size of the picture made, relative to the output.");
  d.param("smooth", &FullscreenRow::Params::smooth)
      .help("Textures are read with bilinear filtering; depth and integers never are.");
  d.param("halo", &FullscreenRow::Params::halo)
      .range(graph::kWholeImage, 4096)
      .unit("px")
      .rebuilds(graph::Rebuild::Ports)
      .help("How far around a pixel the shader reads; -1, which is always safe: anywhere.");
}

struct SamplerInfo {
  std::string_view glsl;
  gpu::TextureKind kind;
  std::vector<FormatClass> accepted;
};

const SamplerInfo* findSampler(std::string_view glslType) {
  static const std::vector<FormatClass> kReal{FormatClass::Float, FormatClass::Unorm,
                                              FormatClass::Depth};
  static const std::vector<SamplerInfo> kSamplers{
      {"sampler2D", gpu::TextureKind::Plain2D, kReal},
      {"isampler2D", gpu::TextureKind::Plain2D, {FormatClass::Int}},
      {"usampler2D", gpu::TextureKind::Plain2D, {FormatClass::Uint}},
      {"sampler2DArray", gpu::TextureKind::Array2D, kReal},
      {"samplerCube", gpu::TextureKind::Cube, kReal},
      {"sampler2DMS", gpu::TextureKind::Multisample2D, kReal}};
  const auto found = std::ranges::find(kSamplers, glslType, &SamplerInfo::glsl);
  return found == kSamplers.end() ? nullptr : &*found;
}

graph::PortDescription inputOf(const ShaderInterface::Uniform& uniform, const SamplerInfo& sampler,
                               int halo) {
  graph::PortDescription port{.name = uniform.name, .halo = halo, .help = uniform.comment};
  port.type.texture = graph::TextureSpec{.kind = sampler.kind};
  for (const gpu::FormatInfo& format : gpu::allFormats())
    if (std::ranges::find(sampler.accepted, format.kind) != sampler.accepted.end())
      port.type.texture->formats.push_back(format.format);
  return port;
}

// Adds to the description what the shader declares.
class Describer {
 public:
  explicit Describer(FullscreenRow& row) : row_(row), d_(row.description) {}

  void run() {
    for (const ShaderInterface::Uniform& uniform : row_.interface.uniforms) addUniform(uniform);
    for (const ShaderInterface::Block& block : row_.interface.blocks) addBlock(block);
  }

 private:
  void fault(const std::string& place, const std::string& found, std::string wanted,
             std::string remedy) {
    d_.faults.push_back({.param = "shader",
                         .found = fmt::format("{}: {}", place, found),
                         .wanted = std::move(wanted),
                         .remedy = std::move(remedy)});
  }

  void addUniform(const ShaderInterface::Uniform& uniform) {
    const auto what = [&] { return fmt::format("the uniform '{}'", uniform.name); };
    if (!seen_.insert(uniform.name).second)
      return fault(uniform.place, what() + ", which is declared before",
                   "one declaration of each uniform; #if is not looked at here", "remove one");
    if (isGiven(uniform)) return;
    const SamplerInfo* sampler = findSampler(uniform.type);
    if (uniform.isArray || (!sampler && !isParamType(uniform.type)))
      return fault(
          uniform.place,
          fmt::format("{} of type {}{}", what(), uniform.type, uniform.isArray ? "[]" : ""),
          "float, int, bool, vec2, vec3, vec4 or a sampler of 2D textures, arrays or cubes",
          "declare it as one of these");
    if (sampler) {
      d_.ports.push_back(inputOf(uniform, *sampler, row_.params.halo));
      return;
    }
    if (d_.param(uniform.name))
      return fault(uniform.place, what() + ", whose name is one of Fullscreen's own parameters",
                   "another name", "rename it");
    graph::ValueFault bad;
    auto param = paramOf(uniform, bad);
    if (!param)
      return fault(uniform.place, fmt::format("{}, which begins as {}", what(), bad.found),
                   bad.wanted, bad.remedy);
    d_.params.push_back(std::move(*param));
  }

  void addBlock(const ShaderInterface::Block& block) {
    if (block.name != kViewBlock)
      return fault(block.place, fmt::format("the block '{}'", block.name),
                   fmt::format("uniforms, samplers and {} of render/view.glsl", kViewBlock),
                   "a pass in C++ can bind other blocks: docs/dev/adding_a_pass.md");
    graph::PortDescription& port = d_.ports.emplace_back();
    port.name = kViewPort;
    port.type = graph::dataPortType<render::ViewData>();
    port.help = "The view that is drawn, as the block ViewBlock.";
  }

  FullscreenRow& row_;
  graph::PassDescription& d_;
  std::set<std::string> seen_;
};

void addOutput(FullscreenRow& row) {
  graph::PortDescription port;
  port.name = "color";
  port.direction = graph::Direction::Out;
  port.type.texture = graph::TextureSpec{.formats = {*gpu::formatFromName(row.params.format)}};
  port.size.scale = row.params.outputScale;
  port.standIn.kind = graph::StandIn::Kind::Fill;
  if (row.description.input("color"))
    port.standIn = {.kind = graph::StandIn::Kind::PassThrough, .input = "color"};
  port.help = "What the shader writes.";
  row.description.ports.push_back(std::move(port));
}

}  // namespace

FullscreenRow describeFullscreen(gpu::ShaderSources& sources, const graph::ParamValues& values) {
  FullscreenRow row;
  FixedInfo info(row.params);
  describeFixed(info);
  info.assign(row.params, values);
  row.description = info.description();
  row.fixedParams = row.description.params.size();
  if (auto shader = sources.expand(row.params.shader, {})) {
    row.interface = readInterface(*shader);
    Describer(row).run();
  } else {
    row.description.faults.push_back({.param = "shader",
                                      .found = shader.error().message,
                                      .wanted = "a fragment shader",
                                      .remedy = "correct the path, which is relative to the "
                                                "pipeline's file, or the shader"});
  }
  addOutput(row);
  return row;
}

bool isGiven(const ShaderInterface::Uniform& uniform) {
  if (uniform.isArray || !uniform.initial.empty()) return false;
  return (uniform.name == "time" && uniform.type == "float") ||
         (uniform.name == "frame" && uniform.type == "int");
}

}  // namespace lucerna::passes

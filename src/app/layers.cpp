#include "app/layers.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "core/text.hpp"

namespace lucerna::app {
namespace {

struct LayerInfo {
  LayerKind kind;
  const char* name;  // of the layer and of the port
  std::vector<std::string> channels;
};

const std::vector<LayerInfo>& layerInfos() {
  static const std::vector<LayerInfo> infos{{LayerKind::Color, "color", {"R", "G", "B"}},
                                            {LayerKind::Depth, "depth", {"Z"}},
                                            {LayerKind::Normal, "normal", {"X", "Y", "Z"}},
                                            {LayerKind::Albedo, "albedo", {"R", "G", "B"}}};
  return infos;
}

const LayerInfo& infoOf(LayerKind kind) {
  return layerInfos()[static_cast<std::size_t>(kind)];
}

bool isHdr(const graph::PortType& type) {
  if (!type.texture || type.texture->formats.size() != 1) return false;
  return gpu::info(type.texture->formats[0]).kind == gpu::FormatClass::Float;
}

// Walks from the output back through inputs of the same name until a float texture is found; "" if
// there is none.
std::string hdrColorPort(const graph::Pipeline& pipeline, const graph::Plan& plan) {
  graph::Source source = plan.output;
  for (std::size_t hops = 0; hops <= plan.rows.size(); ++hops) {
    if (source.kind != graph::Source::Kind::Output) return "";
    if (isHdr(source.type)) return pipeline.passes[source.row].name + "." + source.port;
    const auto row = std::find_if(plan.rows.begin(), plan.rows.end(),
                                  [&](const graph::ResolvedRow& r) { return r.row == source.row; });
    if (row == plan.rows.end()) return "";
    const auto input =
        std::find_if(row->inputs.begin(), row->inputs.end(),
                     [&](const graph::ResolvedInput& i) { return i.port == source.port; });
    if (input == row->inputs.end()) return "";
    source = input->source;
  }
  return "";
}

std::string lastPort(const graph::Pipeline& pipeline, const graph::Plan& plan,
                     const std::string& name) {
  for (auto row = plan.rows.rbegin(); row != plan.rows.rend(); ++row) {
    const graph::PortDescription* port = row->description.output(name);
    if (port && port->type.texture) return pipeline.passes[row->row].name + "." + name;
  }
  return "";
}

std::string outputPort(const graph::Pipeline& pipeline, const graph::Plan& plan) {
  return pipeline.passes[plan.output.row].name + "." + plan.output.port;
}

// U8 is sRGB-encoded, floats are linear already. Three channels.
Image linearRgb(const Image& image) {
  Image result = converted(image, ComponentType::F32, 3);
  if (image.type() == ComponentType::U8)
    for (float& value : result.as<float>()) value = linearFromSrgb(value);
  return result;
}

// Metres along -z of the view from reversed depth: clip z / clip w = depth, solved for z.
Image viewDepth(const Image& depth, const scene::View& view) {
  Image result = converted(depth, ComponentType::F32, 1);
  const mat4& p = view.clipFromView;
  for (float& value : result.as<float>()) {
    const float z = (value * p[3][3] - p[3][2]) / (p[2][2] - value * p[2][3]);
    value = value > 0.f ? -z : std::numeric_limits<float>::infinity();
  }
  return result;
}

// Octahedral normals in view space (render/normal_encoding.glsl) to world space.
Image worldNormals(const Image& encoded, const Image* depth, const scene::View& view) {
  const Image two = converted(encoded, ComponentType::F32, 2);
  Image result(two.width(), two.height(), 3, ComponentType::F32);
  const mat3 worldFromView(view.worldFromView);
  for (int y = 0; y < two.height(); ++y)
    for (int x = 0; x < two.width(); ++x) {
      if (depth && *depth->pixel<float>(x, y) <= 0.f) continue;
      const float* e = two.pixel<float>(x, y);
      vec2 p(e[0] * 2.f - 1.f, e[1] * 2.f - 1.f);
      const float z = 1.f - std::abs(p.x) - std::abs(p.y);
      if (z < 0.f)
        p = {(1.f - std::abs(p.y)) * (p.x < 0.f ? -1.f : 1.f),
             (1.f - std::abs(p.x)) * (p.y < 0.f ? -1.f : 1.f)};
      const vec3 normalW = worldFromView * glm::normalize(vec3(p, z));
      std::copy_n(&normalW.x, 3, result.pixel<float>(x, y));
    }
  return result;
}

}  // namespace

std::vector<std::string> layerNames() {
  std::vector<std::string> names;
  for (const LayerInfo& info : layerInfos()) names.emplace_back(info.name);
  return names;
}

Result<LayerKind> layerFromName(const std::string& name) {
  for (const LayerInfo& info : layerInfos())
    if (name == info.name) return info.kind;
  const std::vector<std::string> names = layerNames();
  return error(ErrorKind::Usage, "--layers: '{}' is not a layer{}; there are {}", name,
               didYouMean(name, names), join(names));
}

Result<std::vector<LayerSource>> findLayers(const graph::Pipeline& pipeline,
                                            const graph::Plan& plan,
                                            const std::vector<LayerKind>& kinds) {
  std::vector<LayerSource> sources;
  for (const LayerKind kind : kinds) {
    std::string port = kind == LayerKind::Color ? hdrColorPort(pipeline, plan)
                                                : lastPort(pipeline, plan, infoOf(kind).name);
    if (port.empty() && kind == LayerKind::Color) port = outputPort(pipeline, plan);
    if (port.empty())
      return error(ErrorKind::Usage,
                   "--layers: no pass of pipeline '{}' writes '{}'; leave the layer out or take a "
                   "pipeline with a pass that does, like 'deferred'",
                   pipeline.name, infoOf(kind).name);
    sources.push_back({kind, std::move(port)});
  }
  return sources;
}

ExrLayer readLayer(gpu::Device& device, LayerKind kind, const gpu::Texture& texture,
                   const gpu::Texture* depth, const scene::View& view) {
  const Image image = device.download(texture);
  ExrLayer layer{.name = kind == LayerKind::Color ? "" : infoOf(kind).name,
                 .channels = infoOf(kind).channels,
                 .image = {}};
  switch (kind) {
    case LayerKind::Color:
    case LayerKind::Albedo:
      layer.image = linearRgb(image);
      break;
    case LayerKind::Depth:
      layer.image = viewDepth(image, view);
      break;
    case LayerKind::Normal: {
      Image covered;
      if (depth) covered = converted(device.download(*depth), ComponentType::F32, 1);
      layer.image = worldNormals(image, depth ? &covered : nullptr, view);
      break;
    }
  }
  return layer;
}

}  // namespace lucerna::app

#include "passes/fullscreen/fullscreen.hpp"

#include <algorithm>

#include "gpu/device.hpp"
#include "graph/value_check.hpp"
#include "passes/fullscreen/row_description.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {
namespace {

void setUniform(const gpu::Program& program, const graph::ParamDescription& param,
                const graph::Value& value) {
  using graph::ParamType;
  if (param.type == ParamType::Bool) return program.set(param.name, std::get<bool>(value));
  if (param.type == ParamType::Int)
    return program.set(param.name, static_cast<int>(std::get<std::int64_t>(value)));
  if (param.type == ParamType::Float)
    return program.set(param.name, static_cast<float>(*graph::asNumber(value)));
  vec4 v(0.f);
  const auto& numbers = std::get<std::vector<double>>(value);
  for (std::size_t i = 0; i < param.size; ++i)
    v[static_cast<int>(i)] = static_cast<float>(numbers[i]);
  if (param.size == 2) program.set(param.name, vec2(v));
  if (param.size == 3) program.set(param.name, vec3(v));
  if (param.size == 4) program.set(param.name, v);
}

// What the linked program reads although its text did not seem to declare it: a macro made it.
const gpu::ProgramInput* undeclared(const ShaderInterface& interface,
                                    const std::vector<gpu::ProgramInput>& inputs) {
  const auto found = std::ranges::find_if(inputs, [&](const gpu::ProgramInput& input) {
    if (input.type == "block")
      return std::ranges::find(interface.blocks, input.name, &ShaderInterface::Block::name) ==
             interface.blocks.end();
    return std::ranges::none_of(interface.uniforms, [&](const ShaderInterface::Uniform& uniform) {
      return uniform.name == input.name && uniform.type == input.type;
    });
  });
  return found == inputs.end() ? nullptr : &*found;
}

class FullscreenInstance final : public graph::PassInstance {
 public:
  FullscreenInstance(gpu::Device& device, std::shared_ptr<gpu::ShaderSources> sources)
      : device_(device), sources_(std::move(sources)) {}

  void setParams(const graph::ParamValues& values) override {
    row_ = describeFullscreen(*sources_, values);
    values_.clear();
    for (const auto& [name, value] : values)  // the file may have changed since it was validated
      if (const auto* param = row_.description.param(name);
          param && !graph::checkValue(*param, value))
        values_[name] = value;
    program_ = device_.program({.vertex = "gpu/fullscreen.vert", .fragment = row_.params.shader});
    const auto inputs = program_->inputs();
    const gpu::ProgramInput* hidden = undeclared(row_.interface, inputs);
    fits_ = program_->usable() && !hidden;
    if (hidden)
      device_.reportError(
          error(ErrorKind::Pipeline,
                "{}: error: '{}' ({}) is read, but no declaration of it was found; declare it at "
                "global scope without macros",
                row_.params.shader, hidden->name, hidden->type));
  }

  void execute(graph::PassContext& context, std::span<const graph::BoundPort> ports) override {
    if (!fits_) return;  // reported
    const auto& output = ports.back();
    gpu::Rendering draw =
        context.device.render({.colors = {{output.texture, gpu::Load::Clear}}, .depth = {}});
    draw.use(*program_, {.cull = gpu::Cull::None});
    setUniforms(context);
    for (const graph::BoundPort& port : ports.first(ports.size() - 1))
      if (port.texture)
        draw.texture(port.port->name, *port.texture, samplerOf(*port.texture));
      else
        draw.buffer(kViewBlock, static_cast<const render::ViewData*>(port.data)->block);
    draw.fullscreen();
  }

 private:
  void setUniforms(const graph::PassContext& context) const {
    for (const ShaderInterface::Uniform& uniform : row_.interface.uniforms) {
      if (!isGiven(uniform)) continue;
      if (uniform.name == "time")
        program_->set("time", static_cast<float>(context.time));
      else
        program_->set("frame", static_cast<int>(context.frame));
    }
    const auto& params = row_.description.params;
    for (std::size_t i = row_.fixedParams; i < params.size(); ++i) {
      const auto given = values_.find(params[i].name);
      setUniform(*program_, params[i],
                 given == values_.end() ? params[i].defaultValue : given->second);
    }
  }

  gpu::Sampler samplerOf(const gpu::Texture& texture) const {
    const gpu::FormatClass kind = gpu::info(texture.format()).kind;
    const bool real = kind == gpu::FormatClass::Float || kind == gpu::FormatClass::Unorm;
    return row_.params.smooth && real ? gpu::kLinear : gpu::kNearest;
  }

  gpu::Device& device_;
  std::shared_ptr<gpu::ShaderSources> sources_;
  FullscreenRow row_;
  graph::ParamValues values_;
  gpu::ProgramPtr program_;
  bool fits_ = false;
};

class FullscreenType final : public graph::PassType {
 public:
  explicit FullscreenType(std::shared_ptr<gpu::ShaderSources> sources)
      : sources_(std::move(sources)) {}

  graph::PassDescription describe(const graph::ParamValues& values) const override {
    return describeFullscreen(*sources_, values).description;
  }
  std::unique_ptr<graph::PassInstance> create(gpu::Device& device) const override {
    return std::make_unique<FullscreenInstance>(device, sources_);
  }

 private:
  std::shared_ptr<gpu::ShaderSources> sources_;
};

}  // namespace

std::unique_ptr<graph::PassType> fullscreenType(std::shared_ptr<gpu::ShaderSources> sources) {
  return std::make_unique<FullscreenType>(std::move(sources));
}

}  // namespace lucerna::passes

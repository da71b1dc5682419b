#include "render/custom_programs.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/log.hpp"

namespace lucerna::render {
namespace {

// What drawList() and ForwardShading bind for every program.
constexpr std::array kBlocks = {"ViewBlock", "LightBlock", "ObjectBlock", "DrawOrderBlock",
                                "MaterialBlock"};
constexpr std::array kTextures = {
    "albedoTexture",    "emissiveTexture", "normalTexture", "metallicRoughnessTexture",
    "occlusionTexture", "specularTexture", "albedoCube",    "emissiveCube"};
// What the files that a custom shader includes declare for the renderer to set.
constexpr std::array kUniforms = {"time", "ambientScale"};
constexpr std::string_view kLightmaps = "lightmaps";
constexpr const char* kInterface = "render/custom_shader.glsl";

std::string typeOf(const scene::CustomShader::Parameter& parameter) {
  return parameter.size == 1 ? "float" : fmt::format("vec{}", parameter.size);
}

void set(const gpu::Program& program, const scene::CustomShader::Parameter& parameter) {
  switch (parameter.size) {
    case 1:
      return program.set(parameter.name, parameter.value.x);
    case 2:
      return program.set(parameter.name, vec2(parameter.value));
    case 3:
      return program.set(parameter.name, vec3(parameter.value));
    default:
      return program.set(parameter.name, parameter.value);
  }
}

bool isAmong(std::span<const char* const> names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

// What is wrong with something that the shader reads; empty if it is there.
std::string missing(const gpu::ProgramInput& input, const scene::Scene& scene,
                    const scene::Material& material) {
  if (input.type == "block")
    return isAmong(kBlocks, input.name)
               ? ""
               : fmt::format("it reads the block '{}', wanted none of its own", input.name);
  const bool isOpaque = input.type.find("sampler") != std::string::npos ||
                        input.type.find("image") != std::string::npos;
  if (!isOpaque) return "";
  // Declared where there is baked light alone (render/baked_light.glsl).
  if (input.name == kLightmaps && input.type == "sampler2DArray") return "";
  const bool cube = input.type == "samplerCube";
  if (!cube && input.type != "sampler2D")
    return fmt::format("it reads the {} '{}', wanted sampler2D or samplerCube", input.type,
                       input.name);
  if (isAmong(kTextures, input.name)) return "";
  const auto& textures = material.shader.textures;
  const auto given = std::ranges::find(textures, input.name, &scene::CustomShader::Picture::name);
  if (given != textures.end() && scene.textures[given->texture].isCube() == cube) return "";
  return fmt::format("it reads the {} '{}', wanted {} of that name among the material's textures",
                     input.type, input.name, cube ? "six \"faces\"" : "a \"file\"");
}

}  // namespace

CustomPrograms::CustomPrograms(gpu::Device& device, std::map<std::string, std::string> defines)
    : device_(device), defines_(std::move(defines)) {}

const gpu::Program* CustomPrograms::of(const scene::Scene& scene, const scene::Material& material,
                                       double time, bool baked) {
  gpu::ProgramDesc desc{.vertex = "render/object.vert",
                        .fragment = material.shader.file,
                        .compute = {},
                        .defines = defines_};
  desc.defines["CUSTOM_SHADER"] = "1";
  if (material.alphaMode == scene::AlphaMode::Mask) desc.defines["ALPHA_TEST"] = "1";
  if (usesTextureEnvironment(material)) desc.defines["TEXTURE_ENVIRONMENT"] = "1";
  if (baked) desc.defines["BAKED_LIGHT"] = "1";
  const gpu::ProgramPtr program = device_.program(desc);  // the device keeps it
  if (!program->usable() || !isCustomShader(*program, material) ||
      !takesParameters(*program, material) || !hasAllInputs(*program, scene, material))
    return nullptr;
  program->reset();  // to what a material with the same shader left there
  for (const auto& parameter : material.shader.parameters) set(*program, parameter);
  program->set("time", static_cast<float>(time));
  return program.get();
}

bool CustomPrograms::isCustomShader(const gpu::Program& program, const scene::Material& material) {
  if (!program.includes(kInterface)) {
    refuse(material, fmt::format("it does not include \"{}\"; wanted that and a function "
                                 "vec3 radianceOf(Surface s)",
                                 kInterface));
    return false;
  }
  for (const auto& parameter : material.shader.parameters)
    if (isAmong(kUniforms, parameter.name)) return refuseOwnName(material, parameter.name);
  for (const auto& texture : material.shader.textures)
    if (isAmong(kTextures, texture.name) || texture.name == kLightmaps)
      return refuseOwnName(material, texture.name);
  return true;
}

bool CustomPrograms::refuseOwnName(const scene::Material& material, const std::string& name) {
  refuse(material, fmt::format("'{}' is set by Lucerna; wanted a name of the shader's own", name));
  return false;
}

bool CustomPrograms::takesParameters(const gpu::Program& program, const scene::Material& material) {
  const std::vector<gpu::ProgramInput>& inputs = program.inputs();
  for (const auto& parameter : material.shader.parameters) {
    const auto input = std::ranges::find(inputs, parameter.name, &gpu::ProgramInput::name);
    if (input == inputs.end()) {
      const std::string text = fmt::format(
          "material '{}': {} reads no uniform '{}'; declare and use it, or remove the parameter",
          material.name, material.shader.file, parameter.name);
      if (warned_.insert(text).second) log::warning("{}", text);
    } else if (input->type != typeOf(parameter)) {
      refuse(material,
             fmt::format("the parameter '{}' is {}, but the uniform is {}; wanted the same",
                         parameter.name, typeOf(parameter), input->type));
      return false;
    }
  }
  return true;
}

bool CustomPrograms::hasAllInputs(const gpu::Program& program, const scene::Scene& scene,
                                  const scene::Material& material) {
  for (const gpu::ProgramInput& input : program.inputs()) {
    const std::string problem = missing(input, scene, material);
    if (problem.empty()) continue;
    refuse(material, problem);
    return false;
  }
  return true;
}

void CustomPrograms::refuse(const scene::Material& material, const std::string& problem) {
  device_.reportError(error(ErrorKind::Pipeline, "{}: error: in material '{}': {}",
                            material.shader.file, material.name, problem));
}

}  // namespace lucerna::render

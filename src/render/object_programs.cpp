#include "render/object_programs.hpp"

namespace lucerna::render {

ObjectPrograms::ObjectPrograms(gpu::Device& device, std::string fragment,
                               std::map<std::string, std::string> defines)
    : device_(device),
      desc_{.vertex = "render/object.vert",
            .fragment = std::move(fragment),
            .compute = {},
            .defines = std::move(defines)} {}

const gpu::Program& ObjectPrograms::of(const scene::Material& material, bool baked) {
  const bool alphaTest = material.alphaMode == scene::AlphaMode::Mask;
  const bool environment = usesTextureEnvironment(material);
  gpu::ProgramPtr& variant =
      variants_[(alphaTest ? 1u : 0u) + (environment ? 2u : 0u) + (baked ? 4u : 0u)];
  if (variant && variant->usable()) return *variant;
  gpu::ProgramDesc desc = desc_;
  if (alphaTest) desc.defines["ALPHA_TEST"] = "1";
  if (environment) desc.defines["TEXTURE_ENVIRONMENT"] = "1";
  if (baked) desc.defines["BAKED_LIGHT"] = "1";
  variant = device_.program(desc);
  return *variant;
}

}  // namespace lucerna::render

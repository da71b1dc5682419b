// Materials and background of a scene JSON.
#include <algorithm>

#include "core/text.hpp"
#include "scene/scene_json_parts.hpp"

namespace lucerna::scene {
namespace {

constexpr std::initializer_list<const char*> kEmissiveKeys = {
    "file", "faces", "wrap", "coordinates", "planeS", "planeT", "offset", "scale", "rotation"};
constexpr std::initializer_list<const char*> kAlbedoKeys = {
    "file",   "faces", "wrap",     "coordinates", "planeS",    "planeT",
    "offset", "scale", "rotation", "combine",     "blendColor"};

void readAlbedoTexture(const JsonValue& from, JsonPictures& pictures, Material& material) {
  if (!from.object(kAlbedoKeys)) return;
  readSlot(from, pictures, material.albedoTexture);
  int choice = 0;
  if (from.readChoice("combine", {"modulate", "decal", "blend", "add", "replace"}, choice))
    material.combine = static_cast<Combine>(choice);
  from.read("blendColor", material.blendColor, kUnitRange);
}

void readEmissiveTexture(const JsonValue& from, JsonPictures& pictures, Material& material) {
  if (from.object(kEmissiveKeys)) readSlot(from, pictures, material.emissiveTexture);
}

void readParameter(const std::string& name, const JsonValue& from, CustomShader& shader) {
  CustomShader::Parameter parameter{.name = name};
  if (from.isNumber()) {
    if (!from.number(parameter.value.x, kAnyNumber)) return;
  } else {
    const std::size_t size = from.isList() ? from.elements().size() : 0;
    if (size < 2 || size > 4) return from.wrong("a number, or a list of 2 to 4 numbers");
    if (!from.numbers({glm::value_ptr(parameter.value), size}, kAnyNumber)) return;
    parameter.size = static_cast<int>(size);
  }
  shader.parameters.push_back(std::move(parameter));
}

void readShaderTexture(const std::string& name, const JsonValue& from, JsonPictures& pictures,
                       CustomShader& shader) {
  if (!from.object({"file", "faces", "wrap", "data"})) return;
  CustomShader::Picture picture{.name = name, .texture = pictures.read(from)};
  from.read("data", picture.data);
  if (picture.texture != kNone) shader.textures.push_back(std::move(picture));
}

void readShader(const JsonValue& from, JsonPictures& pictures, Material& material) {
  if (!from.object({"file", "parameters", "textures"})) return;
  CustomShader shader;
  std::string file;
  if (!from.has("file")) return from.wrong("no \"file\"", "a fragment shader");
  if (!from.read("file", file) || !pictures.mayRead(from.at("file"))) return;
  std::error_code code;
  const auto path = std::filesystem::absolute(pictures.folder() / file, code).lexically_normal();
  if (!std::filesystem::is_regular_file(path, code))
    return from.at("file").wrong(fmt::format("{}, which is no file", path.string()),
                                 "a fragment shader that includes \"render/custom_shader.glsl\"");
  shader.file = path.string();
  if (from.has("parameters"))
    for (const auto& [name, value] : from.at("parameters").members())
      readParameter(name, value, shader);
  if (from.has("textures"))
    for (const auto& [name, value] : from.at("textures").members())
      readShaderTexture(name, value, pictures, shader);
  material.shader = std::move(shader);
}

void readMaterial(const JsonValue& from, JsonPictures& pictures, Material& material) {
  int choice = 0;
  if (from.readChoice("model", {"phong", "metallic-roughness", "unlit", "specular-glossiness"},
                      choice))
    material.model = static_cast<MaterialModel>(choice);
  vec3 albedo(material.albedo);
  if (from.read("albedo", albedo, kUnitRange)) material.albedo = vec4(albedo, material.albedo.w);
  if (from.read("opacity", material.albedo.w, kUnitRange) && material.albedo.w < 1.f)
    material.alphaMode = AlphaMode::Blend;
  if (from.readChoice("alphaMode", {"opaque", "mask", "blend"}, choice))
    material.alphaMode = static_cast<AlphaMode>(choice);
  from.read("alphaCutoff", material.alphaCutoff, kUnitRange);
  from.read("transmission", material.transmission, kUnitRange);
  from.read("emissive", material.emissive, kNotNegative);
  from.read("doubleSided", material.doubleSided);
  from.read("specular", material.specular, kUnitRange);
  from.read("shininess", material.shininess, {0.f, 255.f});
  from.read("metallic", material.metallic, kUnitRange);
  from.read("roughness", material.roughness, kUnitRange);
  from.read("reflectivity", material.reflectivity, kUnitRange);
  if (from.has("albedoTexture")) readAlbedoTexture(from.at("albedoTexture"), pictures, material);
  if (from.has("emissiveTexture"))
    readEmissiveTexture(from.at("emissiveTexture"), pictures, material);
  if (from.has("shader")) readShader(from.at("shader"), pictures, material);
}

}  // namespace

void readMaterials(const JsonValue& materials, JsonPictures& pictures, Scene& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  for (const auto& [name, from] : materials.members()) {
    if (!from.object({"model", "albedo", "opacity", "alphaMode", "alphaCutoff", "transmission",
                      "emissive", "doubleSided", "specular", "shininess", "metallic", "roughness",
                      "albedoTexture", "emissiveTexture", "reflectivity", "shader"}))
      continue;
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      from.fault(fmt::format("the scene has no material '{}'{}; wanted one of its {} materials",
                             name, didYouMean(name, names), names.size()));
      continue;
    }
    for (Material& material : scene.materials)
      if (material.name == name) readMaterial(from, pictures, material);
  }
}

void readBackground(const JsonValue& from, JsonPictures& pictures, Background& background) {
  if (!from.object({"color", "image", "faces", "intensity"})) return;
  if (from.has("image") && from.has("faces"))
    return from.wrong("both \"image\" and \"faces\"", "one of them");
  if (from.read("color", background.color, kNotNegative)) background.kind = BackgroundKind::Color;
  from.read("intensity", background.intensity, kNotNegative);
  if (!from.has("image") && !from.has("faces")) return;
  background.texture =
      from.has("image") ? pictures.add(from.at("image")) : pictures.addCube(from.at("faces"));
  if (background.texture == kNone) return;
  background.kind = from.has("image") ? BackgroundKind::Image : BackgroundKind::CubeMap;
}

}  // namespace lucerna::scene

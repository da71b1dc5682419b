// Materials and background of a scene JSON.
#include <algorithm>

#include "core/text.hpp"
#include "scene/scene_json_parts.hpp"
#include "scene/texture_store.hpp"

namespace lucerna::scene {
namespace {

void readMaterial(const JsonValue& from, Material& material) {
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
}

std::uint32_t addPicture(const JsonValue& value, const std::filesystem::path& folder,
                         SceneLoad& load) {
  std::string name;
  if (!value.text(name)) return kNone;
  if (load.outsideFiles == OutsideFiles::Refuse) {
    value.wrong("nothing: no other file may be read here");
    return kNone;
  }
  TextureStore store;
  store.addFile(folder / name);
  std::vector<std::string> problems;
  Texture texture;
  texture.name = name;
  texture.image = store.load(problems).front();
  for (const std::string& problem : problems)
    value.fault(problem + "; wanted a picture (PNG, JPEG, TGA, BMP, HDR or EXR)");
  texture.wrapS = texture.wrapT = Wrap::ClampToEdge;
  load.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(load.textures.size() - 1);
}

}  // namespace

void readMaterials(const JsonValue& materials, Scene& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  for (const auto& [name, from] : materials.members()) {
    if (!from.object({"model", "albedo", "opacity", "alphaMode", "alphaCutoff", "transmission",
                      "emissive", "doubleSided", "specular", "shininess", "metallic", "roughness"}))
      continue;
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      from.fault(fmt::format("the scene has no material '{}'{}; wanted one of its {} materials",
                             name, didYouMean(name, names), names.size()));
      continue;
    }
    for (Material& material : scene.materials)
      if (material.name == name) readMaterial(from, material);
  }
}

void readBackground(const JsonValue& from, const std::filesystem::path& folder, SceneLoad& load,
                    Background& background) {
  if (!from.object({"color", "image", "faces", "intensity"})) return;
  if (from.has("image") && from.has("faces"))
    return from.wrong("both \"image\" and \"faces\"", "one of them");
  if (from.read("color", background.color, kNotNegative)) background.kind = BackgroundKind::Color;
  from.read("intensity", background.intensity, kNotNegative);
  if (from.has("image")) {
    background.texture = addPicture(from.at("image"), folder, load);
    if (background.texture != kNone) background.kind = BackgroundKind::Image;
  }
  if (!from.has("faces")) return;
  const std::vector<JsonValue> faces = from.at("faces").elements();
  if (faces.size() != 6) return from.at("faces").wrong("six pictures: +x, -x, +y, -y, +z, -z");
  std::array<std::uint32_t, 6> sides{};
  for (std::size_t i = 0; i < 6; ++i) sides[i] = addPicture(faces[i], folder, load);
  if (std::find(sides.begin(), sides.end(), kNone) != sides.end()) return;
  const Image& first = *load.textures[sides[0]].image;
  for (std::size_t i = 0; i < 6; ++i) {
    const Image& image = *load.textures[sides[i]].image;
    if (image.width() != image.height() || image.width() != first.width())
      return faces[i].wrong(fmt::format("a picture of {} x {}", image.width(), image.height()),
                            "six squares of one size");
  }
  background.faces = sides;
  background.kind = BackgroundKind::CubeMap;
}

}  // namespace lucerna::scene

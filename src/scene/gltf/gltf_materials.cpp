// Materials, textures, samplers and images.
#include <limits>
#include <map>

#include "scene/gltf/convert.hpp"
#include "scene/texture_store.hpp"

namespace lucerna::scene::gltf {

namespace {

constexpr float kLarge = 1e6f;  // the most that a factor may be

class MaterialReader {
 public:
  explicit MaterialReader(Context& context)
      : context_(context),
        document_(context.document),
        textures_(document_.root().elements("textures")),
        images_(document_.root().elements("images")),
        samplers_(document_.root().elements("samplers")) {}

  Material read(const Place& place, std::size_t number);
  void loadImages();

 private:
  TextureSlot slot(const Place& owner, const char* key);
  std::uint32_t texture(std::uint32_t index);
  std::size_t image(std::uint32_t index);
  std::size_t newImage(const Place& place, std::uint32_t index);
  static std::string nameOf(const Place& image);
  void readSampler(const Place& sampler, Texture& texture);
  void readMetallicRoughness(const Place& pbr, Material& material);
  void readSpecularGlossiness(const Place& glossy, Material& material);

  Context& context_;
  Document& document_;
  std::vector<Place> textures_, images_, samplers_;
  TextureStore store_;
  std::map<std::uint32_t, std::uint32_t> known_;      // glTF texture: Scene::textures
  std::map<std::uint32_t, std::size_t> knownImages_;  // glTF image: ticket
  std::map<std::uint32_t, std::size_t> knownViews_;   // bufferView of an image: ticket
  std::vector<std::size_t> tickets_;                  // of Scene::textures
};

Wrap readWrap(const Place& sampler, const char* key) {
  switch (sampler.integer(key, 10497, 0, std::numeric_limits<std::uint32_t>::max())) {
    case 10497:
      return Wrap::Repeat;
    case 33648:
      return Wrap::MirroredRepeat;
    case 33071:
      return Wrap::ClampToEdge;
  }
  sampler.at(key).refuse("10497 (repeat), 33648 (mirrored) or 33071 (clamp to edge)");
}

void MaterialReader::readSampler(const Place& sampler, Texture& texture) {
  texture.wrapS = readWrap(sampler, "wrapS");
  texture.wrapT = readWrap(sampler, "wrapT");
  const auto filter =
      sampler.integer("magFilter", 9729, 0, std::numeric_limits<std::uint32_t>::max());
  if (filter != 9728 && filter != 9729) {
    sampler.at("magFilter").refuse("9728 (nearest) or 9729 (linear)");
  }
  texture.nearest = filter == 9728;
}

// Many images may name one view, many textures one image: each is decoded once.
std::size_t MaterialReader::image(std::uint32_t index) {
  const auto [known, isNew] = knownImages_.emplace(index, 0);
  if (isNew) known->second = newImage(images_[index], index);
  return known->second;
}

std::size_t MaterialReader::newImage(const Place& place, std::uint32_t index) {
  const std::string name = place.name(fmt::format("image {}", index));
  if (const auto uri = place.find("uri")) {
    auto inlined = decodeDataUri(uri->text(), *uri);
    if (!inlined) return store_.addFile(resolveUri(document_, *uri));
    document_.resources.push_back(std::move(*inlined));
    return store_.addBytes(name, document_.resources.back());
  }
  const auto view = place.at("bufferView").index(document_.views.size(), "bufferViews");
  const auto bytes = document_.views[view].bytes;
  if (bytes.empty())
    return store_.addMissing(name, "its buffer has no data in the file; export the file again");
  const auto [known, isNew] = knownViews_.emplace(view, 0);
  if (isNew) known->second = store_.addBytes(name, bytes);
  return known->second;
}

// What the image is called: its name or its file.
std::string MaterialReader::nameOf(const Place& image) {
  const auto uri = image.find("uri");
  const bool isFile = uri && !uri->text().starts_with("data:");
  return image.name(isFile ? uri->text() : std::string());
}

std::uint32_t MaterialReader::texture(std::uint32_t index) {
  if (const auto it = known_.find(index); it != known_.end()) return it->second;
  const Place place = textures_[index];
  Texture texture;
  const auto source = place.index("source", images_.size(), "images");
  if (source != kNone) {
    tickets_.push_back(image(source));
    texture.name = nameOf(images_[source]);
  } else {
    std::string why = "it names no image";
    if (place.has("extensions")) {
      for (const auto& [name, extension] : place.at("extensions").members()) {
        why = "its image needs the extension " + name + ", which is not read";
      }
    }
    tickets_.push_back(store_.addMissing(fmt::format("/textures/{}", index),
                                         why + "; export the file again with PNG or JPEG images"));
  }
  texture.name = place.name(texture.name);
  const auto sampler = place.index("sampler", samplers_.size(), "samplers");
  if (sampler != kNone) readSampler(samplers_[sampler], texture);
  const auto made = static_cast<std::uint32_t>(context_.scene.textures.size());
  context_.scene.textures.push_back(std::move(texture));
  known_.emplace(index, made);
  return made;
}

TextureSlot MaterialReader::slot(const Place& owner, const char* key) {
  TextureSlot slot;
  const auto info = owner.find(key);
  if (!info) return slot;
  slot.texture = texture(info->at("index").index(textures_.size(), "textures"));
  auto set = info->integer("texCoord", 0, 0, kNone);
  if (const auto transform = info->extension("KHR_texture_transform")) {
    set = transform->integer("texCoord", set, 0, kNone);
    slot.rotation = transform->number("rotation", 0.f, -kLarge, kLarge);
    if (const auto offset = transform->find("offset")) offset->numbers({&slot.offset.x, 2});
    if (const auto scale = transform->find("scale")) scale->numbers({&slot.scale.x, 2});
  }
  if (set > 1) {
    document_.warn(*info, fmt::format("uses TEXCOORD_{}: only 0 and 1 are read, 0 is used", set));
    set = 0;
  }
  slot.texCoord = static_cast<int>(set);
  return slot;
}

void MaterialReader::readMetallicRoughness(const Place& pbr, Material& material) {
  material.albedo = pbr.vector4("baseColorFactor", vec4(1.f));
  material.albedoTexture = slot(pbr, "baseColorTexture");
  material.metallic = pbr.number("metallicFactor", 1.f, 0.f, 1.f);
  material.roughness = pbr.number("roughnessFactor", 1.f, 0.f, 1.f);
  material.metallicRoughnessTexture = slot(pbr, "metallicRoughnessTexture");
}

void MaterialReader::readSpecularGlossiness(const Place& glossy, Material& material) {
  material.model = MaterialModel::SpecularGlossiness;
  material.albedo = glossy.vector4("diffuseFactor", vec4(1.f));
  material.albedoTexture = slot(glossy, "diffuseTexture");
  material.specular = glossy.vector3("specularFactor", vec3(1.f));
  material.roughness = 1.f - glossy.number("glossinessFactor", 1.f, 0.f, 1.f);
  material.specularTexture = slot(glossy, "specularGlossinessTexture");
}

Material MaterialReader::read(const Place& place, std::size_t number) {
  Material material;
  material.name = place.name(fmt::format("material {}", number));
  const auto pbr = place.find("pbrMetallicRoughness");
  const auto glossy = place.extension("KHR_materials_pbrSpecularGlossiness");
  const bool unlit = place.extension("KHR_materials_unlit").has_value();
  if (glossy && !(unlit && pbr)) {
    readSpecularGlossiness(*glossy, material);
  } else if (pbr) {
    readMetallicRoughness(*pbr, material);
  }
  if (unlit) material.model = MaterialModel::Unlit;
  material.normalTexture = slot(place, "normalTexture");
  if (const auto normal = place.find("normalTexture")) {
    material.normalScale = normal->number("scale", 1.f, -kLarge, kLarge);
  }
  material.occlusionTexture = slot(place, "occlusionTexture");
  if (const auto occlusion = place.find("occlusionTexture")) {
    material.occlusionStrength = occlusion->number("strength", 1.f, 0.f, 1.f);
  }
  material.emissive = place.vector3("emissiveFactor", vec3(0.f));
  material.emissiveTexture = slot(place, "emissiveTexture");
  if (const auto strength = place.extension("KHR_materials_emissive_strength")) {
    material.emissive *= strength->number("emissiveStrength", 1.f, 0.f, 1e12f);
  }
  const std::string mode = place.text("alphaMode", "OPAQUE");
  if (mode == "MASK")
    material.alphaMode = AlphaMode::Mask;
  else if (mode == "BLEND")
    material.alphaMode = AlphaMode::Blend;
  else if (mode != "OPAQUE")
    place.at("alphaMode").refuse("\"OPAQUE\", \"MASK\" or \"BLEND\"");
  material.alphaCutoff = place.number("alphaCutoff", 0.5f, 0.f, kLarge);
  material.doubleSided = place.boolean("doubleSided", false);
  return material;
}

void MaterialReader::loadImages() {
  const auto images = store_.load(document_.warnings);
  for (std::size_t i = 0; i < tickets_.size(); ++i) {
    context_.scene.textures[i].image = images[tickets_[i]];
  }
  // Where a texture is data and no picture, the stand-in would be read as wild normals, metal and
  // shadow: the material goes without.
  for (Material& material : context_.scene.materials) {
    for (TextureSlot* slot : {&material.normalTexture, &material.metallicRoughnessTexture,
                              &material.occlusionTexture, &material.specularTexture}) {
      if (slot->used() && context_.scene.textures[slot->texture].image == checkerboard()) {
        *slot = {};
      }
    }
  }
}

}  // namespace

void readMaterials(Context& context) {
  MaterialReader reader(context);
  for (const Place& place : context.document.root().elements("materials")) {
    context.scene.materials.push_back(reader.read(place, context.scene.materials.size()));
  }
  reader.loadImages();
}

}  // namespace lucerna::scene::gltf

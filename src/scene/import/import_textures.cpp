#include "scene/import/import_textures.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/text.hpp"
#include "scene/texture_store.hpp"

namespace lucerna::scene {
namespace {

namespace fs = std::filesystem;

// The picture in `folder` with this file name in any case; else with this stem and the extension of
// another format; the first in the order of names.
fs::path findIn(const fs::path& folder, const fs::path& name) {
  std::vector<fs::path> sameStem, sameName;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const fs::path file = entry.path().filename();
    if (equalIgnoringCase(file.string(), name.string())) sameName.push_back(entry.path());
    static constexpr std::array kPictures{".png", ".jpg", ".jpeg", ".tga", ".bmp", ".hdr", ".exr"};
    const std::string extension = file.extension().string();
    const bool picture = std::any_of(kPictures.begin(), kPictures.end(), [&](const char* known) {
      return equalIgnoringCase(extension, known);
    });
    if (picture && equalIgnoringCase(file.stem().string(), name.stem().string()))
      sameStem.push_back(entry.path());
  }
  for (auto* found : {&sameName, &sameStem})
    if (!found->empty()) return *std::min_element(found->begin(), found->end());
  return {};
}

// A normal map's colours mean unit vectors that lean to +z: red and green around a half, blue
// large.
bool isNormalMap(const Image& source) {
  if (source.channels() < 3) return false;
  const Image image = converted(source, ComponentType::U8, 3);
  const std::size_t pixels = image.bytes().size() / 3;
  const std::size_t step = std::max<std::size_t>(pixels / 4096, 1);
  std::size_t looked = 0, normal = 0;
  for (std::size_t i = 0; i < pixels; i += step, ++looked) {
    const std::uint8_t* rgb = image.as<std::uint8_t>().data() + 3 * i;
    const vec3 n = vec3(rgb[0], rgb[1], rgb[2]) / 127.5f - 1.f;
    const float length = glm::length(n);
    if (n.z > 0.f && length > 0.7f && length < 1.3f) ++normal;
  }
  return looked > 0 && 10 * normal >= 9 * looked;
}

// `color` with the brightness of `mask` as its alpha; or the alpha of `mask`, if it is the picture
// of the colour itself and has one. The mask is sampled at the colour's size, nearest texel.
std::shared_ptr<const Image> withAlpha(const Image& color, const Image& mask) {
  auto result = std::make_shared<Image>(converted(color, ComponentType::U8, 4));
  const bool useAlpha = &color == &mask && (mask.channels() == 2 || mask.channels() == 4);
  const Image rgba = converted(mask, ComponentType::U8, 4);
  for (int y = 0; y < result->height(); ++y)
    for (int x = 0; x < result->width(); ++x) {
      const auto* from = rgba.pixel<std::uint8_t>(
          static_cast<int>(static_cast<std::int64_t>(x) * rgba.width() / result->width()),
          static_cast<int>(static_cast<std::int64_t>(y) * rgba.height() / result->height()));
      result->pixel<std::uint8_t>(x, y)[3] = from[useAlpha ? 3 : 0];
    }
  return result;
}

bool hasTransparentTexels(const Image& image) {
  if (image.channels() != 4) return false;
  const Image rgba = converted(image, ComponentType::U8, 4);
  const auto bytes = rgba.as<std::uint8_t>();
  for (std::size_t i = 3; i < bytes.size(); i += 4)
    if (bytes[i] < 128) return true;
  return false;
}

class TextureLoading {
 public:
  TextureLoading(ImportedScene& imported, const fs::path& folder)
      : imported_(imported), folder_(folder) {}

  void run() {
    std::vector<std::size_t> tickets, alphaTickets;
    for (const ImportedTexture& texture : imported_.textures) {
      tickets.push_back(request(texture));
      alphaTickets.push_back(texture.alphaPath.empty() ? tickets.back()
                                                       : requestFile(texture.alphaPath));
    }
    const auto images = store_.load(imported_.scene.warnings);
    for (std::size_t i = 0; i < imported_.textures.size(); ++i)
      add(imported_.textures[i], images[tickets[i]], images[alphaTickets[i]]);
    for (Material& material : imported_.scene.materials) settle(material);
  }

 private:
  std::size_t request(const ImportedTexture& texture) {
    if (!texture.bytes.empty()) return store_.addBytes(texture.path, texture.bytes);
    return requestFile(texture.path);
  }

  std::size_t requestFile(const std::string& name) {
    const fs::path path = findTexture(folder_, name);
    if (!path.empty()) return store_.addFile(path);
    const auto [missing, added] = missing_.emplace(name, 0);
    if (added) missing->second = store_.addMissing(name, "there is no such file beside the scene");
    return missing->second;
  }

  void add(const ImportedTexture& source, const std::shared_ptr<const Image>& image,
           const std::shared_ptr<const Image>& alpha) {
    Texture texture;
    texture.name = source.path;
    texture.wrapS = source.wrapS;
    texture.wrapT = source.wrapT;
    texture.image = image;
    const bool masked = !source.alphaPath.empty() && alpha != checkerboard();
    if (masked && image != checkerboard()) texture.image = withAlpha(*image, *alpha);
    imported_.scene.textures.push_back(std::move(texture));
  }

  void settle(Material& material) {
    TextureSlot& slot = material.normalTexture;
    if (slot.used()) {
      const auto& image = imported_.scene.textures[slot.texture].image;
      const bool height = imported_.textures[slot.texture].bump && !isNormalMap(*image);
      if (height && image != checkerboard())
        imported_.scene.warnings.push_back(fmt::format(
            "material '{}': '{}' is a height map and is left out; only tangent-space normal maps "
            "are drawn",
            material.name, imported_.textures[slot.texture].path));
      if (height || image == checkerboard()) slot = {};
    }
    // An opacity picture that could not be read, or that hides nothing, leaves the surface opaque.
    if (material.alphaMode == AlphaMode::Mask && material.albedoTexture.used() &&
        !hasTransparentTexels(*imported_.scene.textures[material.albedoTexture.texture].image))
      material.alphaMode = AlphaMode::Opaque;
  }

  ImportedScene& imported_;
  fs::path folder_;
  TextureStore store_;
  std::map<std::string, std::size_t> missing_;
};

}  // namespace

fs::path findTexture(const fs::path& folder, const std::string& name) {
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  std::error_code code;
  const fs::path given(slashed);
  for (const fs::path& candidate : {folder / name, folder / given})
    if (fs::is_regular_file(candidate, code)) return candidate;
  const fs::path file = given.filename();
  if (file.empty()) return {};
  for (const char* sub : {"", "textures", "Textures", "texture", "tex", "maps"})
    if (fs::path found = findIn(folder / sub, file); !found.empty()) return found;
  return findIn((folder / given).parent_path(), file);
}

void addEmissionMaps(ImportedScene& imported, const fs::path& folder) {
  std::map<std::uint32_t, std::uint32_t> maps;  // by the albedo's texture; kNoTexture: it has none
  const auto mapOf = [&](std::uint32_t albedo) {
    ImportedTexture map = imported.textures[albedo];
    const fs::path picture = findTexture(folder, map.path);
    std::error_code code;
    const fs::path file = fs::absolute(picture, code).string() + "-map";
    if (picture.empty() || !fs::is_regular_file(file, code)) return kNoTexture;
    map.path = file.lexically_relative(fs::absolute(folder, code)).string();
    map.alphaPath.clear();
    imported.textures.push_back(std::move(map));
    return static_cast<std::uint32_t>(imported.textures.size() - 1);
  };
  for (Material& material : imported.scene.materials) {
    const TextureSlot& albedo = material.albedoTexture;
    if (!albedo.used() || material.emissiveTexture.used()) continue;
    const auto [known, isNew] = maps.emplace(albedo.texture, kNoTexture);
    if (isNew) known->second = mapOf(albedo.texture);
    if (known->second == kNoTexture) continue;
    material.emissiveTexture = albedo;
    material.emissiveTexture.texture = known->second;
    if (material.emissive == vec3(0.f)) material.emissive = vec3(1.f);
  }
}

void loadTextures(ImportedScene& imported, const fs::path& folder) {
  TextureLoading(imported, folder).run();
}

}  // namespace lucerna::scene

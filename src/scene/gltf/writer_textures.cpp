// Textures, samplers and pictures.
#include <algorithm>

#include "core/hash.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "image/image_file.hpp"
#include "scene/gltf/writer_parts.hpp"

namespace lucerna::scene::gltf {
namespace {

constexpr int kNearest = 9728, kLinear = 9729, kTrilinear = 9987;

int codeOf(Wrap wrap) {
  switch (wrap) {
    case Wrap::Repeat:
      return 10497;
    case Wrap::MirroredRepeat:
      return 33648;
    case Wrap::ClampToEdge:
      return 33071;
  }
  return 10497;
}

// How a texture names a picture: core glTF has PNG and JPEG; the others are Hubs' and its
// exporter's, which lightmaps are made for.
struct PictureKind {
  const char* suffix;
  const char* mimeType;
  const char* extension;  // of the texture; nullptr: its source
};
constexpr PictureKind kPictureKinds[] = {
    {".png", "image/png", nullptr},
    {".jpg", "image/jpeg", nullptr},
    {".hdr", "image/vnd.radiance", "MOZ_texture_rgbe"},
    {".exr", "image/x-exr", "MOZ_texture_exr"},
};

const PictureKind* kindOf(const std::string& file) {
  for (const PictureKind& kind : kPictureKinds)
    if (file.ends_with(kind.suffix)) return &kind;
  return nullptr;
}

bool isFloat(const Image& image) {
  return image.type() == ComponentType::F32 || image.type() == ComponentType::Half;
}

// PNG holds no floats: 0 to 1 of them.
Image inBytes(const Image& image, bool color) {
  Image floats = converted(image, ComponentType::F32, image.channels());
  const int channels = floats.channels();
  const int colors = channels - (channels % 2 == 0 ? 1 : 0);
  const std::span<float> values = floats.as<float>();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool isColor = static_cast<int>(i % static_cast<std::size_t>(channels)) < colors;
    values[i] = color && isColor ? srgbFromLinear(values[i]) : std::clamp(values[i], 0.f, 1.f);
  }
  return converted(floats, ComponentType::U8, channels);
}

Result<GltfReport::File> writePicture(const std::filesystem::path& folder,
                                      const TextureWriter::Picture& picture) {
  const std::filesystem::path path = folder / picture.file;
  LUCERNA_TRY(bytes, isFloat(*picture.image)
                         ? encodeImage(path, inBytes(*picture.image, picture.color))
                         : encodeImage(path, *picture.image));
  LUCERNA_TRY_VOID(writeFile(path, bytes));
  return GltfReport::File{picture.file, hashBytes(bytes)};
}

}  // namespace

std::size_t TextureWriter::sampler(int magnify, int minify, Wrap s, Wrap t) {
  Json json{
      {"magFilter", magnify}, {"minFilter", minify}, {"wrapS", codeOf(s)}, {"wrapT", codeOf(t)}};
  const auto [known, isNew] = samplers_.emplace(json.dump(), 0);
  if (isNew) known->second = out_.append("samplers", std::move(json));
  return known->second;
}

std::size_t TextureWriter::image(const Texture& texture, bool color) {
  const bool floats = isFloat(*texture.image);
  const auto [known, isNew] = images_.emplace(std::pair(texture.image.get(), floats && color), 0);
  if (!isNew) return known->second;
  const std::string file = fmt::format("tex-{:03}.png", pictures_.size());
  pictures_.push_back({file, texture.image, color});
  if (floats) out_.notes.add("a picture of floats is written as 8 bits, 0 to 1 of its range");
  known->second = out_.append("images", {{"uri", file}});
  return known->second;
}

std::size_t TextureWriter::texture(std::uint32_t index, bool color) {
  const Texture& texture = out_.scene.textures[index];
  // Only of floats are there two pictures.
  const auto [known, isNew] =
      textures_.emplace(std::pair(index, color || !isFloat(*texture.image)), 0);
  if (!isNew) return known->second;
  Json json = Json::object();
  if (!texture.name.empty()) json["name"] = texture.name;
  json["sampler"] =
      sampler(texture.nearest ? kNearest : kLinear, kTrilinear, texture.wrapS, texture.wrapT);
  json["source"] = image(texture, color);
  known->second = out_.append("textures", std::move(json));
  return known->second;
}

// Without mipmaps: in these, charts run into each other.
std::size_t TextureWriter::lightmap(std::size_t map) {
  const auto [known, isNew] = lightmaps_.emplace(map, 0);
  if (!isNew) return known->second;
  const std::string& file = out_.settings.lightmaps[map].file;
  const PictureKind& kind = *kindOf(file);
  const std::size_t source = out_.append("images", {{"uri", file}, {"mimeType", kind.mimeType}});
  Json json{{"sampler", sampler(kLinear, kLinear, Wrap::ClampToEdge, Wrap::ClampToEdge)}};
  if (kind.extension == nullptr)
    json["source"] = source;
  else
    out_.extend(json, kind.extension)["source"] = source;
  known->second = out_.append("textures", std::move(json));
  return known->second;
}

Status checkLightmaps(const GltfSettings& settings) {
  for (const GltfLightmap& map : settings.lightmaps)
    if (kindOf(map.file) == nullptr)
      return error(ErrorKind::Usage, "{}: glTF cannot name it as a lightmap; wanted {}", map.file,
                   ".png, .jpg, .hdr or .exr");
  return {};
}

Result<std::vector<GltfReport::File>> writePictures(
    const std::filesystem::path& folder, std::span<const TextureWriter::Picture> pictures) {
  std::vector<std::optional<Result<GltfReport::File>>> written(pictures.size());
  parallelFor(pictures.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) written[i] = writePicture(folder, pictures[i]);
  });
  std::vector<GltfReport::File> files;
  for (auto& file : written) {
    if (!*file) return file->error();
    files.push_back(std::move(**file));
  }
  return files;
}

}  // namespace lucerna::scene::gltf

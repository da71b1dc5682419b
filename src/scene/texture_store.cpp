#include "scene/texture_store.hpp"

#include "core/file.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "image/image_file.hpp"

namespace lucerna::scene {

namespace {

constexpr ImageLimits kTextureLimits{.maxSide = 16384};  // as OpenGL gives us

}  // namespace

std::size_t TextureStore::addFile(const std::filesystem::path& path) {
  const auto [it, added] = tickets_.emplace(path.lexically_normal(), requests_.size());
  if (added) requests_.push_back({path.filename().string(), path, {}, {}});
  return it->second;
}

std::size_t TextureStore::addBytes(std::string name, std::span<const std::byte> encoded) {
  requests_.push_back({std::move(name), {}, encoded, {}});
  return requests_.size() - 1;
}

std::size_t TextureStore::addMissing(std::string name, std::string reason) {
  requests_.push_back({std::move(name), {}, {}, std::move(reason)});
  return requests_.size() - 1;
}

// By the headers and before decoding, so that it is always the same images that are refused.
void TextureStore::refuseBeyond(std::uint64_t maxBytes) {
  std::vector<std::uint64_t> sizes(requests_.size(), 0);  // 0: decoding will say what is wrong
  parallelFor(requests_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Request& request = requests_[i];
      if (!request.missing.empty()) continue;
      Bytes content;
      if (!request.path.empty()) {
        auto file = readFile(request.path);
        if (file) content = std::move(file).value();
      }
      const auto info = imageInfo(
          request.path.empty() ? request.bytes : std::span<const std::byte>(content), request.name);
      if (info && std::max(info->width, info->height) <= kTextureLimits.maxSide &&
          info->bytes() <= kTextureLimits.maxBytes)
        sizes[i] = info->bytes();
    }
  });
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    if (sizes[i] <= maxBytes - total) {
      total += sizes[i];
      continue;
    }
    requests_[i].missing = fmt::format(
        "it takes {}, and with it the textures take more than {} together; make them smaller",
        bytesText(sizes[i]), bytesText(maxBytes));
  }
}

std::vector<TextureStore::Loaded> TextureStore::loadAll(std::uint64_t maxBytes) {
  refuseBeyond(maxBytes);
  std::vector<Loaded> all(requests_.size());
  parallelFor(requests_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Request& request = requests_[i];
      Loaded& loaded = all[i];
      loaded.problem = request.missing;
      if (loaded.problem.empty()) {
        auto image = request.path.empty() ? decodeImage(request.bytes, request.name, kTextureLimits)
                                          : readImage(request.path, kTextureLimits);
        if (image)
          loaded.image = std::make_shared<const Image>(std::move(image).value());
        else
          loaded.problem = image.error().message;
      }
      if (!loaded.image) loaded.image = checkerboard();
    }
  });
  requests_.clear();
  tickets_.clear();
  return all;
}

std::vector<std::shared_ptr<const Image>> TextureStore::load(std::vector<std::string>& warnings,
                                                             std::uint64_t maxBytes) {
  std::vector<std::string> names;
  for (const Request& request : requests_) names.push_back(request.name);
  std::vector<std::shared_ptr<const Image>> images;
  for (Loaded& loaded : loadAll(maxBytes)) {
    if (!loaded.problem.empty())
      warnings.push_back("texture " + names[images.size()] +
                         " is replaced by a checkerboard: " + loaded.problem);
    images.push_back(std::move(loaded.image));
  }
  return images;
}

std::shared_ptr<const Image> checkerboard() {
  static const std::shared_ptr<const Image> image = [] {
    auto made = std::make_shared<Image>(64, 64, 4, ComponentType::U8);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        std::uint8_t* pixel = made->pixel<std::uint8_t>(x, y);
        const bool lit = ((x / 8) + (y / 8)) % 2 == 0;
        pixel[0] = pixel[2] = lit ? 255 : 0;
        pixel[3] = 255;
      }
    }
    return made;
  }();
  return image;
}

}  // namespace lucerna::scene

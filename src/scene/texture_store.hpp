// Gathers the images that a scene's textures ask for, reads and decodes each once, in parallel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace lucerna::scene {

// Of all pictures of a scene together, once decoded.
inline constexpr std::uint64_t kMaxTextureBytes = 4ull << 30;

class TextureStore {
 public:
  // Each returns a ticket: an index into what load() returns. The same file gives the same ticket.
  std::size_t addFile(const std::filesystem::path& path);
  // The content of an image file, which must live until load().
  std::size_t addBytes(std::string name, std::span<const std::byte> encoded);
  std::size_t addMissing(std::string name, std::string reason);  // gives the stand-in

  struct Loaded {
    std::shared_ptr<const Image> image;  // never null: the checkerboard where there is a problem
    std::string problem;                 // why it cannot be had; empty: it is what was asked for
  };
  // One a ticket. Refused are also images that would bring them all above `maxBytes` once decoded.
  // Empties the store.
  std::vector<Loaded> loadAll(std::uint64_t maxBytes = kMaxTextureBytes);
  // The images alone; each problem is a sentence in `warnings`, in order of the tickets.
  std::vector<std::shared_ptr<const Image>> load(std::vector<std::string>& warnings,
                                                 std::uint64_t maxBytes = kMaxTextureBytes);

 private:
  void refuseBeyond(std::uint64_t maxBytes);

  struct Request {
    std::string name;
    std::filesystem::path path;  // empty: bytes
    std::span<const std::byte> bytes;
    std::string missing;  // why there is nothing to read; empty: read it
  };
  std::vector<Request> requests_;
  std::map<std::filesystem::path, std::size_t> tickets_;
};

// The stand-in for a texture that cannot be had: magenta and black squares, 64 x 64 RGBA.
std::shared_ptr<const Image> checkerboard();

}  // namespace lucerna::scene

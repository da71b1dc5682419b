#include "scene/import/scene_stream.hpp"

#include <cstring>
#include <optional>
#include <type_traits>

#include "scene/check_scene.hpp"

namespace lucerna::scene {
namespace {

constexpr std::uint64_t kMagic = 0x31656e656373634cull;  // "Lcscene1"

template <typename T>
concept Raw =
    std::is_trivially_copyable_v<T> && (!std::is_enum_v<T> || std::is_same_v<T, std::byte>) &&
    !std::is_same_v<T, bool> && !std::is_pointer_v<T>;

// Writer and Reader understand the same calls, so that each struct is described once, below.
class Writer {
 public:
  Bytes bytes;

  template <Raw T>
  void operator()(const T& value) {
    append(&value, sizeof value);
  }
  void operator()(const bool& value) { (*this)(static_cast<std::uint8_t>(value)); }
  template <typename E>
  void choice(const E& value, int) {
    (*this)(static_cast<std::uint8_t>(value));
  }
  void operator()(const std::string& text) { block(text); }
  template <Raw T>
  void operator()(const std::vector<T>& values) {
    block(values);
  }
  template <typename T, typename Fields>
  void list(const std::vector<T>& values, Fields fields) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) fields(*this, value);
  }
  template <Raw T>
  void operator()(const std::optional<T>& value) {
    (*this)(value.has_value());
    if (value) (*this)(*value);
  }

 private:
  template <typename Container>
  void block(const Container& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(values[0]));
  }
  void append(const void* data, std::size_t size) {
    const auto* from = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), from, from + size);
  }
};

// After the first fault every call leaves its value alone.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  bool good() const { return good_; }
  bool atEnd() const { return rest_.empty(); }

  template <Raw T>
  void operator()(T& value) {
    take(&value, sizeof value);
  }
  void operator()(bool& value) {
    std::uint8_t byte = 0;
    (*this)(byte);
    value = byte != 0;
  }
  template <typename E>
  void choice(E& value, int count) {
    std::uint8_t byte = 0;
    (*this)(byte);
    if (byte >= count)
      good_ = false;
    else
      value = static_cast<E>(byte);
  }
  void operator()(std::string& text) { block(text); }
  template <Raw T>
  void operator()(std::vector<T>& values) {
    block(values);
  }
  template <typename T, typename Fields>
  void list(std::vector<T>& values, Fields fields) {
    std::uint64_t count = 0;
    (*this)(count);
    // Every element takes at least one byte, so that the loop ends with the bytes.
    for (std::uint64_t i = 0; i < count && good_; ++i) fields(*this, values.emplace_back());
  }
  template <Raw T>
  void operator()(std::optional<T>& value) {
    bool has = false;
    (*this)(has);
    if (has) (*this)(value.emplace());
  }

 private:
  template <typename Container>
  void block(Container& values) {
    std::uint64_t count = 0;
    (*this)(count);
    if (!good_ || count > rest_.size() / sizeof(values[0])) {
      good_ = false;
      return;
    }
    values.resize(count);
    take(values.data(), count * sizeof(values[0]));
  }
  void take(void* to, std::size_t size) {
    if (!good_ || size > rest_.size()) {
      good_ = false;
      return;
    }
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }

  std::span<const std::byte> rest_;
  bool good_ = true;
};

// Each struct once, for both directions.
// NOLINTBEGIN(readability-identifier-naming): named as the functions they are called like
const auto textureFields = [](auto& a, auto& t) {
  a(t.path), a(t.bytes), a(t.alphaPath), a(t.bump);
  a.choice(t.wrapS, 3), a.choice(t.wrapT, 3);
};

const auto meshFields = [](auto& a, auto& m) {
  a(m.name), a(m.positions), a(m.normals), a(m.tangents), a(m.texCoords[0]), a(m.texCoords[1]);
  a(m.colors), a(m.indices), a(m.bounds);
};

const auto materialFields = [](auto& a, auto& m) {
  const auto slot = [&](auto& s) {
    a(s.texture), a(s.texCoord), a(s.offset), a(s.scale), a(s.rotation);
  };
  a(m.name), a.choice(m.model, 4), a.choice(m.alphaMode, 3), a(m.alphaCutoff), a(m.doubleSided);
  a(m.albedo), slot(m.albedoTexture), a(m.emissive), slot(m.emissiveTexture);
  slot(m.normalTexture), a(m.normalScale), a(m.transmission);
  a(m.metallic), a(m.roughness), slot(m.metallicRoughnessTexture), slot(m.occlusionTexture);
  a(m.occlusionStrength), a(m.specular), slot(m.specularTexture), a(m.shininess);
};

const auto nodeFields = [](auto& a, auto& n) {
  a(n.name), a(n.parent), a(n.translation), a(n.rotation), a(n.scale), a(n.matrix);
};

const auto objectFields = [](auto& a, auto& o) { a(o.node), a(o.mesh), a(o.material); };

const auto lightFields = [](auto& a, auto& l) {
  a(l.name), a.choice(l.kind, 3), a(l.color), a(l.intensity), a(l.ambientIntensity);
  a(l.attenuation), a(l.range), a(l.radius), a(l.angle), a(l.innerCone), a(l.outerCone);
  a(l.exponent), a(l.group), a(l.on), a(l.node);
};

const auto cameraFields = [](auto& a, auto& c) {
  a(c.name), a(c.orthographic), a(c.fovY), a(c.height), a(c.aspect), a(c.near), a(c.far);
  a(c.node);
};

const auto animationFields = [](auto& a, auto& animation) {
  a(animation.name);
  a.list(animation.channels, [](auto& b, auto& c) {
    b(c.node), b.choice(c.path, 3), b.choice(c.interpolation, 3), b(c.times), b(c.values);
  });
};

const auto textFields = [](auto& a, auto& text) { a(text); };

const auto fields = [](auto& a, auto& imported) {
  a.list(imported.textures, textureFields);
  auto& scene = imported.scene;
  a.list(scene.meshes, meshFields);
  a.list(scene.materials, materialFields);
  a.list(scene.nodes, nodeFields);
  a.list(scene.objects, objectFields);
  a.list(scene.lights, lightFields);
  a.list(scene.cameras, cameraFields);
  a.list(scene.animations, animationFields);
  a.list(scene.warnings, textFields);
  a(scene.ambient);
};
// NOLINTEND(readability-identifier-naming)

}  // namespace

Bytes writeStream(const ImportedScene& imported) {
  Writer writer;
  std::size_t size = 1 << 16;
  for (const Mesh& mesh : imported.scene.meshes)
    size += 48 * mesh.positions.size() + 4 * mesh.indices.size() + 256;
  writer.bytes.reserve(size);
  writer(kMagic);
  fields(writer, imported);
  return std::move(writer.bytes);
}

Result<ImportedScene> readStream(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  std::uint64_t magic = 0;
  reader(magic);
  if (magic != kMagic) return error(ErrorKind::Input, "does not start as it should");
  ImportedScene imported;
  fields(reader, imported);
  if (!reader.good()) return error(ErrorKind::Input, "ends early or holds impossible counts");
  if (!reader.atEnd()) return error(ErrorKind::Input, "has bytes left over");
  LUCERNA_TRY_VOID(checkScene(imported.scene, imported.textures.size()));
  return imported;
}

}  // namespace lucerna::scene

// Pictures of a scene JSON, and how materials use them.
#include <algorithm>
#include <optional>

#include "core/text.hpp"
#include "scene/scene_json_parts.hpp"
#include "scene/texture_store.hpp"

namespace lucerna::scene {
namespace {

bool isFloat(const Image& image) {
  return image.type() == ComponentType::F32 || image.type() == ComponentType::Half;
}

// Square, and of the first face's size and kind.
bool isFaceLike(const Image& face, const Image& first) {
  return face.width() == face.height() && face.width() == first.width() &&
         isFloat(face) == isFloat(first);
}

std::optional<Wrap> readWrap(const JsonValue& from) {
  int wrap = 0;
  if (!from.readChoice("wrap", {"repeat", "mirror", "clamp"}, wrap)) return std::nullopt;
  return static_cast<Wrap>(wrap);
}

}  // namespace

bool JsonPictures::mayRead(const JsonValue& file) const {
  if (load_.outsideFiles != OutsideFiles::Refuse) return true;
  file.wrong("nothing: no other file may be read here");
  return false;
}

std::uint32_t JsonPictures::want(Texture texture, const std::vector<JsonValue>& files,
                                 const std::vector<std::string>& names) {
  for (const JsonValue& file : files)
    if (!mayRead(file)) return kNone;
  Wanted wanted{addTexture(std::move(texture)), files, {}};
  for (const std::string& name : names) wanted.tickets.push_back(store_.addFile(folder_ / name));
  wanted_.push_back(std::move(wanted));
  return wanted_.back().texture;
}

std::uint32_t JsonPictures::add(const JsonValue& file, Wrap wrap) {
  Texture texture;
  if (!file.text(texture.name)) return kNone;
  const std::string name = texture.name;
  const auto [known, isNew] =
      known_.emplace(fmt::format("{}\n{}", name, static_cast<int>(wrap)), kNone);
  texture.wrapS = texture.wrapT = wrap;
  if (isNew) known->second = want(std::move(texture), {file}, {name});
  return known->second;
}

std::uint32_t JsonPictures::addCube(const JsonValue& sixFiles) {
  const std::vector<JsonValue> files = sixFiles.elements();
  if (files.size() != 6) {
    sixFiles.wrong("six pictures: +x, -x, +y, -y, +z, -z");
    return kNone;
  }
  std::vector<std::string> names(6);
  for (std::size_t i = 0; i < 6; ++i)
    if (!files[i].text(names[i])) return kNone;
  const auto [known, isNew] = known_.emplace(join(names, "\n"), kNone);
  Texture texture;
  texture.name = names[0];
  texture.faces.resize(6);
  texture.wrapS = texture.wrapT = Wrap::ClampToEdge;
  if (isNew) known->second = want(std::move(texture), files, names);
  return known->second;
}

void JsonPictures::load() {
  const auto loaded = store_.loadAll(kMaxTextureBytes - load_.textureBytes);
  for (const auto& [image, problem] : loaded)
    if (problem.empty()) load_.textureBytes += image->bytes().size();
  for (const Wanted& wanted : wanted_) {
    Texture& texture = load_.textures[wanted.texture];
    const bool firstIsThere = loaded[wanted.tickets[0]].problem.empty();
    std::vector<std::shared_ptr<const Image>> images;
    for (std::size_t i = 0; i < wanted.files.size(); ++i) {
      const auto& [image, problem] = loaded[wanted.tickets[i]];
      images.push_back(image);
      if (!problem.empty())
        wanted.files[i].fault("the picture cannot be had: " + problem);
      else if (texture.isCube() && firstIsThere && !isFaceLike(*image, *images.front()))
        wanted.files[i].wrong(fmt::format("a picture of {} x {}", image->width(), image->height()),
                              "six squares of one size, all with 8 bits or all float");
    }
    texture.image = images.front();
    if (texture.isCube()) texture.faces = std::move(images);
  }
  wanted_.clear();
}

std::uint32_t JsonPictures::read(const JsonValue& from, std::uint32_t texture) {
  const std::optional<Wrap> wrap = readWrap(from);
  if (from.has("file") && from.has("faces")) {
    from.wrong("both \"file\" and \"faces\"", "one of them");
    return kNone;
  }
  if (from.has("file")) return add(from.at("file"), wrap.value_or(Wrap::Repeat));
  if (from.has("faces"))
    texture = addCube(from.at("faces"));
  else if (texture == kNone)
    from.wrong("no picture", "\"file\" or six \"faces\"");
  if (!wrap || texture == kNone) return texture;
  if (!isCube(texture)) return wrapped(texture, *wrap);
  from.at("wrap").wrong("nothing: a cube map has no edges");
  return kNone;
}

// Other materials may share the texture, so the wrap is that of a copy, which shares the picture.
std::uint32_t JsonPictures::wrapped(std::uint32_t texture, Wrap wrap) {
  if (!load_.textures[texture].image) load();
  Texture copy = load_.textures[texture];
  copy.wrapS = copy.wrapT = wrap;
  const auto same = [&](const Texture& other) {
    return other.image == copy.image && other.wrapS == wrap && other.wrapT == wrap &&
           other.nearest == copy.nearest && !other.isCube();
  };
  const auto known = std::find_if(load_.textures.begin(), load_.textures.end(), same);
  if (known == load_.textures.end()) return addTexture(std::move(copy));
  return static_cast<std::uint32_t>(known - load_.textures.begin());
}

std::uint32_t JsonPictures::addTexture(Texture texture) {
  load_.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(load_.textures.size() - 1);
}

void readSlot(const JsonValue& from, JsonPictures& pictures, TextureSlot& slot) {
  const std::uint32_t texture = pictures.read(from, slot.texture);
  if (texture == kNone) return;
  slot.texture = texture;
  const bool cube = pictures.isCube(texture);
  if (from.has("file") || from.has("faces"))
    slot.coordinates = cube ? Coordinates::Reflection : Coordinates::Mesh;
  int choice = 0;
  if (from.readChoice("coordinates",
                      {"mesh", "object-linear", "eye-linear", "sphere-map", "reflection"}, choice))
    slot.coordinates = static_cast<Coordinates>(choice);
  from.read("planeS", slot.planeS);
  from.read("planeT", slot.planeT);
  from.read("offset", slot.offset);
  from.read("scale", slot.scale);
  from.readDegrees("rotation", slot.rotation, {-360.f, 360.f});
  if (cube != (slot.coordinates == Coordinates::Reflection))
    from.wrong(cube ? "six \"faces\"" : "\"coordinates\": \"reflection\"",
               cube ? "\"coordinates\": \"reflection\" with them" : "six \"faces\" for it");
}

}  // namespace lucerna::scene

#include "graph/storage.hpp"

#include <algorithm>

namespace lucerna::graph {
namespace {

template <typename T, typename Physical>
void beginFrameOf(std::vector<Slots<T, Physical>>& all, bool cut, bool perSceneRuns) {
  for (auto& slots : all) {
    if (!slots.physical.history) continue;
    const bool runs = perSceneRuns || slots.frequency != Frequency::PerScene;
    for (Slot<T>& slot : slots.views) {
      slot.previous = slot.current;
      slot.valid = slot.written && !cut;
      if (!runs) continue;
      slot.current = 1 - slot.current;
      slot.written = true;
    }
  }
}

// The slots of the schedule before that hold the same value, emptied; or none.
template <typename Holder, typename Same>
std::optional<Holder> takeOver(std::vector<Holder>& old, const std::string& key, Same same) {
  for (Holder& slots : old)
    if (!key.empty() && slots.key == key && same(slots.physical)) {
      slots.key.clear();
      return std::move(slots);
    }
  return std::nullopt;
}

}  // namespace

void Storage::prepare(const Schedule& schedule) {
  std::vector<TextureSlots> oldTextures = std::exchange(textures_, {});
  std::vector<DataSlots> oldData = std::exchange(data_, {});
  labels_.clear();
  for (const PhysicalTexture& physical : schedule.textures) {
    const Version& first = schedule.versions[physical.versions.front()];
    labels_.push_back(first.name);
    const std::string key =
        physical.keepsContent ? first.name + (first.standIn ? " fill" : "") : "";
    auto known = takeOver(oldTextures, key, [&](const PhysicalTexture& p) {
      return p.desc == physical.desc && p.history == physical.history &&
             p.perView == physical.perView;
    });
    TextureSlots slots = known ? std::move(*known) : TextureSlots{};
    slots.physical = physical;
    slots.frequency = first.frequency;
    slots.key = key;
    textures_.push_back(std::move(slots));
  }
  for (TextureSlots& slots : oldTextures)
    for (auto& slot : slots.views)
      for (gpu::Texture& texture : slot.items)
        if (texture) spare_.push_back(std::move(texture));
  for (std::size_t i = 0; i < textures_.size(); ++i) fillViews(textures_[i], labels_[i]);
  spare_.clear();
  for (const PhysicalData& physical : schedule.data) {
    const Version& first = schedule.versions[physical.versions.front()];
    auto known = takeOver(oldData, first.name, [&](const PhysicalData& p) {
      return p.type.data == physical.type.data && p.history == physical.history &&
             p.perView == physical.perView;
    });
    DataSlots slots = known ? std::move(*known) : DataSlots{};
    slots.physical = physical;
    slots.frequency = first.frequency;
    slots.key = first.name;
    data_.push_back(std::move(slots));
    fillViews(data_.back());
  }
}

bool Storage::prepareViews(std::size_t count) {
  if (count == viewCount_) return false;
  viewCount_ = count;
  for (std::size_t i = 0; i < textures_.size(); ++i) fillViews(textures_[i], labels_[i]);
  for (DataSlots& slots : data_) fillViews(slots);
  return true;
}

void Storage::beginFrame(bool cut, bool perSceneRuns) {
  beginFrameOf(textures_, cut, perSceneRuns);
  beginFrameOf(data_, cut, perSceneRuns);
}

std::uint64_t Storage::textureBytes() const {
  std::uint64_t bytes = 0;
  for (const TextureSlots& slots : textures_)
    bytes += slots.physical.desc.bytes() * slots.views.size() * (slots.physical.history ? 2 : 1);
  return bytes;
}

gpu::Texture Storage::take(const gpu::TextureDesc& desc, const std::string& label) {
  const auto found = std::find_if(spare_.begin(), spare_.end(),
                                  [&](const gpu::Texture& t) { return t.desc() == desc; });
  if (found == spare_.end()) return device_.createTexture(desc, label);
  gpu::Texture texture = std::move(*found);
  spare_.erase(found);
  return texture;
}

void Storage::fillViews(TextureSlots& slots, const std::string& label) {
  const std::size_t before = slots.views.size();
  slots.views.resize(slots.physical.perView ? viewCount_ : 1);
  for (std::size_t view = before; view < slots.views.size(); ++view)
    for (int i = 0; i < (slots.physical.history ? 2 : 1); ++i) {
      gpu::Texture& texture = slots.views[view].items[i];
      texture = take(slots.physical.desc, label);
      if (slots.physical.keepsContent) device_.clear(texture, vec4(0));
    }
}

void Storage::fillViews(DataSlots& slots) {
  const std::size_t before = slots.views.size();
  slots.views.resize(slots.physical.perView ? viewCount_ : 1);
  for (std::size_t view = before; view < slots.views.size(); ++view)
    for (int i = 0; i < (slots.physical.history ? 2 : 1); ++i)
      slots.views[view].items[i] = slots.physical.type.makeData();
}

}  // namespace lucerna::graph

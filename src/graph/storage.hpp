// Internal to graph/: the textures and data objects behind a schedule's physical slots. Those that
// fit are taken over from the schedule before, so that changing a pipeline allocates little.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device.hpp"
#include "graph/schedule.hpp"

namespace lucerna::graph {

// One texture or object, or two that take turns if the next frame reads this one's.
template <typename T>
struct Slot {
  T items[2];
  int current = 0;       // holds this frame's value
  int previous = 0;      // holds the last frame's; the same while nothing is written
  bool written = false;  // ever
  bool valid = false;    // there is a last frame's value
};

// A physical slot of the schedule. T is gpu::Texture or std::shared_ptr<void>.
template <typename T, typename Physical>
struct Slots {
  Physical physical;
  Frequency frequency = Frequency::PerView;  // of its writers
  std::string key;                           // names content that outlives schedules; else ""
  std::vector<Slot<T>> views;                // one for all views, or one a view
  bool filled = false;                       // of a stand-in: holds `fill`
  vec4 fill{0.f};

  Slot<T>& of(std::size_t view) { return views[views.size() == 1 ? 0 : view]; }
};
using TextureSlots = Slots<gpu::Texture, PhysicalTexture>;
using DataSlots = Slots<std::shared_ptr<void>, PhysicalData>;

class Storage {
 public:
  explicit Storage(gpu::Device& device) : device_(device) {}

  // Makes what the schedule needs; reuses what it can, frees the rest.
  void prepare(const Schedule& schedule);
  // Makes room for this many views. True if pointers handed out before may have moved.
  bool prepareViews(std::size_t count);
  // Chooses for every value with a history which of its two is written in this frame.
  // perSceneRuns: do per-scene steps run in it?
  void beginFrame(bool cut, bool perSceneRuns);

  std::size_t viewCount() const { return viewCount_; }
  std::uint64_t textureBytes() const;  // of all textures, all views
  TextureSlots& texture(std::size_t physical) { return textures_[physical]; }
  DataSlots& data(std::size_t physical) { return data_[physical]; }

 private:
  gpu::Texture take(const gpu::TextureDesc& desc, const std::string& label);
  void fillViews(TextureSlots& slots, const std::string& label);
  void fillViews(DataSlots& slots);

  gpu::Device& device_;
  std::vector<TextureSlots> textures_;
  std::vector<DataSlots> data_;
  std::vector<std::string> labels_;  // as textures_
  std::vector<gpu::Texture> spare_;  // filled only inside prepare()
  std::size_t viewCount_ = 1;
};

}  // namespace lucerna::graph

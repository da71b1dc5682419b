// Draws what throws shadows into many maps at once: of a group of maps there is one list of draw
// commands, each instance of which knows the map that it belongs to.
#pragma once

#include <span>
#include <vector>

#include "render/draw_list.hpp"
#include "render/object_programs.hpp"
#include "render/shadow_maps.hpp"

namespace lucerna::passes {

class MapDrawer {
 public:
  // layered: instances choose their layer (gpu::kFeatureLayeredVertex), and a group holds maps that
  // fill the same square of any layers. Without, it holds one map.
  MapDrawer(gpu::Device& device, bool layered);
  // Clears the maps' squares of the texture and draws them; the rest of it stays. What a map gets
  // does not depend on the others.
  void draw(const render::GpuScene& gpuScene, const gpu::Texture& texture,
            std::vector<render::ShadowMaps::Map> maps);

 private:
  struct Group {
    render::DrawList list;
    gpu::Buffer views;  // ShadowViewBlock
  };
  // Of the first of the maps, and as many after it as fit; returns how many.
  std::size_t fill(Group& group, const render::GpuScene& gpuScene,
                   std::span<const render::ShadowMaps::Map> maps);
  void draw(const Group& group, const render::GpuScene& gpuScene, const gpu::Texture& texture,
            const render::ShadowMaps::Map& first);

  gpu::Device& device_;
  bool layered_;
  render::ObjectPrograms programs_, warpedPrograms_;
  std::vector<Group> groups_;  // kept for their buffers
};

}  // namespace lucerna::passes

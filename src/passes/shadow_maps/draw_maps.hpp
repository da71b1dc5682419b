// Draws what throws shadows into many maps at once: of a group of maps there is one list of draw
// commands, each instance of which knows the map that it belongs to; and one more of translucent
// surfaces where maps see any.
#pragma once

#include <span>
#include <vector>

#include "render/draw_list.hpp"
#include "render/object_programs.hpp"
#include "render/shadow_maps.hpp"

namespace lucerna::passes {

// Whether there are translucent surfaces in it, which leave their colour.
bool seesPanes(const render::GpuScene& gpuScene, const render::ShadowMaps::Map& map);

class MapDrawer {
 public:
  // layered: instances choose their layer (gpu::kFeatureLayeredVertex), and a group holds maps that
  // fill the same square of any layers. Without, it holds one map.
  MapDrawer(gpu::Device& device, bool layered);
  // Clears the maps' squares of the textures and draws them; the rest stays. What a map gets does
  // not depend on the others. panes: large enough if a map sees some (render::ShadowMaps::Map).
  void draw(const render::GpuScene& gpuScene, const gpu::Texture& depth,
            const render::ShadowMaps::Panes& panes, std::vector<render::ShadowMaps::Map> maps);

 private:
  enum class Casters { Opaque, Panes };
  struct Group {
    render::DrawList list;
    gpu::Buffer views;  // ShadowViewBlock
  };
  struct Programs {
    Programs(gpu::Device& device, bool layered, bool warped);
    render::ObjectPrograms depth, transmission;
  };
  // Calls draw(group, first map of the group) for groups of the maps, which follow each other.
  template <typename Draw>
  void forGroups(const render::GpuScene& gpuScene, std::span<const render::ShadowMaps::Map> maps,
                 Casters casters, const Draw& draw);
  // Of the first of the maps, and as many after it as fit; returns how many.
  std::size_t fill(Group& group, const render::GpuScene& gpuScene,
                   std::span<const render::ShadowMaps::Map> maps, Casters casters);
  void draw(const Group& group, const render::GpuScene& gpuScene, gpu::Targets targets,
            const gpu::RenderState& state, render::ObjectPrograms& programs,
            const render::ShadowMaps::Place& square);

  gpu::Device& device_;
  bool layered_;
  Programs programs_, warpedPrograms_;
  std::vector<Group> groups_;  // kept for their buffers
  std::size_t used_ = 0;       // of them, in this call
};

}  // namespace lucerna::passes

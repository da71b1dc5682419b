#include "passes/register_passes.hpp"

#include "passes/background/background.hpp"
#include "passes/cull/cull.hpp"
#include "passes/custom_shaders/custom_shaders.hpp"
#include "passes/depth_of_field/depth_of_field.hpp"
#include "passes/forward/forward.hpp"
#include "passes/fullscreen/fullscreen.hpp"
#include "passes/fxaa/fxaa.hpp"
#include "passes/gbuffer/gbuffer.hpp"
#include "passes/geometry_samples/geometry_samples.hpp"
#include "passes/layered_transmittance/layered_transmittance.hpp"
#include "passes/mirrors/mirrors.hpp"
#include "passes/nearest_blockers/nearest_blockers.hpp"
#include "passes/penumbra/penumbra.hpp"
#include "passes/prefiltered_shadows/prefiltered_shadows.hpp"
#include "passes/save_image/save_image.hpp"
#include "passes/screen_space_ao/screen_space_ao.hpp"
#include "passes/shadow_blur/shadow_blur.hpp"
#include "passes/shadow_layers/shadow_layers.hpp"
#include "passes/shadow_maps/shadow_maps.hpp"
#include "passes/shadow_mask/shadow_mask.hpp"
#include "passes/shadow_tiles/shadow_tiles.hpp"
#include "passes/show_bvh/show_bvh.hpp"
#include "passes/show_gbuffer/show_gbuffer.hpp"
#include "passes/sraa/sraa.hpp"
#include "passes/tile_lights/tile_lights.hpp"
#include "passes/tiled_lighting/tiled_lighting.hpp"
#include "passes/tone_map/tone_map.hpp"
#include "passes/transparency/transparency.hpp"
#include "render/lightmaps.hpp"
#include "render/view_group.hpp"

// Made by the build from the shader files (cmake/embed_shaders.cmake).
namespace lucerna::gpu {
std::span<const EmbeddedShader> embeddedShaders_render();
std::span<const EmbeddedShader> embeddedShaders_passes();
}  // namespace lucerna::gpu

namespace lucerna::passes {

void registerPasses(graph::Registry& registry) {
  registry.shaders()->add(gpu::embeddedShaders_render());
  registry.shaders()->add(gpu::embeddedShaders_passes());

  registry.addResource<render::GpuScene>("scene", "Objects, meshes, materials, textures.");
  registry.addResource<render::ViewData>("view", "Where this picture is seen from.", true);
  registry.addResource<render::ViewGroup>("views", "Where all pictures of a frame are seen from.");
  registry.addResource<render::LightList>("lights", "The lights that are on.");
  registry.addResource<render::Lightmaps>("lightmaps", "Baked light, if the scene has any.");

  registry.add<Cull>();
  registry.add<GBuffer>();
  registry.add<ScreenSpaceAo>();
  registry.add<ShadowMaps>();
  registry.add<PrefilteredShadows>();
  registry.add<ShadowLayers>();
  registry.add<TileLights>();
  registry.add<ShadowMask>();
  registry.add<ShadowTiles>();
  registry.add<NearestBlockers>();
  registry.add<Penumbra>();
  registry.add<ShadowBlur>();
  registry.add<LayeredTransmittance>();
  registry.add<TiledLighting>();
  registry.add<CustomShaders>();
  registry.add<Forward>();
  registry.add<Background>();
  registry.add<Mirrors>();
  registry.add<Transparency>();
  registry.add<DepthOfField>();
  registry.add<ToneMap>();
  registry.add<ShowGBuffer>();
  registry.add<ShowBvh>();
  registry.add<SaveImage>();
  registry.add<Fxaa>();
  registry.add<GeometrySamples>();
  registry.add<Sraa>();
  registry.add(fullscreenType(registry.shaders()));
}

}  // namespace lucerna::passes

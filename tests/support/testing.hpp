// What GL tests share: one device for the program, and pictures of scenes through pipelines.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "gpu/device.hpp"
#include "graph/executor.hpp"
#include "graph/pipeline.hpp"
#include "graph/registry.hpp"
#include "image/image.hpp"
#include "render/gpu_scene.hpp"
#include "render/light_list.hpp"
#include "render/lightmaps.hpp"
#include "render/view_data.hpp"
#include "scene/scene.hpp"

namespace lucerna::testing {

// The program's only device, made on first use with the shaders of all passes. Ends the program
// with a message if there is no OpenGL: GL tests carry the label "gl" and are not run without it.
gpu::Device& device();

// All passes that ship.
const graph::Registry& registry();

// Fails the running test for each debug message of severity medium or above since the last call.
void expectNoDebugMessages();

// A pipeline of rows that are named as their types: rows({"Cull", "GBuffer", "TiledLighting"}).
graph::Pipeline rows(const std::vector<std::string>& types);
extern const std::vector<std::string> kDeferredRows, kForwardRows;

// The values that the pipeline's ToneMap rows read, "TiledLighting.color": in these floats a NaN
// shows, 8-bit pictures cannot hold one. Empty if the pipeline is faulty.
std::vector<std::string> radianceNames(const graph::Pipeline& pipeline);

// A scene on the GPU, drawn through any number of pipelines.
class SceneRenderer {
 public:
  // The scene must outlive it.
  explicit SceneRenderer(const scene::Scene& scene);

  struct Output {
    Image picture;  // the pipeline's output, top row first, in its format's type
    std::map<std::string, Image> kept;  // further values by name, "GBuffer.depth"
    graph::FrameProfile profile;
  };
  // From the scene's first camera, or the given view.
  Result<Output> render(const graph::Pipeline& pipeline, uvec2 size,
                        const std::vector<std::string>& kept = {});
  Result<Output> render(const graph::Pipeline& pipeline, const scene::View& view, uvec2 size,
                        const std::vector<std::string>& kept = {});

  render::GpuScene gpuScene;
  render::LightList lights;
  render::Lightmaps lightmaps;  // none
  render::ViewData view;
  bool profiling = false;

 private:
  const scene::Scene& scene_;
  graph::Executor executor_;
};

// The picture of a pipeline, whose failure ends the test.
Image pictureOf(const scene::Scene& scene, const graph::Pipeline& pipeline, uvec2 size);
// The value `kept` ("TiledLighting.color") of it instead.
Image valueOf(const scene::Scene& scene, const graph::Pipeline& pipeline, uvec2 size,
              const std::string& kept);

gpu::Texture uploaded(const Image& image, gpu::Format format);

// Linear radiance in the middle of the picture, from a half-float colour image.
vec3 colorAt(const Image& image, int x, int y);
inline vec3 centerOf(const Image& image) {
  return colorAt(image, image.width() / 2, image.height() / 2);
}

// Light adds up: the picture (of F32) with all of the scene's lights on is, within two steps of 255
// of its brightest value, the sum of those with each alone. All are on before and after.
void expectSumOfEachLightAlone(scene::Scene& scene, const std::function<Image()>& picture);

// How much of a disc one sees behind a straight edge. t: place in its penumbra, -1 (nothing) to 1.
double visibleShareOfDisc(double t);

// Three channels of F32, as the metrics want them.
Image asFloatRgb(const Image& image);

// A small scene with every kind of surface and light that the passes tell apart: Phong and
// metallic-roughness, textured, alpha-tested, translucent and custom-shader boxes on a floor; a
// directional, a point and a spot light; a camera.
scene::Scene sampleScene();

// A scene with a camera at the origin that looks along -z, and nothing else: no light, no ambient,
// a black background.
scene::Scene emptyScene();
// A wall of 10 m at z = -distance that faces the camera of emptyScene(); returns its material.
scene::Material& addWall(scene::Scene& scene, float distance);
// Adds a light; it stands at `eye` and shines towards `target`.
void addLight(scene::Scene& scene, scene::Light light, vec3 eye, vec3 target);

// A unit cube's mesh (side 1, centred) with normals, tangents and texture coordinates.
scene::Mesh cubeMesh();
// Adds an object with the mesh and material given by index.
void addObject(scene::Scene& scene, std::uint32_t mesh, std::uint32_t material,
               const mat4& worldFromObject);
// Adds a box with its middle there, of that material; updateTransforms() is up to the caller.
void addBox(scene::Scene& scene, vec3 middle, vec3 sides, std::uint32_t material = 0);
// Adds a camera at `eye` that looks at `target`.
void addCamera(scene::Scene& scene, vec3 eye, vec3 target, float fovY = 0.9f);

}  // namespace lucerna::testing

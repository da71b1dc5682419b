#include "passes/depth_of_field/depth_of_field.hpp"

#include <cmath>
#include <initializer_list>
#include <map>
#include <string>

namespace lucerna::passes {

using gpu::Format;
using gpu::Texture;

namespace {

// px, as in tile.glsl. Windows begin at multiples of it, so that all have the same tiles.
constexpr int kTile = 16;

int tilesAcross(float pixels) {
  return static_cast<int>(std::ceil(pixels / kTile));
}

// In sixteenths, so that windows' smaller pictures, too, begin at the same pixels.
float scaleOf(float scale) {
  return std::round(scale * 16.f) / 16.f;
}

// px around a pixel that count for it. Of the gather method: the circles that reach it, as smooth
// as whoever reads them requires by the circles that reach there, and the tiles that tell those.
int haloOf(const DepthOfField::Params& params) {
  const float radius = params.maximumRadius;
  if (params.method == DepthOfField::Method::Separable)
    return static_cast<int>(std::ceil(radius)) + 4;
  const float stride = 2.f * radius / (static_cast<float>(params.steps) + 0.5f);  // at most
  return static_cast<int>(std::ceil(3.f * radius + 2.f * stride)) + 3 * kTile;
}

// circle.glsl. A point at distance d is spread over a disc of radius R |d - D| / d on the plane in
// focus at distance D, R being the lens's radius (in an orthographic view: over R |d - D| / D).
// With clip.w = d there (or 1), and `pixels` of a length of 1 at clip.w = 1, both are pixels R (d /
// D - 1) / clip.w px. d / clip.w and 1 / clip.w are -z and w of viewFromClip (x, y, depth, 1), and
// these follow from the depth alone, linearly.
vec4 lensOf(const render::ViewData& data, const DepthOfField::Params& params) {
  const scene::View& view = data.view;
  const glm::dmat4 viewFromClip = glm::inverse(glm::dmat4(view.clipFromView));
  const double focus = params.focusDistance;
  const double pixels = 0.5 * data.size.y * view.clipFromView[1][1] * params.lensRadius;
  const auto radius = [&](const glm::dvec4& column) {
    return static_cast<float>(pixels * (-column.z / focus - column.w));
  };
  const double infinity =
      view.orthographic ? (pixels > 0 ? params.maximumRadius : 0) : pixels / focus;
  return {radius(viewFromClip[2]), radius(viewFromClip[3]), static_cast<float>(infinity),
          params.maximumRadius};
}

void fit(gpu::Device& device, Texture& texture, Format format, ivec2 size) {
  if (texture && ivec2(texture.width(), texture.height()) == size) return;
  texture =
      device.createTexture({.format = format, .width = size.x, .height = size.y}, "DepthOfField");
}

struct Binding {
  const char* name;
  const Texture& texture;
  gpu::Sampler sampler = gpu::kNearest;
};

// Over the whole of the targets.
void draw(gpu::Device& device, const gpu::ProgramPtr& program,
          std::initializer_list<const Texture*> targets, std::initializer_list<Binding> bindings) {
  gpu::Targets to;
  for (const Texture* target : targets) to.colors.push_back({target, gpu::Load::Discard});
  gpu::Rendering rendering = device.render(to);
  rendering.use(*program, {.cull = gpu::Cull::None});
  for (const Binding& b : bindings) rendering.texture(b.name, b.texture, b.sampler);
  rendering.fullscreen();
}

ivec2 sizeOf(const Texture& texture) {
  return {texture.width(), texture.height()};
}

}  // namespace

void DepthOfField::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("DepthOfField", "Blurs what is out of focus, as a thin lens does.");
  d.param("lensRadius", &Params::lensRadius)
      .range(0, 1e4)
      .unit("m")
      .help("Of the lens: focal length / (2 f-number). 0: everything is sharp.");
  d.param("focusDistance", &Params::focusDistance)
      .range(1e-3, 1e6)
      .unit("m")
      .help("Along the view, where everything is sharp.");
  d.param("maximumRadius", &Params::maximumRadius)
      .range(1, 256)
      .unit("px")
      .rebuilds(graph::Rebuild::Ports)
      .help("Larger circles of confusion become as large as this.");
  d.param("method", &Params::method)
      .choices({"gather", "separable"})
      .rebuilds(graph::Rebuild::Ports)
      .help(
          "gather: each pixel from the circles that reach it, so that what is sharp stays clear of "
          "what is blurred; separable: system A's, along rows, then columns.");
  d.param("steps", &Params::steps)
      .range(1, 32)
      .rebuilds(graph::Rebuild::Ports)
      .help(
          "gather: pixels read between the middle of a circle and its rim, at most; of larger "
          "ones every second, fourth, ... is.");
  d.param("scale", &Params::scale)
      .range(0.25, 1)
      .help("separable: of the blurred picture, in sixteenths.");
  d.param("view", &Params::show)
      .choices({"picture", "setup"})
      .rebuilds(graph::Rebuild::Ports)
      .help("setup: red is in focus; of the rest, white is blurred by maximumRadius.");
  const int halo = haloOf(d.values());
  if (d.values().show == Show::Setup)
    d.read("scene", &Ports::scene).help("For its exposure: red and white are that of the picture.");
  d.read("view", &Ports::view).help("The view that color and depth were drawn from.");
  d.read("color", &Ports::input).texture(Format::Rgba16Float).halo(halo).help("Linear radiance.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .sameSizeAs("color")
      .halo(halo)
      .help("Reversed depth. Where nothing was drawn is infinitely far.");
  d.write("color", &Ports::output)
      .texture(Format::Rgba16Float)
      .sizeOf("color")
      .passesThrough("color")
      .help("Linear radiance.");
}

DepthOfField::DepthOfField(gpu::Device& device) {
  const auto program = [&](const char* name, std::map<std::string, std::string> defines = {}) {
    return device.program({.vertex = "gpu/fullscreen.vert",
                           .fragment = fmt::format("passes/depth_of_field/{}.frag", name),
                           .defines = std::move(defines)});
  };
  tilesProgram_ = program("tiles");
  spreadProgram_ = program("spread");
  layerOfPictureProgram_ = program("layer", {{"OF_PICTURE", "1"}});
  layerProgram_ = program("layer");
  behindProgram_ = program("behind");
  gatherProgram_ = program("gather");
  blurProgram_ = program("blur");
  combineProgram_ = program("combine");
  setupProgram_ = program("setup");
}

void DepthOfField::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const Inputs in{params, ports, lensOf(*ports.view, params)};
  if (params.show == Show::Setup)
    setUp(context.device, in);
  else if (params.lensRadius == 0.f)
    context.device.copy(*ports.input, *ports.output);
  else if (params.method == Method::Gather)
    gather(context.device, in);
  else
    blur(context.device, in);
}

void DepthOfField::gather(gpu::Device& device, const Inputs& in) {
  const Ports& ports = in.ports;
  fitGather(device, sizeOf(*ports.input));
  findLargest(device, in);
  makeLayer(device, in, -1.f, near_);
  makeLayer(device, in, 1.f, far_);
  behindProgram_->set("lens", in.lens);
  behindProgram_->set("steps", in.params.steps);
  draw(device, behindProgram_, {&behind_, &narrow_, &narrowRadius_},
       {{"color", *ports.input}, {"depth", *ports.depth}});
  gatherProgram_->set("lens", in.lens);
  gatherProgram_->set("steps", in.params.steps);
  gatherProgram_->set("uvOfPixel", 1.f / vec2(4 * sizeOf(behind_)));
  draw(device, gatherProgram_, {ports.output.get()},
       {{"color", *ports.input},
        {"depth", *ports.depth},
        {"largest", largest_},
        {"widest", widest_},
        {"nearLayer", near_.light},
        {"nearCover", near_.cover},
        {"farLayer", far_.light},
        {"farCover", far_.cover},
        {"behind", behind_, gpu::kLinear},
        {"narrow", narrow_, gpu::kLinear},
        {"narrowRadius", narrowRadius_, gpu::kLinear}});
}

void DepthOfField::fitGather(gpu::Device& device, ivec2 size) {
  for (Texture* texture : {&tiles_, &largest_, &widest_})
    fit(device, *texture, Format::Rgba32Float, (size + kTile - 1) / kTile);
  for (Layer* layer : {&along_, &near_, &far_}) {
    fit(device, layer->light, Format::Rgba16Float, size);
    fit(device, layer->cover, Format::R8Unorm, size);
  }
  for (Texture* texture : {&behind_, &narrow_, &narrowRadius_})
    fit(device, *texture, Format::Rgba16Float, (size + 3) / 4);
}

void DepthOfField::findLargest(gpu::Device& device, const Inputs& in) {
  tilesProgram_->set("lens", in.lens);
  tilesProgram_->set("steps", in.params.steps);
  draw(device, tilesProgram_, {&tiles_}, {{"depth", *in.ports.depth}});
  spreadProgram_->set("reach", tilesAcross(in.params.maximumRadius));
  draw(device, spreadProgram_, {&largest_}, {{"tiles", tiles_}});
  draw(device, spreadProgram_, {&widest_}, {{"tiles", largest_}});
}

void DepthOfField::makeLayer(gpu::Device& device, const Inputs& in, float side,
                             const Layer& layer) {
  for (const gpu::ProgramPtr& program : {layerOfPictureProgram_, layerProgram_}) {
    program->set("lens", in.lens);
    program->set("steps", in.params.steps);
    program->set("side", side);
  }
  layerOfPictureProgram_->set("direction", ivec2(1, 0));
  draw(device, layerOfPictureProgram_, {&along_.light, &along_.cover},
       {{"source", *in.ports.input},
        {"depth", *in.ports.depth},
        {"largest", largest_},
        {"widest", widest_}});
  layerProgram_->set("direction", ivec2(0, 1));
  draw(device, layerProgram_, {&layer.light, &layer.cover},
       {{"source", along_.light},
        {"cover", along_.cover},
        {"largest", largest_},
        {"widest", widest_}});
}

void DepthOfField::blur(gpu::Device& device, const Inputs& in) {
  const Ports& ports = in.ports;
  const vec2 size(sizeOf(*ports.input));
  const float scale = scaleOf(in.params.scale);
  for (Texture& texture : small_)
    fit(device, texture, Format::Rgba16Float, ivec2(glm::ceil(size * scale)));
  const vec2 small(sizeOf(small_[0]));
  blurAlong(device, in, *ports.input, small_[0], size * scale, {1, 0});
  blurAlong(device, in, small_[0], small_[1], small, {0, 1});
  combineProgram_->set("lens", in.lens);
  combineProgram_->set("uvOfPixel", scale / small);
  draw(device, combineProgram_, {ports.output.get()},
       {{"color", *ports.input}, {"depth", *ports.depth}, {"blurred", small_[1], gpu::kLinear}});
}

// pixelsOfFrom: how many pixels of `to` lie across `from`.
void DepthOfField::blurAlong(gpu::Device& device, const Inputs& in, const Texture& from,
                             const Texture& to, vec2 pixelsOfFrom, vec2 direction) {
  blurProgram_->set("lens", in.lens);
  blurProgram_->set("scale", scaleOf(in.params.scale));
  blurProgram_->set("uvOfPixel", 1.f / pixelsOfFrom);
  blurProgram_->set("direction", direction);
  draw(device, blurProgram_, {&to}, {{"picture", from, gpu::kLinear}, {"depth", *in.ports.depth}});
}

void DepthOfField::setUp(gpu::Device& device, const Inputs& in) {
  setupProgram_->set("lens", in.lens);
  setupProgram_->set("white", std::exp2(-in.ports.scene->scene->exposure));
  draw(device, setupProgram_, {in.ports.output.get()}, {{"depth", *in.ports.depth}});
}

}  // namespace lucerna::passes

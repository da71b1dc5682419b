// lucerna reference SCENE -o ref.exr

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "app/prepare_scene.hpp"
#include "command_line.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "image/image_file.hpp"
#include "render_flags.hpp"
#include "scene/load.hpp"
#include "trace/reference.hpp"

namespace lucerna::cli {
namespace {

const std::vector<std::string> kLayers{"color", "direct",     "reflection",
                                       "ao",    "visibility", "error"};

struct Options {
  app::RenderSettings render;
  trace::ReferenceSettings reference;
  std::string output;
  std::vector<std::string> layers{"color"};

  bool wants(const std::string& layer) const {
    return std::ranges::find(layers, layer) != layers.end();
  }
};

Status checkOutput(const Options& options) {
  if (options.wants("ao") && options.reference.aoRadius == 0.f)
    return error(ErrorKind::Usage,
                 "--layers ao: without a radius nothing is occluded; add --ao-radius METRES");
  LUCERNA_TRY_VOID(checkFolderOf(options.output, "-o"));
  LUCERNA_TRY_VOID(
      checkIsNone(options.output, "-o", std::vector{options.render.scene, options.render.camera}));
  const auto extension = std::filesystem::path(options.output).extension();
  if (extension == ".exr" || (extension == ".hdr" && options.layers.size() == 1)) return {};
  if (extension == ".hdr")
    return error(ErrorKind::Usage, "{}: .hdr holds one picture; wanted .exr for several layers",
                 options.output);
  return error(ErrorKind::Usage,
               "{}: '{}' does not keep linear colour; wanted .exr or .hdr, which `lucerna compare` "
               "reads",
               options.output, extension.string());
}

std::vector<ExrLayer> layersOf(const Options& options, const trace::ReferencePicture& picture) {
  std::vector<ExrLayer> layers;
  const auto put = [&](const std::string& name, std::vector<std::string> channels,
                       const Image& image) {
    // One alone is the file's main picture, which everybody reads.
    const bool alone = options.layers.size() == 1 && name != "visibility";
    layers.push_back({.name = alone ? "" : name, .channels = std::move(channels), .image = image});
  };
  for (const std::string& layer : options.layers) {
    if (layer == "color") put("", {"R", "G", "B"}, picture.color);
    if (layer == "direct") put(layer, {"R", "G", "B"}, picture.direct);
    if (layer == "reflection") put(layer, {"R", "G", "B"}, picture.reflection);
    if (layer == "ao") put(layer, {"Y"}, picture.ao);
    if (layer == "error") put(layer, {"Y"}, picture.error);
    if (layer == "visibility")
      for (std::size_t i = 0; i < picture.visibility.size(); ++i)
        put(layer, {fmt::format("{}", i)}, picture.visibility[i]);
  }
  return layers;
}

Status writePicture(const Options& options, const trace::ReferencePicture& picture) {
  const std::vector<ExrLayer> layers = layersOf(options, picture);
  if (std::filesystem::path(options.output).extension() == ".exr")
    return writeExr(options.output, layers);
  return writeImage(options.output, layers.front().image);
}

// The error that `share` of the pixels stay within.
double errorQuantile(const Image& errors, double share) {
  std::vector<float> values(errors.as<float>().begin(), errors.as<float>().end());
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return static_cast<double>(*at);
}

Json lightsOf(const scene::Scene& scene) {
  Json lights = Json::array();
  for (const scene::PlacedLight& light : placeLights(scene))
    lights.push_back(scene.lights[light.light].name);
  return lights;
}

void warnOfShaders(const scene::Scene& scene) {
  for (const scene::Material& material : scene.materials)
    if (material.shader.used())
      log::warning("material '{}': its shader is not traced; it shows as the material without",
                   material.name);
}

Result<int> reference(Options& options, bool json) {
  const auto start = std::chrono::steady_clock::now();
  LUCERNA_TRY_VOID(checkOutput(options));
  setThreadCount(options.render.threads);
  LUCERNA_TRY(scene, scene::loadScene(options.render.scene));
  LUCERNA_TRY(camera, app::prepareScene(scene, options.render));
  scene::animate(scene, static_cast<float>(options.render.time));
  warnOfShaders(scene);

  trace::ReferenceSettings& settings = options.reference;
  settings.size = options.render.size;
  settings.seed = options.render.seed;
  settings.visibility = options.wants("visibility");
  settings.view = viewOf(scene, scene.cameras[camera],
                         static_cast<float>(settings.size.x) / static_cast<float>(settings.size.y));
  const trace::ReferencePicture picture = renderReference(scene, settings);
  LUCERNA_TRY_VOID(writePicture(options, picture));

  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const double median = errorQuantile(picture.error, 0.5),
               high = errorQuantile(picture.error, 0.99);
  if (json)
    printJson({{"files", {options.output}},
               {"scene", scene.name},
               {"size", {settings.size.x, settings.size.y}},
               {"layers", options.layers},
               {"lights", lightsOf(scene)},
               {"samples", picture.meanSamples},
               {"cancelled", picture.cancelled},
               {"error", {{"median", median}, {"p99", high}}},
               {"rays", {{"closest", picture.rays.closest}, {"occlusion", picture.rays.occlusion}}},
               {"cpu_seconds", {{"rays", picture.rays.seconds}, {"all", picture.seconds}}},
               {"seconds", seconds.count()},
               {"warnings", scene.warnings}});
  else
    log::info(
        "wrote {} in {:.1f} s: {:.1f} samples a pixel{}", options.output, seconds.count(),
        picture.meanSamples,
        std::isfinite(high)  // one sample says nothing of its error
            ? fmt::format(", standard error {:.2g} in the median, {:.2g} in 99 % of the pixels",
                          median, high)
            : "");
  if (!picture.cancelled) return 0;
  log::error("cancelled; {} holds the samples made so far", options.output);
  return static_cast<int>(ErrorKind::Cancelled);
}

void addQualityFlags(CLI::App& command, trace::ReferenceSettings& settings) {
  command
      .add_option("--spp", settings.samples, "samples a pixel, at most; best a power of two (256)")
      ->check(wholeNumber(1, 1 << 24));
  command
      .add_option("--error", settings.error,
                  "standard error at which a pixel is done, as a share of its value; 0: never (0)")
      ->check(between(0, 1));
  command
      .add_option_function<std::string>(
          "--primary",
          [&](const std::string& value) {
            settings.primary =
                value == "centre" ? trace::Primary::Centre : trace::Primary::Filtered;
          },
          "rays through all the pixel (filtered) or its centre alone, as a rasteriser without "
          "anti-aliasing (filtered)")
      ->check(oneOf({"filtered", "centre"}));
}

void addLightFlags(CLI::App& command, trace::ReferenceSettings& settings) {
  command
      .add_option_function<std::string>(
          "--shading",
          [&](const std::string& value) {
            settings.shading = value == "point" ? trace::Shading::Point : trace::Shading::Area;
          },
          "light from all of its area, or point: from its centre, times mean visibility (area)")
      ->check(oneOf({"area", "point"}));
  command
      .add_option_function<std::string>(
          "--shadows", [&](const std::string& value) { settings.shadows = value == "on"; },
          "on, or off: light goes through everything (on)")
      ->check(oneOf({"on", "off"}));
  command.add_option("--bounces", settings.bounces, "of diffuse light between surfaces (0)")
      ->check(wholeNumber(0, 64));
  command.add_option("--mirrors", settings.mirrors, "most reflections of a ray (8)")
      ->check(wholeNumber(0, 64));
  command
      .add_option("--ao-radius", settings.aoRadius,
                  "m: surfaces this near take ambient light away (0: none)")
      ->check(between(0, 1e6, "m"));
}

}  // namespace

void addReference(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      addCommand(line, line.app, "reference", "trace the ground truth of a scene by rays",
                 [&line, options] { return reference(*options, line.talk.json); });
  command->add_option("SCENE", options->render.scene, sceneHelp())->required();
  command->add_option("-o,--output", options->output, "out.exr, or out.hdr (one layer)")
      ->required();
  addSceneFlags(*command, options->render);
  addQualityFlags(*command, options->reference);
  addLightFlags(*command, options->reference);
  CLI::Option* lens =
      command->add_option("--lens-radius", options->reference.lensRadius, "m, of a thin lens (0)")
          ->check(between(0, 1000, "m"));
  command
      ->add_option("--focus-distance", options->reference.focusDistance,
                   "m along the view, where everything is sharp")
      ->check(between(0.001, 1e6, "m"))
      ->needs(lens);
  command
      ->add_option("--layers", options->layers,
                   "of EXR: color,direct,reflection,ao,visibility,error (color)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(oneOf(kLayers));
}

}  // namespace lucerna::cli

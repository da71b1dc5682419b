#include "render_flags.hpp"

#include <limits>

#include "core/text.hpp"

namespace lucerna::cli {
namespace {

std::string checkGl(const std::string& value) {
  const std::vector<std::string> choices{"auto", "egl"};
  if (value == "auto" || value == "egl") return {};
  if (value == "window") return "this program draws without a window; wanted auto or egl";
  return fmt::format("'{}' is not a choice{}; wanted auto or egl", value,
                     didYouMean(value, choices));
}

void addLightmapFlags(CLI::App& command, app::RenderSettings& settings) {
  CLI::Option* lightmap =
      command.add_option("--lightmap", settings.lightmap,
                         "DIR that `lucerna bake` made of this scene: its light instead of those "
                         "lights'");
  addRepeatable(command, "--lights-off", settings.lightsOff,
                "GROUP,GROUP... of the lightmap's lights that are off; repeatable")
      ->delimiter(',')
      ->transform(trimmed())
      ->needs(lightmap);
}

}  // namespace

CLI::Option* addRepeatable(CLI::App& command, const std::string& name,
                           std::vector<std::string>& values, const std::string& help) {
  return command.add_option(name, values, help)->allow_extra_args(false);
}

void addPluginFlag(CLI::App& command, std::vector<std::string>& plugins) {
  addRepeatable(command, "--plugin", plugins, "FILE.so: passes from a shared library; repeatable");
}

void addSceneFlags(CLI::App& command, app::RenderSettings& settings) {
  command.add_option_function<std::string>(
      "--size",
      [&](const std::string& text) {
        settings.size = orUsageError("--size", app::sizeFromText(text));
      },
      "WIDTHxHEIGHT of the output in pixels (1280x720)");
  command.add_option("--camera", settings.camera, "NAME, INDEX or FILE.json (the scene's first)");
  command.add_option("--animation", settings.animation,
                     "NAME or INDEX of the one that plays, or none (of each file the first)");
  command.add_option("--time", settings.time, "seconds into the scene's animation (0)")
      ->check(between(-1e6, 1e6, "s"));
  command.add_option("--seed", settings.seed, "seed of everything random (0)")
      ->check(wholeNumber(0, std::numeric_limits<std::uint64_t>::max()));
  command.add_option("--threads", settings.threads, "CPU threads; 0: one a core (0)")
      ->check(wholeNumber(0, 1024));
  command
      .add_option_function<float>(
          "--exposure", [&](float value) { settings.exposure = value; },
          "EV instead of the scene's; one more doubles the brightness")
      ->check(between(-64, 64, "EV"));
}

void addRenderFlags(CLI::App& command, app::RenderSettings& settings) {
  const CLI::Option* pipeline =
      command.add_option("--pipeline", settings.pipeline,
                         "shipped NAME, FILE.js or FILE.json (deferred; lightmapped with "
                         "--lightmap)");
  addLightmapFlags(command, settings);
  command.parse_complete_callback([&settings, pipeline] {
    if (!settings.lightmap.empty() && pipeline->count() == 0) settings.pipeline = "lightmapped";
  });
  addRepeatable(command, "--set", settings.sets,
                "Pass.param=value, Pass.enabled=false or script.name=value; repeatable");
  addPluginFlag(command, settings.plugins);
  addSceneFlags(command, settings);
  command.add_option("--scale", settings.scale, "rendering size in percent of the output's (100)")
      ->check(wholeNumber(25, 400));
  command
      .add_option("--camera-path", settings.cameraPath,
                  "FILE.json of keyframes that the camera follows")
      ->excludes("--camera");
  command.add_option("--frames", settings.frames, "how many frames (1)")
      ->check(wholeNumber(1, 10'000'000));
  command.add_option("--time-step", settings.timeStep, "seconds from frame to frame (1/30)")
      ->check(between(0, 1e6, "s"));
  command.add_option("--profile", settings.profile,
                     "FILE.csv, .json, .md or .html: times and counts of every pass");
  command.add_option("--shaders", settings.shaderFolder,
                     "folder like src/ whose shaders go before the built-in ones");
  command
      .add_option_function<std::string>(
          "--gl",
          [&](const std::string& value) {
            settings.gl = value == "egl" ? gpu::ContextKind::Egl : gpu::ContextKind::Auto;
          },
          "auto or egl (auto)")
      ->check(CLI::Validator(checkGl, "{auto,egl}"));
}

}  // namespace lucerna::cli

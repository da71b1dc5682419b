// lucerna render SCENE -o out.png|.mp4

#include <chrono>
#include <map>
#include <memory>
#include <optional>

#include "app/frame.hpp"
#include "app/frame_writer.hpp"
#include "app/row_files.hpp"
#include "command_line.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/progress.hpp"
#include "render_flags.hpp"

namespace lucerna::cli {
namespace {

struct Options {
  app::RenderSettings render;
  app::OutputSettings output;
};

Json document(const app::Session& session, const app::FrameWriter& writer, double seconds) {
  Json files = Json::array();
  for (const auto& path : writer.written()) files.push_back(path.string());
  for (const auto& path : session.rowFiles) files.push_back(path.string());
  std::vector<std::string> warnings = session.scene.warnings;
  const auto& ofPipeline = session.executor->warnings();
  warnings.insert(warnings.end(), ofPipeline.begin(), ofPipeline.end());
  const uvec2 size = session.settings.pictureSize();
  return {{"files", std::move(files)},
          {"scene", session.scene.name},
          {"pipeline", session.pipeline.name},
          {"size", {size.x, size.y}},
          {"frames", session.frame},
          {"seconds", seconds},
          {"renderer", session.device->description()},
          {"triangles", session.scene.triangleCount()},
          {"gl_messages", session.glMessages},
          {"warnings", std::move(warnings)}};
}

Status renderFrames(app::Session& session, app::FrameWriter& writer, app::ProfileLog* profile) {
  std::optional<Progress> progress;  // the first frame says how many views there are
  const app::FrameSink write = [&](app::Session& s, int view,
                                   const gpu::Texture& output) -> Status {
    if (!progress) progress.emplace("rendering", s.settings.frames * s.plan.places.size());
    LUCERNA_TRY_VOID(writer.write(s, view, output));
    progress->advance();
    return {};
  };
  while (session.frame < session.settings.frames)
    LUCERNA_TRY_VOID(app::runFrame(session, profile, write));
  return {};
}

app::ProfileSubject profileSubject(const app::Session& session) {
  return {.scene = session.scene.name,
          .pipeline = session.pipeline.name,
          .renderer = session.device->description(),
          .size = session.settings.size,
          .plan = session.plan,
          .gpuClock = session.device->timersUseCpuClock() ? "cpu-after-finish" : "gpu-timer"};
}

Status writeProfile(app::ProfileLog& profile, const app::Session& session,
                    const std::string& path) {
  if (profile.empty()) return {};  // not asked for, or cancelled before the first frame
  profile.setSubject(profileSubject(session));
  LUCERNA_TRY_VOID(profile.write(path));
  log::info("mean cost of a frame\n{}", profile.table());
  return {};
}

// "city.mp4, 120 frames", "frame-0059.png and 59 more".
std::string whatWasWritten(const app::Session& session, const app::FrameWriter& writer) {
  const std::string last = writer.written().back().string();
  const std::size_t files = writer.written().size();
  if (files > 1) return fmt::format("{} and {} more", last, files - 1);
  return session.frame > 1 ? fmt::format("{}, {} frames", last, session.frame) : last;
}

Result<int> render(const Options& options, bool json) {
  const auto start = std::chrono::steady_clock::now();
  LUCERNA_TRY(writer, app::FrameWriter::create(options.output, options.render));
  const app::RenderSettings& settings = options.render;
  const std::string& profilePath = settings.profile;
  const std::vector read{settings.scene, settings.pipeline, settings.camera, settings.cameraPath};
  LUCERNA_TRY_VOID(checkIsNone(options.output.path, "-o", read));
  if (!profilePath.empty()) {
    LUCERNA_TRY_VOID(app::ProfileLog::checkPath(profilePath));
    LUCERNA_TRY_VOID(checkIsNone(profilePath, "--profile", read));
  }
  LUCERNA_TRY(session, app::openSession(options.render, writer.layers()));
  LUCERNA_TRY_VOID(
      app::checkRowFiles(session->pipeline, session->registry, writer.name(), options.render));
  app::ProfileLog profile;
  const Status drawn = renderFrames(*session, writer, profilePath.empty() ? nullptr : &profile);
  // What was drawn before Ctrl-C is whole and stays, with its profile.
  if (drawn || drawn.error().kind == ErrorKind::Cancelled) {
    LUCERNA_TRY_VOID(writer.finish());
    LUCERNA_TRY_VOID(writeProfile(profile, *session, profilePath));
  }
  if (!drawn && !writer.written().empty()) log::info("kept {}", whatWasWritten(*session, writer));
  LUCERNA_TRY_VOID(drawn);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (json)
    printJson(document(*session, writer, seconds.count()));
  else
    log::info("wrote {} in {:.2f} s", whatWasWritten(*session, writer), seconds.count());
  return 0;
}

void addVideoFlags(CLI::App& command, const std::shared_ptr<Options>& options) {
  app::OutputSettings& output = options->output;
  command
      .add_option_function<double>(
          "--fps", [options](double value) { options->output.fps = value; },
          "frames a second of a video (one a --time-step)")
      ->check(between(0.001, 1000));
  CLI::Option* crf = command
                         .add_option_function<int>(
                             "--crf", [options](int value) { options->output.crf = value; },
                             "H.264 quality: constant rate factor, 0 (best) to 51 (18)")
                         ->check(wholeNumber(0, 51));
  command.add_flag("--lossless", output.lossless, "FFV1 instead of H.264; needs an .mkv file")
      ->excludes(crf);
}

void addStereoFlags(CLI::App& command, app::StereoSettings& stereo) {
  const std::map<std::string, app::StereoLayout> layouts{{"sbs", app::StereoLayout::SideBySide},
                                                         {"tb", app::StereoLayout::TopBottom},
                                                         {"anaglyph", app::StereoLayout::Anaglyph}};
  CLI::Option* layout =
      command
          .add_option_function<std::string>(
              "--stereo",
              [&stereo, layouts](const std::string& name) { stereo.layout = layouts.at(name); },
              "sbs (left eye left, twice as wide), tb (left eye above, twice as "
              "high) or anaglyph (left eye red)")
          ->check(oneOf({"sbs", "tb", "anaglyph"}));
  command.add_option("--separation", stereo.separation, "m between the eyes (0.065)")
      ->check(between(0, 1000, "m"))
      ->needs(layout);
  command
      .add_option("--convergence", stereo.convergence,
                  "m ahead, where the eyes' pictures coincide (3)")
      ->check(between(0.001, 1e6, "m"))
      ->needs(layout);
}

}  // namespace

void addRender(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      addCommand(line, line.app, "render", "render a scene into pictures or a video",
                 [&line, options] { return render(*options, line.talk.json); });
  command->add_option("SCENE", options->render.scene, sceneHelp())->required();
  command
      ->add_option("-o,--output", options->output.path,
                   "out.png, .exr, .hdr, .mp4, .mkv or frame-%04d.png")
      ->required();
  addRenderFlags(*command, options->render);
  command
      ->add_option("--layers", options->output.layers, "of EXR: color,depth,normal,albedo (color)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option_function<std::string>(
          "--exr-type",
          [options](const std::string& type) {
            options->output.exrType = type == "float" ? ComponentType::F32 : ComponentType::Half;
          },
          "of EXR: half or float (half); depth is always float")
      ->check(oneOf({"half", "float"}));
  addVideoFlags(*command, options);
  command
      ->add_option_function<std::uint64_t>(
          "--tile",
          [options](std::uint64_t side) {
            constexpr std::uint64_t kGrid = app::kTileGrid;
            options->render.tile = static_cast<int>((side + kGrid - 1) / kGrid * kGrid);
          },
          "draw in tiles of N x N px, rounded up to 16 (only where the driver's textures are "
          "smaller)")
      ->check(wholeNumber(app::kTileGrid, app::kMaxSide));
  addStereoFlags(*command, options->render.stereo);
}

}  // namespace lucerna::cli

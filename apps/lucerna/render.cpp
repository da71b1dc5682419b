// lucerna render SCENE -o out.png|.mp4

#include <chrono>
#include <memory>

#include "app/frame.hpp"
#include "app/frame_writer.hpp"
#include "command_line.hpp"
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
  std::vector<std::string> warnings = session.scene.warnings;
  const auto& ofPipeline = session.executor->warnings();
  warnings.insert(warnings.end(), ofPipeline.begin(), ofPipeline.end());
  return {{"files", std::move(files)},
          {"scene", session.scene.name},
          {"pipeline", session.pipeline.name},
          {"size", {session.settings.size.x, session.settings.size.y}},
          {"frames", session.frame},
          {"seconds", seconds},
          {"renderer", session.device->description()},
          {"triangles", session.scene.triangleCount()},
          {"gl_messages", session.glMessages},
          {"warnings", std::move(warnings)}};
}

Status renderFrames(app::Session& session, app::FrameWriter& writer, app::ProfileLog* profile) {
  Progress progress("rendering", session.settings.frames);
  const app::FrameSink write = [&](app::Session& s, const gpu::Texture& output) {
    return writer.write(s, output);
  };
  while (session.frame < session.settings.frames) {
    LUCERNA_TRY_VOID(app::runFrame(session, profile, write));
    progress.advance();
  }
  return {};
}

app::ProfileSubject profileSubject(const app::Session& session) {
  return {.scene = session.scene.name,
          .pipeline = session.pipeline.name,
          .renderer = session.device->description(),
          .size = session.settings.size,
          .gpuClock = session.device->timersUseCpuClock() ? "cpu-after-finish" : "gpu-timer"};
}

Status writeProfile(const app::ProfileLog& profile, const std::string& path) {
  if (profile.empty()) return {};  // not asked for, or cancelled before the first frame
  LUCERNA_TRY_VOID(profile.write(path));
  log::info("mean cost of a frame\n{}", profile.table());
  return {};
}

Result<int> render(const Options& options, bool json) {
  const auto start = std::chrono::steady_clock::now();
  LUCERNA_TRY(writer, app::FrameWriter::create(options.output, options.render));
  const std::string& profilePath = options.render.profile;
  if (!profilePath.empty()) LUCERNA_TRY_VOID(app::ProfileLog::checkPath(profilePath));
  LUCERNA_TRY(session, app::openSession(options.render, writer.layers()));
  app::ProfileLog profile(profileSubject(*session));
  const Status drawn = renderFrames(*session, writer, profilePath.empty() ? nullptr : &profile);
  // What was drawn before Ctrl-C is whole and stays, with its profile.
  if (drawn || drawn.error().kind == ErrorKind::Cancelled) {
    LUCERNA_TRY_VOID(writer.finish());
    LUCERNA_TRY_VOID(writeProfile(profile, profilePath));
  }
  if (!drawn && !writer.written().empty())
    log::info("kept: {}, {} frames", writer.written().back().string(), session->frame);
  LUCERNA_TRY_VOID(drawn);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (json)
    printJson(document(*session, writer, seconds.count()));
  else
    log::info("wrote {}{} in {:.2f} s", writer.written().back().string(),
              session->frame > 1 ? fmt::format(" and {} more", session->frame - 1) : "",
              seconds.count());
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

}  // namespace

void addRender(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      addCommand(line, line.app, "render", "render a scene into pictures or a video",
                 [&line, options] { return render(*options, line.talk.json); });
  command->add_option("SCENE", options->render.scene, "file, or builtin:NAME?key=value")
      ->required();
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
          "half or float (half); depth is always float")
      ->check(oneOf({"half", "float"}));
  addVideoFlags(*command, options);
}

}  // namespace lucerna::cli

// A program of one's own around Lucerna, with a pass that is compiled in:
//
//   vignette_program PIPELINE PICTURE.png
#include <cstdio>

#include "app/frame.hpp"
#include "app/frame_writer.hpp"
#include "vignette.hpp"

using namespace lucerna;

namespace {

Status draw(const char* pipeline, const char* picture) {
  LUCERNA_TRY(registry, app::makeRegistry());
  registry.shaders()->add(Vignette::shaders());
  registry.add<Vignette>();

  app::RenderSettings settings;
  settings.scene = "builtin:atrium";
  settings.pipeline = pipeline;
  settings.size = {320, 180};
  app::OutputSettings output;
  output.path = picture;
  LUCERNA_TRY(writer, app::FrameWriter::create(output, settings));
  LUCERNA_TRY(session, app::openSession(settings, std::move(registry), writer.layers()));
  const app::FrameSink write = [&](app::Session& s, int view, const gpu::Texture& texture) {
    return writer.write(s, view, texture);
  };
  LUCERNA_TRY_VOID(app::runFrame(*session, nullptr, write));
  return writer.finish();
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::fprintf(stderr, "usage: vignette_program PIPELINE PICTURE.png\n");
    return static_cast<int>(ErrorKind::Usage);
  }
  const Status drawn = draw(words[1], words[2]);
  if (drawn) return 0;
  std::fprintf(stderr, "%s\n", drawn.error().message.c_str());
  return static_cast<int>(drawn.error().kind);
}

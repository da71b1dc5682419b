#include "passes/save_image/save_image.hpp"

#include "gpu/device.hpp"
#include "passes/save_image/saved_file.hpp"

namespace lucerna::passes {

void SaveImage::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("SaveImage", "Writes a texture to a picture file, at its place in the list.");
  d.param("file", &Params::file)
      .writesFile()
      .rebuilds(graph::Rebuild::Ports)
      .help(
          "A .png, .exr or .hdr file, relative to the working directory; %04d in the name is the "
          "frame's number.");
  auto port = d.read("color", &Ports::color);
  port.help("What is written; as `reads` says, or the picture so far.");
  const auto file = SavedFile::parse(d.values().file);
  if (file)
    port.spec(gpu::TextureKind::Plain2D, file->formats());
  else
    d.fault({.param = "file",
             .found = file.error().message,
             .wanted = "a .png, .exr or .hdr file in a folder that exists, like depth-%04d.exr",
             .remedy = "correct the name, or make the folder first"});
}

void SaveImage::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const auto file = SavedFile::parse(params.file);
  if (!file) return context.device.reportError(file.error());  // the folder went away
  const gpu::Texture& texture = *ports.color;
  const Image content = file->content(context.device.download(texture), texture.format());
  const auto path = file->at(context.frame, context.view, context.viewCount);
  if (const Status written = file->write(path, content); !written)
    context.device.reportError(written.error());
  else
    context.written.push_back(path);
}

}  // namespace lucerna::passes

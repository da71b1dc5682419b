// The one door to OpenGL: makes objects, draws, counts. One thread owns it.
//
//   gpu::Rendering draw = device.render({.colors = {{&color, gpu::Load::Clear}}, .depth =
//   {&depth}}); draw.use(*program, state); draw.texture("normal", normal, gpu::kNearest);
//   draw.fullscreen();
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/math/math.hpp"
#include "core/result.hpp"
#include "gpu/buffer.hpp"
#include "gpu/capabilities.hpp"
#include "gpu/program.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/state.hpp"
#include "gpu/texture.hpp"
#include "image/image.hpp"

namespace lucerna::gpu {

// What was asked of the GPU since the last reset. Exact everywhere, unlike times.
struct Counters {
  std::uint64_t draws = 0;  // draw calls, a multi-draw counts each command
  std::uint64_t dispatches = 0;
  std::uint64_t primitives = 0;  // triangles, lines, points sent
  std::uint64_t uploads = 0;     // bytes
  std::uint64_t targetSwitches = 0;
};

// GL objects alive, by kind; and bytes we counted.
struct ObjectCounts {
  int textures = 0, buffers = 0, vertexInputs = 0, programs = 0, framebuffers = 0, samplers = 0,
      queries = 0;
  std::uint64_t textureBytes = 0, bufferBytes = 0;
  bool operator==(const ObjectCounts&) const = default;
};

enum class Load : std::uint8_t { Keep, Clear, Discard };

// Clear and Discard concern the whole attachment, whatever the viewport is.
struct ColorTarget {
  const Texture* texture = nullptr;
  Load load = Load::Keep;
  vec4 clear{0.f};  // unsigned-integer formats: each component is rounded
  int layer = -1;   // -1: the whole texture (all layers of an array)
  int level = 0;
};
struct DepthTarget {
  const Texture* texture = nullptr;
  Load load = Load::Keep;
  float clear = 0.f;  // reversed depth: 0 is far
  std::uint8_t clearStencil = 0;
  int layer = -1;
  int level = 0;
};
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Rect&) const = default;
};
struct Targets {
  std::vector<ColorTarget> colors{};
  DepthTarget depth{};
  Rect viewport{};  // zero width: all of the target. Row 0 is the bottom, as in GL.
};

// Drawing and computing with explicit bindings. Bindings are by the name in the shader, hold until
// the scope ends, also across use(), and may come before it; a name that the program lacks is
// ignored, and a draw with a sampler, image or block that was never bound is a failed CHECK. One
// scope (Rendering or Computing) is open at a time.
class Commands {
 public:
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  // Uniforms of the program may change between draws (Program::set). Draws with an unusable program
  // do nothing.
  void use(const Program& program, const RenderState& state);
  // Integer formats are read with kNearest. An element of a sampler array is "name[2]".
  void texture(std::string_view name, const Texture& texture, const Sampler& sampler);
  void buffer(std::string_view block, const Buffer& buffer);  // uniform or storage block
  // A part of it; offset: a multiple of kBlockAlignment.
  void buffer(std::string_view block, const Buffer& buffer, std::size_t offset, std::size_t bytes);
  void image(std::string_view name, const Texture& texture, int level = 0);  // load and store

 protected:
  explicit Commands(Device& device) : device_(&device) {}
  Commands(Commands&& other) noexcept : device_(std::exchange(other.device_, nullptr)) {}
  ~Commands() = default;
  bool prepare();  // binds what the program reads; false if it is unusable

  Device* device_ = nullptr;  // null: moved from
};

class Rendering : public Commands {
 public:
  Rendering(Rendering&& other) noexcept = default;
  ~Rendering();

  // first, count: of indices if the input is indexed, else of vertices.
  void draw(const VertexInput& input, std::uint32_t first, std::uint32_t count,
            std::uint32_t instances = 1, std::int32_t baseVertex = 0,
            std::uint32_t baseInstance = 0);
  // commands holds IndexedDrawCommand; first and count are of commands; primitives: their triangles
  // in all, for the counters.
  void multiDraw(const VertexInput& input, const Buffer& commands, std::uint32_t first,
                 std::uint32_t count, std::uint64_t primitives);
  void fullscreen();  // one triangle over the viewport; vertex shader gpu/fullscreen.vert
  void setScissor(Rect rect);

 private:
  friend class Device;
  Rendering(Device& device, const Targets& targets);
};

class Computing : public Commands {
 public:
  Computing(Computing&& other) noexcept = default;
  ~Computing();

  void use(const Program& program);
  void dispatch(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);  // in work groups

 private:
  friend class Device;
  explicit Computing(Device& device);
};

class Context;

class Device {
 public:
  // context must stay alive and current. Loads the driver's capabilities, sets reversed depth
  // (glClipControl) and debug output. `sources` (new ones by default) becomes shaderSources(): the
  // shaders of gpu/ are added, and the environment's LUCERNA_SHADERS becomes its root. Errors
  // (ErrorKind::NoGl) say what is missing.
  static Result<std::unique_ptr<Device>> create(Context& context,
                                                std::shared_ptr<ShaderSources> sources = nullptr);
  // Textures, buffers and vertex inputs must be gone by now; programs become unusable.
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const Capabilities& capabilities() const;
  // "vendor | renderer | version", and named driver workarounds in force (docs/dev/drivers.md).
  std::string description() const;

  // remedy: what a user may do where it does not fit (OutOfMemory).
  Texture createTexture(const TextureDesc& desc, std::string label,
                        std::string_view remedy = kRenderSmaller);
  // Level 0 of one layer from pixels that fit the format (U8 for unorm and sRGB, F32/Half for
  // float; integer formats take components of their own width, 32-bit ones as the bits of F32, and
  // Rgb9E5 takes one such channel for texels that are packed already).
  // Image rows are top first, and so is texture row 0: v = 0 is the top, as glTF has it.
  void upload(const Texture& texture, const Image& image, int layer = 0);
  // The same of a part of it, whose first texel is that one.
  void uploadPart(const Texture& texture, const Image& image, int layer, ivec2 first);
  void generateMipmaps(const Texture& texture);
  void clear(const Texture& texture, vec4 value);  // all of level 0; linear, also in sRGB formats
  // The same of a square or so in one layer of an array's level 0.
  void clear(const Texture& texture, vec4 value, int layer, Rect rect);
  // A whole level of one layer. Rows bottom first as GL stores targets unless flip: flip for what
  // was rendered, not for what was uploaded. Depth and packed floats give F32; 32-bit integers
  // their bits in F32 (read them as<std::uint32_t>()). sRGB formats give the stored, encoded bytes.
  Image download(const Texture& texture, int layer = 0, bool flip = true, int level = 0);
  void copy(const Texture& from, const Texture& to);  // level 0, same desc
  // Where the samples of a multisampled target lie in each pixel: (0, 0) is its lower left corner,
  // (1, 1) its upper right one. In the order of texelFetch() of a sampler2DMS.
  std::vector<vec2> samplePositions(const Texture& texture);

  Buffer createBuffer(std::span<const std::byte> data, std::string label);
  Buffer createBuffer(std::size_t bytes, std::string label);
  void update(Buffer& buffer, std::span<const std::byte> data, std::size_t offset = 0);
  // Reuses `buffer` if it is large enough, else makes it anew (with some room to grow): a
  // VertexInput made from it must then be made anew too.
  void write(Buffer& buffer, std::span<const std::byte> data, const std::string& label);
  std::vector<std::byte> download(const Buffer& buffer);
  VertexInput createVertexInput(const VertexInputDesc& desc, std::string label);

  // Compiles, or returns the cached one. A failure is kept for takeErrors() and the program is
  // unusable; asking for it again reports it again.
  ProgramPtr program(const ProgramDesc& desc);
  ShaderSources& shaderSources();
  // Recompiles the programs that read one of these files (as ShaderSources::changedFiles() names
  // them), all or none: if one that worked does not compile any more, all stay as they are, and the
  // error (ErrorKind::Pipeline) says why. Returns how many there were.
  Result<int> reloadShaders(std::span<const std::string> changed);
  // Faults since the last call: of shaders, each with file and line (ErrorKind::Pipeline), and
  // those reported.
  std::vector<Error> takeErrors();
  // Adds one, for whoever finds while drawing that it cannot do its work: with a program that
  // compiled, say, but does not fit.
  void reportError(Error error);

  Rendering render(const Targets& targets);
  Computing compute();
  void barrier();  // storage writes become visible to everything after it

  void pushGroup(std::string_view name);
  void popGroup();
  void finish();  // waits for the GPU

  // GPU time in ms. On software rasterisers timer queries lie: there the timer finishes the pipe at
  // both ends and uses the CPU clock (usesCpuClock()).
  bool timersUseCpuClock() const;
  void beginTimer(std::string_view name);
  void endTimer();
  // Times finished since the last call, in order of beginTimer; waits for them.
  std::vector<std::pair<std::string, double>> takeTimes();

  const Counters& counters() const;
  void resetCounters();
  ObjectCounts objectCounts() const;

  // Debug messages of severity medium or above since the last call; tests demand none.
  std::vector<std::string> takeDebugMessages();

  struct Impl;
  Impl& impl() { return *impl_; }  // for the other files of gpu/

 private:
  Device();
  Result<std::uint32_t> link(Program& program);
  void take(Program& program, std::uint32_t linked);
  std::unique_ptr<Impl> impl_;
};

class DebugGroup {
 public:
  DebugGroup(Device& device, std::string_view name) : device_(device) { device_.pushGroup(name); }
  ~DebugGroup() { device_.popGroup(); }
  DebugGroup(const DebugGroup&) = delete;
  DebugGroup& operator=(const DebugGroup&) = delete;

 private:
  Device& device_;
};

}  // namespace lucerna::gpu

// What the .cpp files of gpu/ share: the state behind Device. Private to this folder.
#pragma once

#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device.hpp"
#include "gpu/gl.hpp"

namespace lucerna::gpu {

std::span<const EmbeddedShader> embeddedShaders_gpu();

struct Uniform {
  GLint location = -1;
  GLenum type = 0;
  GLint count = 1;                      // array elements
  std::array<GLfloat, 4> initial = {};  // of float and vec2 to vec4, one element
};

// What a linked program reads, with the binding points given to it at link time.
struct Program::Reflection {
  struct Slot {
    std::string name;
    GLuint unit = 0;
    GLint bytes = 0;  // of blocks: the least the buffer must hold
    GLenum type = 0;  // of samplers and images
  };
  std::map<std::string, Uniform, std::less<>> uniforms;
  std::vector<Slot> samplers, images, uniformBlocks, storageBlocks;
  std::vector<ProgramInput> inputs;  // all of these
  std::vector<std::string> files;    // all that went in, for reload
  std::optional<Error> fault;        // why it never compiled
};

struct FramebufferKey {
  struct Attachment {
    GLuint texture = 0;
    int layer = -1;
    int level = 0;
    auto operator<=>(const Attachment&) const = default;
  };
  std::vector<Attachment> colors;
  Attachment depth;
  auto operator<=>(const FramebufferKey&) const = default;
};

// The bindings and targets of the open Rendering or Computing.
struct Scope {
  struct BoundTexture {
    std::string name;
    GLuint texture = 0, sampler = 0;
  };
  struct BoundBuffer {
    std::string name;
    GLuint buffer = 0;
    std::size_t offset = 0, bytes = 0;
  };
  struct BoundImage {
    std::string name;
    GLuint texture = 0;
    GLenum format = 0;
    int level = 0;
  };
  bool open = false;
  const Program* program = nullptr;
  Topology topology = Topology::Triangles;
  bool dirty = true;  // bindings or program changed since the last draw
  std::vector<BoundTexture> textures;
  std::vector<BoundBuffer> buffers;
  std::vector<BoundImage> images;
  std::vector<GLuint> colorTargets;  // written whole: sampling them is a bug
  GLuint depthTarget = 0;            // the same, while depth is written
};

struct Timer {
  std::string name;
  GLuint begin = 0, end = 0;                      // queries, where those tell the truth
  std::chrono::steady_clock::time_point start{};  // else the CPU clock
  double milliseconds = 0.0;
};

struct Device::Impl {
  Capabilities capabilities;
  std::string description;
  Counters counters;
  ObjectCounts objects;
  std::shared_ptr<ShaderSources> sources;
  std::map<ProgramDesc, std::shared_ptr<Program>> programs;
  std::vector<Error> errors;
  std::vector<std::string> debugMessages, groups;
  std::vector<Timer> timers;
  std::vector<std::size_t> openTimers;

  Scope scope;
  GLuint emptyInput = 0;  // vertex array without attributes
  RenderState state;      // as the context has it
  GLuint boundProgram = 0, boundFramebuffer = 0;
  std::vector<std::pair<GLuint, GLuint>> units;  // texture and sampler of each texture unit
  std::map<FramebufferKey, GLuint> framebuffers;
  std::vector<std::pair<Sampler, GLuint>> samplers;
  std::vector<std::string> workarounds;
  bool anisotropy = false;

  bool uses(std::string_view workaround) const;
  void apply(const RenderState& wanted);
  GLuint framebuffer(const Targets& targets);
  GLuint sampler(const Sampler& value);
  void forgetTexture(GLuint texture);
  GLuint programId() const { return scope.program->id_; }
  void bindForProgram();
  void openScope();
  void closeScope();
  void setLabel(GLenum kind, GLuint id, std::string_view label) const;
};

}  // namespace lucerna::gpu

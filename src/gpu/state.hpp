// Fixed-function state, stated whole for every draw: nothing is inherited, nothing leaks.
#pragma once

#include <cstdint>

namespace lucerna::gpu {

enum class Compare : std::uint8_t {
  Never,
  Less,
  Equal,
  LessEqual,
  Greater,
  NotEqual,
  GreaterEqual,
  Always
};
enum class Cull : std::uint8_t { None, Back, Front };
enum class Blend : std::uint8_t {
  Off,
  Alpha,          // src * a + dst * (1 - a)
  Premultiplied,  // src + dst * (1 - a)
  Transmit,       // src + dst * src1: coloured transmittance by dual-source blending
  Add,            // src + dst
  Multiply,       // src * dst
  Min,
  Max,
};
enum class StencilOp : std::uint8_t { Keep, Zero, Replace, Increment, Decrement, Invert };
enum class Topology : std::uint8_t { Triangles, TriangleStrip, Lines, LineStrip, Points };

struct Stencil {
  bool test = false;
  Compare compare = Compare::Always;
  std::uint8_t reference = 0, readMask = 0xff, writeMask = 0xff;
  StencilOp fail = StencilOp::Keep, depthFail = StencilOp::Keep, pass = StencilOp::Keep;
  bool operator==(const Stencil&) const = default;
};

// Depth is reversed everywhere: nearer is greater, so the usual test is GreaterEqual or Greater.
struct RenderState {
  bool depthTest = false;
  bool depthWrite = false;
  Compare depthCompare = Compare::GreaterEqual;
  Blend blend = Blend::Off;  // of all colour targets
  Cull cull = Cull::Back;
  bool frontIsClockwise = false;  // mirrored objects and mirrors
  bool wireframe = false;
  std::uint8_t colorMask = 0xf;    // bits r g b a
  std::uint8_t clipDistances = 0;  // gl_ClipDistance[0..n)
  float depthBias = 0.f, depthSlopeBias = 0.f;
  Stencil stencil{};
  Topology topology = Topology::Triangles;
  bool operator==(const RenderState&) const = default;
};

}  // namespace lucerna::gpu

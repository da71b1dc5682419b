// A scene on which pipelines are measured: opened once, drawn by each of them in turn.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/bench/cameras.hpp"
#include "app/session.hpp"

namespace lucerna::app::bench {

// A row of a pipeline, named after its pass.
struct Length {
  std::string param;
  float share;  // of how far away things are that are seen
  bool operator==(const Length&) const = default;
};
struct Row {
  std::string pass;
  std::vector<std::string> settings = {};  // "samples=8"
  std::vector<Length> lengths = {};        // set anew at each place
  bool operator==(const Row&) const = default;
};
struct Chain {
  std::vector<Row> rows;
  std::string output = {};  // "Row.port"; "": the last row's color
  bool operator==(const Chain&) const = default;
};

// A parameter that leaves the ports as they are.
struct Setting {
  std::string pass, param;
  graph::Value value;
};

// Variants of the same chain and size share passes and textures, and what passes keep from frame to
// frame.
struct Variant {
  Chain chain;
  uvec2 size{0};                       // px
  bool profiled = false;               // time of every pass, drawn one after the other
  std::vector<Setting> settings = {};  // before each of its frames
};

// What one frame took.
struct Sample {
  double realMs = 0, cpuMs = 0;  // of all of it: until the GPU has finished, until all was told it
  gpu::Counters counters;
  std::uint64_t textureBytes = 0;  // that the chain's passes hold, shadow maps included
  graph::FrameProfile profile;     // of profiled variants
  // Of chains with the rows ShadowMaps and ShadowLayers: texels of all maps in use, drawn in this
  // frame or kept; layers in use; lights that throw shadows and have no layer.
  std::uint64_t shadowTexels = 0;
  int shadowLayers = 0, lightsBeyond = 0;
};

enum class Lighting {
  Sun,  // one sun and some ambient light instead of the scene's own: alike everywhere
  Own,
};
enum class Surfaces {
  Own,
  // Grey and matt, what is neither opaque nor alpha-tested left out: pictures then differ from the
  // reference in what is measured and in nothing else.
  Plain,
  PlainAndTranslucent,  // the same, but translucent surfaces stay as they are
};

// How a scene is made ready.
struct StageSettings {
  RenderSettings render;  // scene, seed, threads, plugins, shaders
  Lighting lighting = Lighting::Sun;
  float elevationDegrees = 40, azimuthDegrees = 30;  // of the sun: 0 is -z, 90 is +x
  Surfaces surfaces = Surfaces::Own;
  bool moving = false;  // its animations play: see Stage::at(); else every frame shows their start
};

class Stage {
 public:
  // Errors: of loading, or no usable GL.
  static Result<std::unique_ptr<Stage>> open(const StageSettings& settings);

  // Makes it ready to be drawn; returns its number. Errors (ErrorKind::Pipeline) are all faults.
  Result<std::size_t> add(const Variant& variant);
  const Variant& variant(std::size_t number) const { return lanes_[number].variant; }
  // Frees all variants; numbers begin anew.
  void clear() { lanes_.clear(); }

  // Changes lights or ambient light of the scene, and nothing else.
  void relight(const std::function<void(scene::Scene& scene)>& change);

  // The moment that the next frames show, s. A variant's maps follow what moves from one of its
  // frames to its next only if no other variant is drawn between them.
  void at(double seconds) { session_->settings.time = seconds; }

  // From where the next frames are seen. sight: m, see SeededCamera; rows' lengths follow from it.
  Status look(const CameraPose& pose, float sight = 1.f);
  // m: of a pass of that type, as far as its parameter's range allows.
  double length(const std::string& pass, const Length& length) const;

  // One frame. picture: its output, if it is wanted (its download is not timed); else null.
  Result<Sample> draw(std::size_t number, Image* picture = nullptr);

  const scene::Scene& scene() const { return session_->scene; }
  const gpu::Device& device() const { return *session_->device; }
  // What a picture of that size shows.
  scene::View view(uvec2 size) const;

 private:
  explicit Stage(std::unique_ptr<Session> session) : session_(std::move(session)) {}

  struct Renderer {
    std::unique_ptr<graph::Executor> executor;
    std::uint64_t textureBytes = 0;
  };
  struct Lane {
    Variant variant;
    std::shared_ptr<Renderer> renderer;
  };
  std::shared_ptr<Renderer> rendererOf(const Variant& variant) const;  // null: none yet
  std::unique_ptr<Session> session_;
  float sight_ = 1.f;        // m
  std::vector<Lane> lanes_;  // freed before the session's device
};

}  // namespace lucerna::app::bench

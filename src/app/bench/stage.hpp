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
};
struct Row {
  std::string pass;
  std::vector<std::string> settings = {};  // "samples=8"
  std::vector<Length> lengths = {};        // set anew at each place
};
struct Chain {
  std::vector<Row> rows;
  std::string output = {};  // "Row.port"; "": the last row's color
};

struct Variant {
  Chain chain;
  uvec2 size{0};          // px
  bool profiled = false;  // time of every pass, which are then drawn one after the other
};

// What one frame took.
struct Sample {
  double realMs = 0, cpuMs = 0;  // of all of it: until the GPU has finished, until all was told it
  gpu::Counters counters;
  graph::FrameProfile profile;  // of profiled variants
};

// How a scene is made ready. Every scene is lit by one sun and some ambient light in place of its
// own lights, so that what is measured is alike everywhere.
struct StageSettings {
  RenderSettings render;                             // scene, seed, threads, plugins, shaders
  float elevationDegrees = 40, azimuthDegrees = 30;  // of the sun: 0 is -z, 90 is +x
  // All surfaces grey and matt, what is neither opaque nor alpha-tested left out: pictures then
  // differ from the reference in what is measured and in nothing else.
  bool plain = false;
};

class Stage {
 public:
  // Errors: of loading, or no usable GL.
  static Result<std::unique_ptr<Stage>> open(const StageSettings& settings);

  // Makes it ready to be drawn; returns its number. Errors (ErrorKind::Pipeline) are all faults.
  Result<std::size_t> add(const Variant& variant);
  const Variant& variant(std::size_t number) const { return lanes_[number].variant; }

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

  struct Lane {
    Variant variant;
    std::unique_ptr<graph::Executor> executor;
  };
  std::unique_ptr<Session> session_;
  float sight_ = 1.f;        // m
  std::vector<Lane> lanes_;  // freed before the session's device
};

}  // namespace lucerna::app::bench

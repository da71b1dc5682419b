// For tests: pass types made from a description alone, and pipelines written in a line.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "graph/registry.hpp"
#include "graph/schedule.hpp"

namespace lucerna::graph {

class FakeInstance final : public PassInstance {
 public:
  void setParams(const ParamValues&) override {}
  void execute(PassContext&, std::span<const BoundPort>) override {}
};

// FakePass("Blur").in("color", Rgba16Float).out("color", Rgba16Float).repeats("color")
class FakePass final : public PassType {
 public:
  explicit FakePass(std::string type) { d_.type = std::move(type); }

  template <typename... Formats>
  FakePass& in(std::string name, Formats... formats) {
    return port(std::move(name), Direction::In, {formats...});
  }
  FakePass& out(std::string name, gpu::Format format) {
    return port(std::move(name), Direction::Out, {format});
  }
  template <typename... Formats>
  FakePass& inout(std::string name, Formats... formats) {
    return port(std::move(name), Direction::InOut, {formats...});
  }
  template <PortData T>
  FakePass& data(std::string name, Direction direction) {
    d_.ports.push_back(
        {.name = std::move(name), .direction = direction, .type = dataPortType<T>()});
    return *this;
  }
  FakePass& param(ParamDescription param) {
    d_.params.push_back(std::move(param));
    return *this;
  }
  FakePass& runs(Frequency frequency) {
    d_.frequency = frequency;
    return *this;
  }
  FakePass& needs(std::string feature) {
    d_.features.push_back(std::move(feature));
    return *this;
  }
  // Of the port added last.
  FakePass& optional() {
    return last([](auto& p) { p.optional = true; });
  }
  FakePass& history() {
    return last([](auto& p) { p.history = true; });
  }
  FakePass& halo(int pixels) {
    return last([&](auto& p) { p.halo = pixels; });
  }
  FakePass& persistent() {
    return last([](auto& p) { p.persistent = true; });
  }
  FakePass& fill(float value) {
    return last([&](auto& p) { p.standIn = {.kind = StandIn::Kind::Fill, .fill = vec4(value)}; });
  }
  FakePass& repeats(std::string input) {
    return last([&](auto& p) { p.standIn = {StandIn::Kind::PassThrough, vec4(0), input}; });
  }
  FakePass& sizeOf(std::string input, float scale = 1) {
    return last([&](auto& p) { p.size = {SizeRule::Kind::Port, input, scale}; });
  }
  FakePass& scaled(float scale) {
    return last([&](auto& p) { p.size = {SizeRule::Kind::Output, "", scale}; });
  }
  FakePass& sameSizeAs(std::string input) {
    return last([&](auto& p) { p.sameSizeAs = input; });
  }
  FakePass& size(int width, int height) {
    return last([&](auto& p) { p.size = {SizeRule::Kind::Absolute, "", 1, width, height}; });
  }
  FakePass& spec(TextureSpec spec) {
    return last([&](auto& p) { p.type.texture = spec; });
  }

  PassDescription describe(const ParamValues&) const override { return d_; }
  std::unique_ptr<PassInstance> create(gpu::Device&) const override {
    return std::make_unique<FakeInstance>();
  }

 private:
  FakePass& port(std::string name, Direction direction, std::vector<gpu::Format> formats) {
    PortType type;
    type.texture = TextureSpec{.formats = std::move(formats)};
    d_.ports.push_back({.name = std::move(name), .direction = direction, .type = std::move(type)});
    return *this;
  }
  template <typename Change>
  FakePass& last(Change change) {
    change(d_.ports.back());
    return *this;
  }
  PassDescription d_;
};

inline void add(Registry& registry, const FakePass& pass) {
  registry.add(std::make_unique<FakePass>(pass));
}

// A row named after its type.
struct FakeRow {
  PassRow row;
  FakeRow(std::string type) { row.name = row.type = std::move(type); }  // NOLINT: implicit
  FakeRow(const char* type) : FakeRow(std::string(type)) {}             // NOLINT: implicit
  FakeRow named(std::string name) && {
    row.name = std::move(name);
    return std::move(*this);
  }
  FakeRow reads(std::string port, std::string from) && {
    row.reads[std::move(port)] = std::move(from);
    return std::move(*this);
  }
  FakeRow with(std::string param, Value value) && {
    row.params[std::move(param)] = std::move(value);
    return std::move(*this);
  }
  FakeRow off() && {
    row.enabled = false;
    return std::move(*this);
  }
};

inline Pipeline pipelineOf(std::vector<FakeRow> rows, std::string output = "") {
  Pipeline pipeline{.name = "test", .output = std::move(output), .source = "test.json"};
  for (FakeRow& row : rows) pipeline.passes.push_back(std::move(row.row));
  return pipeline;
}

}  // namespace lucerna::graph

#include "graph/pass_info.hpp"

namespace lucerna::graph {

ParamBuilder& ParamBuilder::choices(std::vector<std::string> names) {
  d_->type = ParamType::Choice;
  d_->choices = std::move(names);
  if (const auto* index = std::get_if<std::int64_t>(&d_->defaultValue)) {
    CHECK(*index >= 0 && *index < std::ssize(d_->choices), "{}: no choice is named {}", d_->name,
          *index);
    d_->defaultValue = d_->choices[static_cast<std::size_t>(*index)];
  }
  return *this;
}

PortBuilder& PortBuilder::spec(gpu::TextureKind kind, std::vector<gpu::Format> formats) {
  CHECK(d_->type.texture.has_value(), "port '{}' carries {}, not a texture", d_->name,
        d_->type.dataName);
  d_->type.texture->kind = kind;
  d_->type.texture->formats = std::move(formats);
  if (kind == gpu::TextureKind::Cube || kind == gpu::TextureKind::CubeArray)
    d_->type.texture->layers = 6;
  return *this;
}

PortBuilder& PortBuilder::sizeOf(std::string input, float scale) {
  d_->size = {.kind = SizeRule::Kind::Port, .port = std::move(input), .scale = scale};
  return *this;
}

PortBuilder& PortBuilder::sizeOfOutput(float scale) {
  d_->size = {.kind = SizeRule::Kind::Output, .scale = scale};
  return *this;
}

PortBuilder& PortBuilder::size(int width, int height) {
  d_->size = {.kind = SizeRule::Kind::Absolute, .width = width, .height = height};
  return *this;
}

PortBuilder& PortBuilder::sameSizeAs(std::string input) {
  d_->sameSizeAs = std::move(input);
  return *this;
}

PortBuilder& PortBuilder::whenDisabled(vec4 fill) {
  d_->standIn = {.kind = StandIn::Kind::Fill, .fill = fill};
  return *this;
}

PortBuilder& PortBuilder::passesThrough(std::string input) {
  d_->standIn = {.kind = StandIn::Kind::PassThrough, .input = std::move(input)};
  return *this;
}

std::optional<std::int64_t> choiceIndex(const ParamDescription& d, const Value& value) {
  const auto* name = std::get_if<std::string>(&value);
  if (d.type != ParamType::Choice || !name) return std::nullopt;
  for (std::size_t i = 0; i < d.choices.size(); ++i)
    if (d.choices[i] == *name) return static_cast<std::int64_t>(i);
  return std::nullopt;
}

}  // namespace lucerna::graph

#include "graph/size_relation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lucerna::graph {
namespace {

SizeRelation scaled(SizeRelation size, float scale) {
  if (scale != 1.f) size.scales.push_back(scale);
  return size;
}

SizeRelation ofRule(const SizeRule& rule) {
  if (rule.kind == SizeRule::Kind::Absolute) return {.absolute = uvec2(rule.width, rule.height)};
  return scaled({}, rule.scale);
}

// Rounded up, so that no pixel is lost; a hair less first, as 0.1f * 10 is more than 1.
unsigned scaledSide(unsigned pixels, float scale) {
  const double exact = static_cast<double>(pixels) * scale;
  return std::max(1u, static_cast<unsigned>(std::ceil(exact * (1 - 1e-7) - 1e-9)));
}

}  // namespace

uvec2 SizeRelation::inPixels(uvec2 outputSize) const {
  uvec2 size = absolute == uvec2(0) ? outputSize : absolute;
  for (const float scale : scales) size = {scaledSide(size.x, scale), scaledSide(size.y, scale)};
  return size;
}

std::string SizeRelation::text() const {
  std::string text;
  for (const float scale : scales) text += fmt::format("{:g} x ", scale);
  return text + (absolute == uvec2(0) ? "the output's size"
                                      : fmt::format("{} x {} px", absolute.x, absolute.y));
}

SizeRelation SizeRelations::of(const Source& source) {
  if (source.kind == Source::Kind::Output) return ofOutput(source.row, source.port);
  if (source.kind != Source::Kind::Fill) return {};
  if (source.size.kind == SizeRule::Kind::Port)
    return scaled(ofOutput(source.sizeRow, source.size.port), source.size.scale);
  return ofRule(source.size);
}

SizeRelation SizeRelations::ofOutput(std::size_t row, const std::string& port) {
  // The first entry ends circles, which only history inputs can close: they get the output's size.
  const auto [known, isNew] = known_.emplace(std::pair(row, port), SizeRelation{});
  if (!isNew) return known->second;
  const auto found = std::find_if(plan_.rows.begin(), plan_.rows.end(),
                                  [&](const ResolvedRow& r) { return r.row == row; });
  CHECK(found != plan_.rows.end(), "the size of row {} is asked for, which does not run", row);
  const PortDescription* out = found->description.output(port);
  const bool isUpdate = found->updates(*out);
  SizeRelation size = ofRule(out->size);
  if (isUpdate || out->size.kind == SizeRule::Kind::Port) {
    const std::string& like = isUpdate ? out->name : out->size.port;
    const ResolvedInput* input = found->input(like);
    CHECK(input, "{}: the size of '{}' follows an input '{}' that the pass does not have",
          found->description.type, port, like);
    size = scaled(of(input->source), isUpdate ? 1.f : out->size.scale);
  }
  return known_[{row, port}] = size;
}

}  // namespace lucerna::graph

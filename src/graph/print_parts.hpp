// Internal to graph/: what the text, DOT and SVG forms of a schedule share.
#pragma once

#include <string>
#include <vector>

#include "graph/schedule.hpp"

namespace lucerna::graph {

// A value on its way from the step that wrote it to a reader.
struct Wire {
  std::size_t from = kNoVersion;  // step; kNoVersion: a resource
  std::size_t to = 0;             // step; the number of steps: the pipeline's output
  std::size_t version = kNoVersion;
  std::string label{};  // the reader's port
  std::string resource{};
  bool history = false;
};
std::vector<Wire> wiresOf(const Plan& plan, const Schedule& schedule);

std::size_t versionOf(const Plan& plan, const Schedule& schedule, const Source& source);
std::size_t writerOf(const Plan& plan, const Schedule& schedule, std::size_t version);  // a step

std::string sourceText(const Plan& plan, const Source& source);
std::string holderText(const Schedule& schedule, const Version& version);
std::string textureText(const PhysicalTexture& texture);
double mebibytes(std::uint64_t bytes);

}  // namespace lucerna::graph

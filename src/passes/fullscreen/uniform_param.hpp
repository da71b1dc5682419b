// A uniform as a parameter: type, default, range and help come from its declaration,
//
//   uniform float threshold = 0.1;             // 0 to 10 m: the step in depth that makes an edge.
//   uniform vec3 ink = vec3(0.05, 0.05, 0.1);  // color: of the lines.
#pragma once

#include <optional>

#include "graph/description.hpp"
#include "graph/value_check.hpp"
#include "passes/fullscreen/shader_interface.hpp"

namespace lucerna::passes {

// Whether the type is one that a parameter can have.
bool isParamType(std::string_view glslType);

// None if its value is no literal or not in its range: `fault` then says so.
std::optional<graph::ParamDescription> paramOf(const ShaderInterface::Uniform& uniform,
                                               graph::ValueFault& fault);

}  // namespace lucerna::passes

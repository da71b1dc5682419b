// What a shader asks its program for, read from its text: no GL, so that a pipeline is checked
// without a driver. The preprocessor is not run: declarations in every branch of an #if count,
// those that a macro makes are not seen.
#pragma once

#include <string>
#include <vector>

#include "gpu/shader_source.hpp"

namespace lucerna::passes {

struct ShaderInterface {
  struct Uniform {
    std::string type, name;  // as written: "vec3", "ink"
    std::string initial{};   // without blanks: "vec3(0.1,0.1,0.2)"; "" if there is none
    std::string comment{};   // the // comment behind it
    std::string place{};     // "edges.frag:12"
    bool isArray = false;
  };
  struct Block {
    std::string name, place;
  };
  std::vector<Uniform> uniforms{};  // samplers too
  std::vector<Block> blocks{};      // uniform and storage blocks
};

ShaderInterface readInterface(const gpu::ExpandedShader& shader);

}  // namespace lucerna::passes

// Passes from a shared library of somebody else's: `lucerna render --plugin vignette.so`.
//
// A plugin defines its entry point once, in one of its files:
//
//   LUCERNA_PLUGIN(plugin) {
//     plugin.addShaders(kShaders);
//     plugin.add<Vignette>();
//   }
//
// Plugin and program share C++ classes, so both must be compiled with the same headers: kInterface
// (core/version.hpp) tells. A plugin is code that the user chose: it has all rights of the process,
// and stays loaded until that ends.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/version.hpp"
#include "graph/registry.hpp"

namespace lucerna::graph {

// What a plugin brings; its entry point fills this.
struct Plugin {
  std::vector<std::unique_ptr<PassType>> types;
  std::vector<gpu::EmbeddedShader> shaders;

  template <typename Pass>
  void add() {
    types.push_back(makePassType<Pass>());
  }
  // Texts that the plugin keeps. Their paths begin with the plugin's name:
  // "vignette/vignette.frag".
  void addShaders(std::span<const gpu::EmbeddedShader> added) {
    shaders.insert(shaders.end(), added.begin(), added.end());
  }
};

// Loads the library and adds what it brings. Errors: ErrorKind::Input (no such file),
// ErrorKind::Pipeline (no plugin, built with other headers, a name that is taken); the registry is
// then as it was.
Status loadPlugin(const std::string& path, Registry& registry);

}  // namespace lucerna::graph

#define LUCERNA_PLUGIN(plugin)                                                 \
  extern "C" [[gnu::visibility("default")]] const char* lucernaPluginBuilt() { \
    return ::lucerna::kInterface;                                              \
  }                                                                            \
  extern "C" [[gnu::visibility("default")]] void lucernaPlugin(::lucerna::graph::Plugin& plugin)

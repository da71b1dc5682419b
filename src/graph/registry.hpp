// The pass types that pipelines may name, their shaders, and the resources that the application
// gives to all passes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gpu/shader_source.hpp"
#include "graph/pass_info.hpp"

namespace lucerna::graph {

// Something the application provides each frame under a port name: "scene", "view", "lights".
struct ResourceDescription {
  std::string name;
  PortType type;
  std::string help;
  bool perView = false;
};

class Registry {
 public:
  template <typename Pass>
  void add() {
    add(makePassType<Pass>());
  }
  void add(std::unique_ptr<PassType> type);
  void addResource(ResourceDescription resource);
  template <PortData T>
  void addResource(const std::string& name, const std::string& help, bool perView = false);

  const PassType* find(std::string_view type) const;
  std::vector<std::string> typeNames() const;  // in the order of registration
  const ResourceDescription* resource(std::string_view name) const;
  const std::vector<ResourceDescription>& resources() const { return resources_; }
  // The shaders of the passes; the Device that draws them shares these (Device::create).
  const std::shared_ptr<gpu::ShaderSources>& shaders() const { return shaders_; }

 private:
  std::vector<std::pair<std::string, std::unique_ptr<PassType>>> types_;
  std::vector<ResourceDescription> resources_;
  std::shared_ptr<gpu::ShaderSources> shaders_ = std::make_shared<gpu::ShaderSources>();
};

template <PortData T>
void Registry::addResource(const std::string& name, const std::string& help, bool perView) {
  addResource({.name = name, .type = dataPortType<T>(), .help = help, .perView = perView});
}

}  // namespace lucerna::graph

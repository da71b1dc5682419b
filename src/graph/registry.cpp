#include "graph/registry.hpp"

#include <algorithm>

namespace lucerna::graph {

void Registry::add(std::unique_ptr<PassType> type) {
  std::string name = type->describe({}).type;
  CHECK(!name.empty(), "a pass type has no name: its describe() must call pass()");
  CHECK(find(name) == nullptr, "pass type '{}' is registered twice", name);
  types_.emplace_back(std::move(name), std::move(type));
}

void Registry::addResource(ResourceDescription resource) {
  CHECK(this->resource(resource.name) == nullptr, "resource '{}' is registered twice",
        resource.name);
  CHECK(!resource.type.texture, "resource '{}' is a texture: give it as typed data", resource.name);
  resources_.push_back(std::move(resource));
}

const PassType* Registry::find(std::string_view type) const {
  const auto found =
      std::find_if(types_.begin(), types_.end(), [&](const auto& t) { return t.first == type; });
  return found == types_.end() ? nullptr : found->second.get();
}

std::vector<std::string> Registry::typeNames() const {
  std::vector<std::string> names;
  for (const auto& [name, type] : types_) names.push_back(name);
  return names;
}

const ResourceDescription* Registry::resource(std::string_view name) const {
  const auto found = std::find_if(resources_.begin(), resources_.end(),
                                  [&](const ResourceDescription& r) { return r.name == name; });
  return found == resources_.end() ? nullptr : &*found;
}

}  // namespace lucerna::graph

#include "graph/plugin.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>

namespace lucerna::graph {
namespace {

constexpr const char* kNextStep = "docs/dev/adding_a_pass.md shows how a plugin is built";

// What the loader has to say, without the path that it begins with.
std::string loaderFault(const std::filesystem::path& file) {
  const char* fault = dlerror();
  std::string text = fault ? fault : "no reason was given";
  const std::string prefix = file.string() + ": ";
  return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

// Never unloaded: pass types, their names and shaders are the library's.
Result<void*> openLibrary(const std::string& path) {
  std::error_code code;
  // With its folder, or the loader would look for it among the system's libraries.
  const std::filesystem::path file = std::filesystem::absolute(path, code);
  if (!std::filesystem::is_regular_file(file, code))
    return error(ErrorKind::Input, "{}: {}; wanted a plugin, a shared library (.so)", path,
                 code ? code.message() : "no file");
  if (void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
  return error(
      ErrorKind::Pipeline,
      "{}: cannot be loaded ({}); wanted a shared library that was built with Lucerna {}; {}", path,
      loaderFault(file), kInterface, kNextStep);
}

template <typename Function>
Function* symbol(void* library, const char* name) {
  return reinterpret_cast<Function*>(dlsym(library, name));
}

// Runs the entry point.
Result<Plugin> readPlugin(const std::string& path) {
  LUCERNA_TRY(library, openLibrary(path));
  const auto built = symbol<const char*()>(library, "lucernaPluginBuilt");
  const auto enter = symbol<void(Plugin&)>(library, "lucernaPlugin");
  if (!built || !enter)
    return error(ErrorKind::Pipeline,
                 "{}: is no plugin: it has no '{}'; wanted a library one of whose files says "
                 "LUCERNA_PLUGIN; {}",
                 path, built ? "lucernaPlugin" : "lucernaPluginBuilt", kNextStep);
  const std::string with = built();
  if (with != kInterface)
    return error(ErrorKind::Pipeline,
                 "{}: was built with the headers of Lucerna {}; wanted those of {}, which is "
                 "running; build the plugin again with these",
                 path, with, kInterface);
  Plugin plugin;
  enter(plugin);
  return plugin;
}

Status checkNames(const std::string& path, const Plugin& plugin, const Registry& registry) {
  std::vector<std::string> names = registry.typeNames();
  for (const auto& type : plugin.types) {
    const std::string name = type->describe({}).type;
    if (name.empty())
      return error(ErrorKind::Pipeline,
                   "{}: has a pass without a name; wanted d.pass(\"Name\", ...) in its describe()",
                   path);
    if (std::ranges::find(names, name) != names.end())
      return error(
          ErrorKind::Pipeline,
          "{}: brings a pass '{}', but there is one of that name already; rename it in its "
          "describe(), or leave out the --plugin that brought the other",
          path, name);
    names.push_back(name);
  }
  for (const gpu::EmbeddedShader& shader : plugin.shaders)
    if (registry.shaders()->contains(shader.path))
      return error(
          ErrorKind::Pipeline,
          "{}: brings a shader '{}', but there is one of that path already; begin its path "
          "with the plugin's own name",
          path, shader.path);
  return {};
}

}  // namespace

Status loadPlugin(const std::string& path, Registry& registry) {
  LUCERNA_TRY(plugin, readPlugin(path));
  LUCERNA_TRY_VOID(checkNames(path, plugin, registry));
  registry.shaders()->add(plugin.shaders);
  for (auto& type : plugin.types) registry.add(std::move(type));
  return {};
}

}  // namespace lucerna::graph

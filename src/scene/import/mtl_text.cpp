#include "scene/import/mtl_text.hpp"

#include <algorithm>

namespace lucerna::scene {

std::set<std::string> materialsWithDiffuse(std::string_view library) {
  constexpr std::string_view kBlank = " \t\r";
  std::set<std::string> names;
  std::string name;
  while (!library.empty()) {
    const std::size_t end = std::min(library.find('\n'), library.size());
    std::string_view line = library.substr(0, end);
    library.remove_prefix(std::min(end + 1, library.size()));
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    line = line.substr(0, line.find_last_not_of(kBlank) + 1);
    if (line.starts_with("Kd ") || line.starts_with("Kd\t")) names.insert(name);
    if (!line.starts_with("newmtl")) continue;
    line.remove_prefix(6);
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    name = line;
  }
  return names;
}

}  // namespace lucerna::scene

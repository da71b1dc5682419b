#include "gpu/workarounds.hpp"

#include <algorithm>

#include "core/text.hpp"

namespace lucerna::gpu {

std::vector<std::string> workaroundsFor(const Capabilities& capabilities,
                                        std::string_view disabled) {
  std::vector<std::string> names = {std::string(kKeepDiscardedLayers)};
  if (capabilities.softwareRasterizer)
    names.insert(names.end(), {std::string(kNoAnisotropy), std::string(kTimersOnCpuClock)});
  const std::vector<std::string> off = split(disabled, ',');
  std::erase_if(names, [&](const std::string& name) { return std::ranges::count(off, name) > 0; });
  return names;
}

}  // namespace lucerna::gpu

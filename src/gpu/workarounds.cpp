#include "gpu/workarounds.hpp"

#include <algorithm>

#include "core/log.hpp"
#include "core/text.hpp"

namespace lucerna::gpu {

std::vector<std::string> workaroundsFor(const Capabilities& capabilities,
                                        std::string_view disabled) {
  std::vector<std::string> names = {std::string(kKeepDiscardedLayers)};
  if (capabilities.softwareRasterizer)
    names.insert(names.end(), {std::string(kNoAnisotropy), std::string(kTimersOnCpuClock)});
  if (capabilities.name.starts_with("NVIDIA")) names.emplace_back(kNoPerformanceMessages);
  std::ranges::sort(names);
  const std::vector<std::string> off = split(disabled, ',');
  constexpr std::string_view kAll[] = {kKeepDiscardedLayers, kNoAnisotropy, kNoPerformanceMessages,
                                       kTimersOnCpuClock};
  for (const std::string& name : off)
    if (!name.empty() && std::ranges::count(kAll, name) == 0)
      log::warning("LUCERNA_NO_WORKAROUNDS: found '{}', wanted some of {}", name,
                   fmt::join(kAll, ", "));
  std::erase_if(names, [&](const std::string& name) { return std::ranges::count(off, name) > 0; });
  return names;
}

}  // namespace lucerna::gpu

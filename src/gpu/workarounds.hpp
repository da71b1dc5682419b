// Driver faults that we step around, by name. Which are in force stands in Device::description();
// LUCERNA_NO_WORKAROUNDS=name,name switches them off, for seeing the fault. Their stories are in
// docs/dev/drivers.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gpu/capabilities.hpp"

namespace lucerna::gpu {

// Timer queries of software rasterisers measure the recording: finish and use the CPU clock.
inline constexpr std::string_view kTimersOnCpuClock = "timers-on-cpu-clock";
// Four anisotropic taps in software cost several times a trilinear one.
inline constexpr std::string_view kNoAnisotropy = "no-anisotropy";
// Mesa 22.3 loses the other layers when one layer of an array is invalidated.
inline constexpr std::string_view kKeepDiscardedLayers = "keep-discarded-layers";
// NVIDIA's driver says with medium severity when it compiles a shader again for other state, or
// moves a buffer: its own affairs, of which no program can free it.
inline constexpr std::string_view kNoPerformanceMessages = "no-performance-messages";

// Those that the driver needs, less the comma-separated ones in `disabled`, in alphabetical order.
// Warns of names there that no workaround has.
std::vector<std::string> workaroundsFor(const Capabilities& capabilities,
                                        std::string_view disabled);

}  // namespace lucerna::gpu

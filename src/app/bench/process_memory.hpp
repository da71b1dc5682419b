// How much memory this process holds.
#pragma once

#include <cstdint>

namespace lucerna::app::bench {

// Bytes in memory now, and the most since the last forgetPeak(). 0 where the system does not say.
std::uint64_t residentBytes();
std::uint64_t peakResidentBytes();
// Gives back what the heap keeps in reserve, and lets the peak begin anew. False if the system
// cannot do that: the peak is then that of the whole run.
bool forgetPeak();

}  // namespace lucerna::app::bench

// libFuzzer's way in. LUCERNA_FUZZ_TARGET is the function of fuzz.hpp that this program runs.
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerInitialize(int*, char***);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  lucerna::log::setLevel(lucerna::log::Level::Off);  // decoders warn
  lucerna::setThreadCount(1);                        // so that a run repeats itself
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lucerna::fuzz::LUCERNA_FUZZ_TARGET(std::as_bytes(std::span(data, size)));
  return 0;
}

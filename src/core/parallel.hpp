// Parallel loops on a small pool of our own (the packaged TBB is opaque to the thread sanitizer).
#pragma once

#include <cstddef>
#include <functional>

namespace lucerna {

// Threads that parallelFor uses, the caller's included. 0 asks for the machine's cores.
void setThreadCount(int count);
int threadCount();

// Calls body(begin, end) over [0, count) in blocks of `grain`. Blocks run in any order on any
// thread; results must not depend on that. A loop inside a loop runs serially. Of what bodies
// throw (out of memory) one exception reaches the caller, and blocks not yet begun are left out.
void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace lucerna

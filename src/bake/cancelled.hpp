// Ctrl-C, for stages that return a Status. Loops ask Progress::cancelled() and end early; whoever
// called them asks here before what they made is used.
#pragma once

#include "core/progress.hpp"
#include "core/result.hpp"

namespace lucerna::bake {

// ErrorKind::Cancelled once the user pressed Ctrl-C. What is kept and how to go on is said by who
// was asked to bake or to merge.
inline Status checkGoesOn() {
  if (!Progress::cancelled()) return {};
  return error(ErrorKind::Cancelled, "cancelled");
}

}  // namespace lucerna::bake

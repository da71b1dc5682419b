// Ctrl-C, for stages that return a Status. Loops ask Progress::cancelled() and end early; whoever
// called them asks here before what they made is used.
#pragma once

#include "core/progress.hpp"
#include "core/result.hpp"

namespace lucerna::bake {

// ErrorKind::Cancelled once the user pressed Ctrl-C.
inline Status checkGoesOn() {
  if (!Progress::cancelled()) return {};
  return error(ErrorKind::Cancelled,
               "cancelled; what is finished is kept, go on with --resume, or merge again");
}

}  // namespace lucerna::bake

// Where a frame happens.
#pragma once

#include <functional>

#include "app/session.hpp"

namespace lucerna::app {

// Gets the view's output while the textures of its frame are alive.
using FrameSink = std::function<Status(Session& session, const gpu::Texture& output)>;

// One frame, from what changed to the picture handed to `sink`. On an error nothing was handed
// over.
Status runFrame(Session& session, ProfileLog* profile, const FrameSink& sink);

}  // namespace lucerna::app

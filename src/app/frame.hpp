// Where a frame happens.
#pragma once

#include <functional>

#include "app/session.hpp"

namespace lucerna::app {

// Gets each view's output while its textures are alive: one a frame, or those of session.plan.
using FrameSink = std::function<Status(Session& session, int view, const gpu::Texture& output)>;

// One frame, from what changed to the pictures handed to `sink`, whose error ends it.
Status runFrame(Session& session, ProfileLog* profile, const FrameSink& sink);

}  // namespace lucerna::app

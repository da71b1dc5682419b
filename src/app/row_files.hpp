// The files that rows of a pipeline write beside the picture (SaveImage), before they are written.
#pragma once

#include "app/frame_name.hpp"
#include "app/settings.hpp"
#include "graph/pipeline.hpp"
#include "graph/registry.hpp"

namespace lucerna::app {

// No two enabled rows may write the same file, nor a row that of -o. Errors: ErrorKind::Usage.
// What is wrong with the pipeline otherwise is no fault here.
Status checkRowFiles(const graph::Pipeline& pipeline, const graph::Registry& registry,
                     const FrameName& output, const RenderSettings& settings);

}  // namespace lucerna::app

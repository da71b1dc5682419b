// Whether a reader follows the names of other files in a file: buffers, pictures, included scenes.
#pragma once

namespace lucerna::scene {

enum class OutsideFiles { Read, Refuse };

}  // namespace lucerna::scene

// Whether a reader follows the names of other files in a file: buffers, pictures, included scenes;
// and has data unpacked that only a process of its own may unpack.
#pragma once

namespace lucerna::scene {

enum class OutsideFiles { Read, Refuse };

}  // namespace lucerna::scene

// The headers of an OpenEXR file, read with bounds checked, before OpenEXR allocates anything
// for it. After "OpenEXR File Layout" (Academy Software Foundation).
#pragma once

#include "image/codec.hpp"

namespace lucerna::codec {

struct ExrChannel {
  std::string name;
  std::uint32_t bytes = 0;  // of one value
};

struct ExrHeader {                     // of the first part
  std::int64_t width = 0, height = 0;  // of the data window
  std::uint32_t compression = 0;
  bool tiled = false;
  std::vector<ExrChannel> channels;
};

// The sizes of all attributes of all headers are those of the file.
Result<ExrHeader> readExrHeader(ByteView bytes, const std::string& name);

}  // namespace lucerna::codec

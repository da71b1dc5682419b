#include "app/settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace lucerna::app {

uvec2 RenderSettings::renderSize() const {
  const auto scaled = [&](std::uint32_t side) {
    return std::max(1u, static_cast<std::uint32_t>(std::lround(side * scale / 100.0)));
  };
  return {scaled(size.x), scaled(size.y)};
}

uvec2 RenderSettings::pictureSize() const {
  return size * uvec2(stereo.layout == StereoLayout::SideBySide ? 2 : 1,
                      stereo.layout == StereoLayout::TopBottom ? 2 : 1);
}

Result<uvec2> sizeFromText(const std::string& text) {
  uvec2 size{0};
  const char* end = text.data() + text.size();
  const auto [middle, widthFault] = std::from_chars(text.data(), end, size.x);
  bool good = widthFault == std::errc() && middle != end && (*middle == 'x' || *middle == 'X');
  if (good) {
    const auto [last, heightFault] = std::from_chars(middle + 1, end, size.y);
    good = heightFault == std::errc() && last == end;
  }
  if (!good || size.x < 1 || size.y < 1 || size.x > kMaxSide || size.y > kMaxSide)
    return error(ErrorKind::Usage,
                 "'{}' is not a size; wanted WIDTHxHEIGHT like 1280x720, each from 1 to {}", text,
                 kMaxSide);
  return size;
}

}  // namespace lucerna::app

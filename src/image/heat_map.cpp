#include <algorithm>
#include <array>
#include <cmath>

#include "image/metrics.hpp"

namespace lucerna {
namespace {

// Stops at even steps of the error. CIE lightness grows by 12 from each to the next; the hue turns
// from blue (298 degrees in CIELab) over red to yellow (102) at nearly the greatest chroma there
// is.
constexpr std::array<std::array<float, 3>, 9> kStops = {{{0, 0, 0},
                                                         {10, 24, 86},
                                                         {66, 32, 141},
                                                         {134, 42, 154},
                                                         {196, 54, 155},
                                                         {247, 85, 137},
                                                         {249, 150, 133},
                                                         {252, 201, 118},
                                                         {255, 246, 173}}};

}  // namespace

Image heatMap(const Image& error) {
  CHECK(error.channels() == 1 && error.type() == ComponentType::F32);
  Image colours(error.width(), error.height(), 3, ComponentType::U8);
  const auto from = error.as<float>();
  std::uint8_t* to = colours.as<std::uint8_t>().data();
  for (const float value : from) {
    const float at = (value > 0 ? std::min(value, 1.f) : 0.f) * (kStops.size() - 1);
    const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const float share = at - static_cast<float>(stop);
    for (std::size_t c = 0; c < 3; ++c)
      *to++ =
          static_cast<std::uint8_t>(std::lerp(kStops[stop][c], kStops[stop + 1][c], share) + 0.5f);
  }
  return colours;
}

}  // namespace lucerna

#include <algorithm>
#include <array>
#include <cmath>

#include "image/metrics.hpp"

namespace lucerna {
namespace {

// Stops at even steps of the error whose CIE lightness grows from 0 to 97 about evenly; the hue
// turns from violet over red to yellow so that equal lightness is never needed to tell two apart.
constexpr std::array<std::array<float, 3>, 9> kStops = {{{0, 0, 3},
                                                         {28, 16, 68},
                                                         {79, 18, 123},
                                                         {129, 37, 129},
                                                         {181, 54, 122},
                                                         {229, 80, 100},
                                                         {251, 135, 97},
                                                         {254, 194, 135},
                                                         {252, 253, 191}}};

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
